/// Deformable particles (DDEM; Rojek et al. 2018; Madan 2019, "M", chapter 2): the strain of each body is uniform and
/// follows from the forces on it.
///
///     V stress = sym sum s (x) f             over all forces f on the body, s from its centre to the surface
///     M 2.41, 2.44 strain   = D : stress                  plane strain, plane stress, or in space (model/compliance.h)
///     M 2.46 - 2.49 overlap  = circles' + R n.strain n of both bodies (contact/kinematics.h) M 2.52, 2.53
///
/// The arm s is R along the normal, as in M's Table 3.1 (503.1 kN; the arm to the middle of the overlap gives 504.6),
/// in stress and overlap alike, so that both are conjugate. Forces at centres (reactions of bodies that are held,
/// gravity) have no arm. f is the whole contact force, dashpots included (M's f^c).
///
/// Schemes. The strain that the forces at n + 1 are made with is found from the forces at n,
///     explicit    strain(n+1) = D : stress(n)                                                               M 3.17
///     relaxed     strain(n+1) = strain(n) + theta (D : stress(n) - strain(n))
/// in one pass over the bodies a step. Explicit forces converge, and the run is stable, only while the spectral radius
/// of M 3.8's B is below 1, about k_n/E < 0.55 to 0.85 in regular packings. B has eigenvalues 0 >= b of bonded normal
/// springs, so the relaxed ones, 1 - theta (1 - b), are stable for theta < 2 / (1 + |b|); auto takes theta = 1 / (1 +
/// bound), bound = 2 max over bodies of (contacts) k_n R^2 (n.D(n n)n) / V: each body's forces have at most (their
/// number) times the energy of one alone, and each force is in two bodies.
///
/// Energy. Contacts and bodies take up the work of the trapezoid, (f(n) + f(n+1))/2 times the change of the circles'
/// overlap; the bodies' part of it is
///     given += V (stress(n) + stress(n+1)) / 2 : (strain(n+1) - strain(n)),
/// without error. Stored of it is 1/2 V strain : D^-1 : strain; the rest is what the lag has taken out of the motion.
///
/// With k_t > 0 M's form has no potential: the tangential force enters the stress, but the strain not the slip
/// (M 2.27). What strains take up there without anyone giving it is in the ledger's `stiffness`. `corrected` moves the
/// contact points along the surfaces, too: then nothing is left.
///
/// Limits: small strains; normals and contact points stay those of the circles (M 2.6). The first forces of a run are
/// those of rigid bodies. Cost: two passes over the bodies a step, two rows more a body and contact.
#include "state/deformation.h"
#include "contact/deformation.h"

#include "base/checksum.h"
#include "base/integer_sum.h"
#include "case/check.h"
#include "comm/comm.h"
#include "contact/contact.h"
#include "contact/implicit.h"
#include "contact/stretch.h"
#include "model/critical_step.h"
#include "module/boundary.h"
#include "module/integrator.h"
#include "module/key_rows.h"
#include "state/body.h"

#include <float.h>

// ---- the case ----------------------------------------------------------------------------------------------------

enum { RIGID, EXPLICIT, RELAXED, IMPLICIT };
enum { AS_PUBLISHED, CORRECTED };
enum { STRAIN, LOOSE };

typedef struct config {
    int deformation;              ///< RIGID ...
    int plane;                    ///< scree_plane_condition
    double relaxation;            ///< 1, theta; auto: from the contacts
    double deformation_tolerance; ///< 1, of the implicit strain
    int tangential;               ///< AS_PUBLISHED or CORRECTED
    int dashpots;                 ///< STRAIN or LOOSE
} config;

static const scree_choice deformations[] = {
    {"none", RIGID, "particles are rigid"},
    {"explicit", EXPLICIT, "the strain follows the forces of the step before (Madan 2019, 3.17); limits k_n/E"},
    {"relaxed", RELAXED, "it goes by a share of the way to them in each step: stable at any k_n/E"},
    {"implicit", IMPLICIT,
     "it is that of the forces that it makes itself, found in each step: stable at any k_n/E, nothing "
     "lags"},
    {0},
};
static const scree_choice planes[] = {
    {"strain", SCREE_PLANE_STRAIN, "discs keep their thickness"},
    {"stress", SCREE_PLANE_STRESS, "discs are free to change it"},
    {0},
};
static const scree_choice tangentials[] = {
    {"as_published", AS_PUBLISHED,
     "tangential forces strain particles, but strains do not move contact points along the "
     "surfaces (Madan 2019, 2.27): no potential"},
    {"corrected", CORRECTED, "strains stretch tangential springs, too: elastic"},
    {0},
};
static const scree_choice dashpot_choices[] = {
    {"strain", STRAIN, "they strain particles as the springs do: the whole contact force"},
    {"loose", LOOSE, "only springs strain particles"},
    {0},
};
#define DEFORMED .when = "deformation=explicit|relaxed|implicit"
static const scree_key keys[] = {
    CHOICE(config, deformation, deformations, .standard = "none",
           .meaning = "Whether particles deform uniformly under the forces on them, by their `young_modulus` and "
                      "`poisson_ratio`."),
    CHOICE(config, plane, planes, .standard = "strain", DEFORMED,
           .meaning = "Plane condition of discs; spheres: none."),
    NUMBER(config, relaxation, "1", .standard = "auto", ABOVE("0"), TO("1"), .when = "deformation=relaxed",
           .meaning = "Share of the way to the strain of the forces that a step goes; auto: from the contacts."),
    NUMBER(config, deformation_tolerance, "1", .standard = "1e-9", FROM("1e-12"), TO("1e-6"),
           .when = "deformation=implicit",
           .meaning = "Largest error of the strain of a particle over the largest strain."),
    CHOICE(config, tangential, tangentials, .standard = "as_published", DEFORMED,
           .meaning = "Whether the strains of particles stretch tangential springs."),
    CHOICE(config, dashpots, dashpot_choices, .standard = "strain", DEFORMED,
           .meaning = "Whether the dashpots of contacts strain particles."),
};

static const config *own_config(const scree_config *whole)
{
    return scree_config_own(&scree_module_deformation, "contact", whole->contact.own);
}

bool scree_deformation_iterates(const scree_config *whole)
{
    const config *own = whole->contact.own ? own_config(whole) : NULL;
    return own && (own->deformation == EXPLICIT || own->deformation == RELAXED);
}

static void judge_material(scree_reader *reader, const scree_config *whole, int64_t index)
{
    const scree_config_material *material = &whole->materials[index];
    char path[SCREE_PATH_BYTES];
    (void)snprintf(path, sizeof path, "materials.%lld.poisson_ratio", (long long)index);
    // What is not even within its own limits has been refused at its place.
    if (!(material->young_modulus > 0) || !(material->poisson_ratio > -1 && material->poisson_ratio <= 0.5)) return;
    if (!scree_elasticity_is_stable(material->young_modulus, material->poisson_ratio))
        scree_rule_refuse(reader, path, "above -1 and below 0.5",
                          "a particle that deforms needs a Poisson's ratio between -1 and 0.5");
}

static bool takes_deforming(const scree_module *boundary)
{
    return !boundary->boundary->needs_rigid;
}

static bool takes_implicit(const scree_module *boundary)
{
    return takes_deforming(boundary) && !boundary->boundary->needs_lag;
}

static void judge_stage(scree_reader *reader, const scree_config *whole, int64_t index)
{
    char path[SCREE_PATH_BYTES];
    const bool lags = own_config(whole)->deformation != IMPLICIT;
    if (!scree_modules[whole->stages[index].kind]->numbers->held) return;
    const scree_boundary *boundary = scree_config_held_by(whole, index);
    (void)snprintf(path, sizeof path, "stages.%lld.boundary", (long long)index);
    if (boundary && boundary->needs_rigid)
        scree_rule_refuse(reader, path,
                          scree_rule_choices(reader, "stages.boundary", ", ", lags ? takes_deforming : takes_implicit),
                          "%s", boundary->needs_rigid);
    else if (boundary && boundary->needs_lag && !lags)
        scree_rule_refuse(reader, path, scree_rule_choices(reader, "stages.boundary", ", ", takes_implicit), "%s",
                          boundary->needs_lag);
}

static void rules(scree_reader *reader, const scree_config *whole)
{
    // Of a section that could not be read more has been said.
    if (!whole->contact.own || own_config(whole)->deformation == RIGID || whole->contact.law < 0) return;
    for (int k = 0; k <= whole->contact.pair_count; k++) {
        const int law = scree_config_law(&whole->contact, k);
        if (law < 0 || scree_law_get(law)->deforming) continue;
        char pair[SCREE_PATH_BYTES];
        (void)snprintf(pair, sizeof pair, "contact.pairs.%d.law", k - 1);
        scree_rule_refuse(reader, k > 0 ? pair : "contact.deformation", k > 0 ? NULL : "none",
                          "the law of the contacts does not carry particles that deform: take law: linear");
    }
    if (whole->integrator.scheme >= 0 && scree_integrator_get(whole->integrator.scheme)->velocity)
        scree_rule_refuse(reader, "integrator.scheme",
                          scree_rule_choices(reader, "integrator.scheme", ", ", scree_scheme_is_leapfrog),
                          "the strains of particles that deform follow the steps of a leapfrog: choose another scheme, "
                          "or contact.deformation: none");
    for (int64_t i = 0; i < whole->material_count; i++) judge_material(reader, whole, i);
    for (int64_t i = 0; i < whole->stage_count; i++)
        if (whole->stages[i].kind >= 0) judge_stage(reader, whole, i);
}

// ---- numbers -----------------------------------------------------------------------------------------------------

typedef struct numbers {
    scree_plane_condition condition;
    double relaxation;                                ///< theta; NAN: from the contacts
    double tolerance;                                 ///< of the implicit strain; NAN: there is none
    double soft;                                      ///< 1, of theta: 2 k_n R^2 (n.D(n n)n) / V of the softest body
    scree_compliance compliance[SCREE_MAX_MATERIALS]; ///< by material
} numbers;

static const numbers *own_numbers(const scree_model *model)
{
    return scree_model_numbers(model, SCREE_SLOT_deformation);
}

scree_compliance scree_deformation_compliance(const scree_model *model, int material)
{
    const numbers *n = own_numbers(model);
    return n ? n->compliance[material] : (scree_compliance){0, 0};
}

scree_plane_condition scree_deformation_condition(const scree_model *model)
{
    const numbers *n = own_numbers(model);
    return n ? n->condition : model->dimension == 3 ? SCREE_SOLID : SCREE_PLANE_STRAIN;
}

/// m3
static double volume_of(const scree_model *model, double radius)
{
    return M_PI * radius * radius * (model->dimension == 3 ? 4.0 / 3 * radius : model->thickness);
}

/// Stiffness [N/m] of the stiffest contact that a body of this material and radius may have.
static double stiffest(const scree_model *model, int material, double radius)
{
    const scree_law_use *use = scree_model_law_on_plate(model, material);
    scree_contact_tangent t = scree_contact_linearise(use, &model->walls[material], radius, 1, 0);
    double most = t.normal_stiffness;
    for (int other = 0; other < model->material_count; other++) {
        double reduced = radius * model->radius_max / (radius + model->radius_max);
        t = scree_contact_linearise(scree_model_law_between(model, material, other), &model->pairs[material][other],
                                    reduced, 1, 0);
        most = fmax(most, t.normal_stiffness);
    }
    return most;
}

static scree_status resolve_law(scree_model *model, scree_error *error)
{
    const config *own = scree_config_own(&scree_module_deformation, "contact", model->config->contact.own);
    (void)error;
    if (own->deformation == RIGID) return SCREE_OK;
    numbers *n = scree_model_reserve_numbers(model, SCREE_SLOT_deformation);
    n->relaxation = own->deformation == RELAXED ? own->relaxation : 1;
    n->tolerance = own->deformation == IMPLICIT ? own->deformation_tolerance : NAN;
    n->condition = model->dimension == 3 ? SCREE_SOLID : (scree_plane_condition)own->plane;
    for (int k = 0; k < model->material_count; k++) {
        const scree_config_material *material = scree_model_material_said(model, k);
        n->compliance[k] = scree_compliance_of(n->condition, material->young_modulus, material->poisson_ratio);
        const double along = n->compliance[k].shear + n->compliance[k].trace;
        for (int side = 0; side < 2; side++) {
            double radius = side ? model->radius_max : model->radius_min;
            n->soft =
                fmax(n->soft, 2 * stiffest(model, k, radius) * radius * radius * along / volume_of(model, radius));
        }
    }
    for (int k = 0; k < scree_model_law_count(model); k++) {
        scree_law_use *use = &model->laws[k];
        use->number[SCREE_LAW_LOOSE] = own->dashpots == LOOSE;
        use->number[SCREE_LAW_CORRECTED] = own->tangential == CORRECTED;
        use->option |= scree_law_get(use->law)->deforming;
    }
    return SCREE_OK;
}

// ---- state -------------------------------------------------------------------------------------------------------

typedef scree_deformation memory;
static const scree_field fields[] = {
    SCREE_FIELD_ONE(deformation, memory, given, "deformation/given", SCREE_FIELD_DOUBLE, 1, "J",
                    "energy that the bodies have taken up with their strains"),
    SCREE_FIELD_ONE(deformation, memory, largest_reach, "deformation/largest_reach", SCREE_FIELD_DOUBLE, 1, "m",
                    "no surface of a body has moved out by more", SCREE_RANGE(0, DBL_MAX)),
    SCREE_FIELD_ONE(deformation, memory, growth, "deformation/growth", SCREE_FIELD_DOUBLE, 1, "m",
                    "largest way of a surface in the last change of the strains", .role = SCREE_FIELD_DERIVED),
    SCREE_FIELD_ONE(deformation, memory, attacked, "deformation/attacked", SCREE_FIELD_UINT64, 1, "1",
                    "1: loads act on surfaces", .role = SCREE_FIELD_DERIVED),
    SCREE_FIELD_BODY(deformation, memory, term, double, "deformation/term", SCREE_FIELD_DOUBLE, 1, "J",
                     "work of its last change of strain", .role = SCREE_FIELD_DERIVED, .optional = true),
    SCREE_FIELD_BODY(deformation, memory, attack, scree_surface_force, "deformation/attack", SCREE_FIELD_DOUBLE, 6, "N",
                     "moments over the radius of the loads on its surface", .role = SCREE_FIELD_DERIVED,
                     .optional = true),
    SCREE_FIELD_BODY(deformation, memory, departed, scree_departed, "deformation/departed", SCREE_FIELD_DOUBLE, 18, "1",
                     "what the search for the implicit strain needs of the step before", .role = SCREE_FIELD_DERIVED,
                     .optional = true),
};
enum { DERIVED_OF_BODIES = 3 };

// ---- a step ------------------------------------------------------------------------------------------------------

/// theta where a body has up to so many contacts.
static double relaxation_for(const numbers *n, double contacts)
{
    return isnan(n->relaxation) ? 1 / (1 + n->soft * contacts) : n->relaxation;
}

double scree_deformation_share(const scree_model *model, double contacts)
{
    if (!own_numbers(model)) return 0;
    if (!isnan(own_numbers(model)->tolerance)) return -1;
    const double theta = relaxation_for(own_numbers(model), contacts);
    return theta / (2 - theta);
}

static double relaxation(const scree_context *c)
{
    const numbers *n = own_numbers(c->model);
    int64_t contacts = 0;
    if (!isnan(n->relaxation)) return n->relaxation;
    for (size_t row = 0; row < c->state->count; row++)
        contacts = c->state->sum[row].contacts > contacts ? c->state->sum[row].contacts : contacts;
    double most = (double)contacts;
    scree_comm_maximum(c->state, &most, 1);
    return relaxation_for(n, most);
}

/// A strain beyond this is not small.
static const double MOST_STRAIN = 0.1;

static scree_status check_strain(const scree_context *c, double reach, double growth, scree_error *error)
{
    const double limit = MOST_STRAIN * c->model->radius_max;
    if (reach <= limit && growth <= limit) return SCREE_OK;
    return scree_error_set(
        error, SCREE_ERROR_GUARD,
        "step %llu: the strain of a particle leaves the small ones, above %g %%: the load is too "
        "large for young_modulus, or k_n/E too large for contact.deformation: explicit; take stiffer "
        "particles, softer contacts, or deformation: relaxed",
        (unsigned long long)c->state->step, 100 * MOST_STRAIN);
}

static bool is_implicit(const scree_context *c)
{
    return !isnan(own_numbers(c->model)->tolerance);
}

/// From the forces at n to the strains that those at n + 1 are made with.
static scree_status strain_bodies(const scree_context *c, scree_error *error)
{
    scree_state *state = c->state;
    scree_deformation *all = scree_deformation_of(state);
    if (!state->moment) return SCREE_OK;
    scree_status status = SCREE_OK;
    for (size_t k = COUNT(fields) - DERIVED_OF_BODIES; k < COUNT(fields) && !status; k++)
        status = scree_state_begin_field(state, &fields[k], error);
    if (status) return status;
    if (is_implicit(c)) {
        scree_implicit_depart(c);
        return SCREE_OK;
    }
    const scree_stretch_change change =
        scree_stretch_bodies(c, own_numbers(c->model)->compliance, relaxation(c), all->term);
    if (change.reach > all->largest_reach) c->work->budget -= change.reach - all->largest_reach;
    all->largest_reach = change.reach;
    all->growth = change.growth;
    return check_strain(c, change.reach, change.growth, error);
}

/// Loads will say anew what they put on surfaces.
static scree_status clear_attack(const scree_context *c, scree_error *error)
{
    scree_surface_force *attack = scree_deformation_of(c->state)->attack;
    (void)error;
    if (scree_deformation_of(c->state)->attacked) memset(attack, 0, c->state->count * sizeof *attack);
    scree_deformation_of(c->state)->attacked = 0;
    return SCREE_OK;
}

static scree_status solve(const scree_context *c, scree_error *error)
{
    scree_stretch_change change;
    // The first forces of a run are those of rigid bodies: the ledger begins with them.
    if (!is_implicit(c) || c->state->evaluations <= 1) return SCREE_OK;
    const numbers *n = own_numbers(c->model);
    scree_status status = scree_implicit_solve(c, n->compliance, n->tolerance, &change, error);
    return status ? status : check_strain(c, change.reach, change.growth, error);
}

/// What loads put on surfaces strains as contact forces do.
static scree_status add_attack(const scree_context *c, scree_error *error)
{
    scree_state *state = c->state;
    const int d = state->dimension;
    const scree_tensor_place *place = scree_tensor_places(d);
    const scree_surface_force *attack = scree_deformation_of(state)->attack;
    (void)error;
    for (size_t row = 0; row < state->count && scree_deformation_of(state)->attacked; row++)
        for (int k = 0; k < scree_tensor_size(d); k++) {
            const int64_t quanta = llrint(attack[row].force[k] / state->force_quantum);
            int64_t *moment = state->moment + row * scree_moment_size(d);
            moment[d * place[k].i + place[k].j] += quanta;
            if (place[k].i != place[k].j) moment[d * place[k].j + place[k].i] += quanta;
        }
    return SCREE_OK;
}

/// The other half of the work, with the forces at n + 1.
static scree_status settle(const scree_context *c, scree_error *error)
{
    scree_deformation *all = scree_deformation_of(c->state);
    (void)error;
    const double given = scree_stretch_settle(c, all->term);
    all->given += given;
    c->state->ledger.turnover += fabs(given);
    return SCREE_OK;
}

// ---- what it tells -----------------------------------------------------------------------------------------------

/// Elastic energy of a body [J]: 1/2 V strain : D^-1 : strain.
static double energy_of_body(const scree_context *c, size_t row)
{
    const scree_state *state = c->state;
    const int d = state->dimension;
    const scree_compliance *by = &own_numbers(c->model)->compliance[scree_body_material(state, row)];
    const double volume = scree_stretch_volume(d, c->model->thickness, scree_body_bounding_radius(state, row));
    double stretch[6], stress[6], trace = 0;
    scree_tensor_get(d, scree_stretch_row(state, row), stretch);
    for (int k = 0; k < d; k++) trace += stretch[k];
    const double back = by->trace / (by->shear + d * by->trace);
    for (int k = 0; k < scree_tensor_size(d); k++) stress[k] = (stretch[k] - (k < d ? back * trace : 0)) / by->shear;
    return 0.5 * volume * scree_tensor_product(d, stress, stretch);
}

static double energy(const scree_context *c)
{
    scree_integer_sum sum = {0};
    if (!c->state->stretch) return 0;
    while (scree_comm_sum_next(c->state, &sum, 1))
        for (size_t row = 0; row < c->state->count; row++) scree_integer_sum_add(&sum, energy_of_body(c, row));
    return scree_integer_sum_total(&sum);
}

/// Largest way [m] by which a surface has moved out; the state's bound of it may be above.
static double largest_way(const scree_context *c)
{
    const int d = c->state->dimension;
    double stretch[6], largest = 0;
    for (size_t row = 0; row < c->state->count && c->state->stretch; row++) {
        scree_tensor_get(d, scree_stretch_row(c->state, row), stretch);
        largest = fmax(largest, scree_tensor_largest(d, stretch));
    }
    scree_comm_maximum(c->state, &largest, 1);
    return largest;
}

static const scree_result columns[] = {
    {"energy_particles", "J", "elastic energy of the strains of the particles"},
    {"energy_lag", "J", "taken out of the motion since strains follow the forces a step later"},
    {"strain_largest", "1", "largest way of a particle's surface over the largest radius"},
};

static scree_status sample(const scree_context *c, size_t index, double *value, scree_error *error)
{
    const scree_deformation *all = scree_deformation_of(c->state);
    (void)index, (void)error;
    value[0] = energy(c);
    value[1] = all->given - value[0];
    value[2] = largest_way(c) / c->model->radius_max;
    return SCREE_OK;
}

static const scree_result results[] = {
    {"force", "N", "mean normal force of the contacts at the end"},
    {"energy_particles", "J", "elastic energy of the strains of the particles at the end"},
    {"energy_lag", "J", "what was taken out of the motion since strains follow the forces a step later"},
};

static scree_status summarise(const scree_context *c, size_t index, double *value, scree_error *error)
{
    const scree_contact_table *table = c->table;
    scree_integer_sum sum = {0};
    (void)index, (void)error;
    while (scree_comm_sum_next(c->state, &sum, 1))
        for (size_t k = 0; k < table->count; k++) scree_integer_sum_add(&sum, table->contact[k].normal_force);
    value[0] = table->count > 0 ? scree_integer_sum_total(&sum) / (double)table->count : 0;
    value[1] = energy(c);
    value[2] = scree_deformation_of(c->state)->given - value[1];
    return SCREE_OK;
}

static bool told(const scree_config *whole, size_t index, char name[SCREE_RESULT_NAME])
{
    name[0] = 0;
    return index == 0 && own_config(whole)->deformation != RIGID;
}

// ---- module ------------------------------------------------------------------------------------------------------

static bool in_use(const scree_context *c)
{
    return scree_model_traits(c->model)->deforms;
}

/// Its products go over the pairs many times in a step, with what is sought of both bodies.
static const char *alone(const scree_model *model)
{
    return own_numbers(model) && !isnan(own_numbers(model)->tolerance) ? "implicit" : NULL;
}

static double work(const scree_state *state)
{
    return -scree_deformation_of(state)->given;
}

static uint64_t checksum(const scree_model *model, const scree_state *state, uint64_t c)
{
    size_t next = 0;
    double strain[6];
    if (!scree_model_traits(model)->deforms || !state->stretch) return c;
    for (uint32_t row; (row = scree_next_by_id(state, &next)) != SCREE_NO_ROW;) {
        scree_tensor_get(state->dimension, scree_stretch_row(state, row), strain);
        for (int k = 0; k < scree_tensor_size(state->dimension); k++)
            strain[k] /= scree_body_bounding_radius(state, row);
        c = scree_checksum_numbers(c, strain, (size_t)scree_tensor_size(state->dimension));
    }
    return scree_checksum_number(c, scree_deformation_of(state)->given);
}

static scree_status begin(const scree_context *c, scree_error *error)
{
    return in_use(c) ? scree_state_ask_for_stretches(c->state, error) : SCREE_OK;
}

static const scree_pass passes[] = {{SCREE_PHASE_DECIDE, .run = strain_bodies},
                                    {SCREE_PHASE_FIRST_HALF, .run = clear_attack},
                                    {SCREE_PHASE_SEARCH, .run = solve},
                                    {SCREE_PHASE_BODIES, .run = add_attack},
                                    {SCREE_PHASE_SECOND_HALF, .run = settle}};

const scree_module scree_module_deformation = {
    .name = "deformation",
    .meaning = "particles that deform uniformly under the forces on them",
    .keys = (const scree_keys[]){KEYS_OF("contact", keys, config)},
    .keys_count = 1,
    .rules = rules,
    .numbers_size = sizeof(numbers),
    .resolve_law = resolve_law,
    .state_size = sizeof(memory),
    .fields = fields,
    .field_count = COUNT(fields),
    .checksum = checksum,
    .begin = begin,
    .passes = passes,
    .pass_count = COUNT(passes),
    .in_use = in_use,
    .spreads = true,
    .begins_whole = scree_begins_in_parts,
    .alone = alone,
    .reads_moments = true,
    .work = work,
    .columns = SCREE_RESULTS_IN_PARTS(columns, sample),
    .results = SCREE_RESULTS(results, summarise),
    .told = told,
};
