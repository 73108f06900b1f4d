/// Dispersion relation of the layers: dispersion.csv, a row a wavenumber and component, and the deviation from the
/// closed form where the sample was prepared as a lattice (theory/lattice_waves.h), whose strains follow at once.
#include "run/waves.h"

#include "io/file_names.h"
#include "io/run_directory.h"
#include "measure/dispersion.h"
#include "specimen/from_state.h"
#include "state/periodic.h"
#include "theory/lattice_waves.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>

/// A component that moves less than this share of the largest is not told of.
#define STILL 1e-6
/// A wave has a clear frequency when so much of its power lies around it: where branches that turn and slide bodies
/// cross it has two.
#define CLEAR 0.9

/// The lattice of the sample as it stands at the end.
typedef struct crystal {
    bool there;
    scree_lattice lattice;
    scree_lattice_material material;
    bool turned;
} crystal;

static scree_status find_crystal(scree_simulation *s, const scree_wave_numbers *own, crystal *c, scree_error *error)
{
    scree_specimen specimen;
    *c = (crystal){.there = own->lattice > 0, .turned = own->turned};
    if (!c->there) return SCREE_OK;
    scree_status status = scree_specimen_of_state(&s->stage_model, &s->state, &s->work, &specimen, error);
    if (status) return status;
    c->there = specimen.contact_count > 0;
    if (c->there) {
        const double radius = specimen.radius[0], area = M_PI * radius * radius;
        c->lattice = (scree_lattice)(own->lattice - 1);
        c->material = (scree_lattice_material){.radius = radius,
                                               .length = specimen.volume[0] / area,
                                               .density = specimen.mass[0] / specimen.volume[0],
                                               .normal = specimen.contact[0].stiffness.normal,
                                               .tangential = specimen.contact[0].stiffness.tangential,
                                               .shear = specimen.compliance[0].shear,
                                               .trace = specimen.compliance[0].trace,
                                               .corrected = specimen.tangential == SCREE_TANGENTIAL_CORRECTED};
    }
    scree_specimen_destroy(&specimen);
    return SCREE_OK;
}

/// Unit vector of an axis of the sample in those of the cubic cell.
static void turn(const crystal *c, int axis, double direction[3])
{
    for (int k = 0; k < 3; k++) direction[k] = k == axis;
    if (!c->turned || axis == 2) return;
    direction[0] = axis == 0 ? M_SQRT1_2 : -M_SQRT1_2;
    direction[1] = M_SQRT1_2;
}

/// Frequency of the lattice; all: those of all its waves of this wave vector, ascending.
static double expected(const crystal *c, int axis, int component, double wavenumber, double all[SCREE_LATTICE_BRANCHES])
{
    double wave[3], direction[3];
    for (int b = 0; b < SCREE_LATTICE_BRANCHES; b++) all[b] = NAN;
    if (!c->there) return NAN;
    turn(c, axis, wave);
    turn(c, component, direction);
    for (int k = 0; k < 3; k++) wave[k] *= wavenumber;
    (void)scree_lattice_frequencies(c->lattice, &c->material, wave, SCREE_STRAIN_AT_ONCE, all);
    return scree_lattice_frequency_along(c->lattice, &c->material, wave, SCREE_STRAIN_AT_ONCE, direction);
}

/// What all components come to.
typedef struct findings {
    double deviation;
    int64_t points;
} findings;

static void write_points(FILE *file, const crystal *c, int axis, int component, const scree_dispersion_point *point,
                         size_t count, findings *f)
{
    for (size_t k = 0; k < count; k++) {
        double all[SCREE_LATTICE_BRANCHES];
        const double lattice = expected(c, axis, component, point[k].wavenumber, all);
        fprintf(file, "%d,%.9g,%.9g,%.9g,%.9g", component, point[k].wavenumber, point[k].frequency, point[k].share,
                lattice);
        for (int b = 0; b < SCREE_LATTICE_BRANCHES; b++) fprintf(file, ",%.9g", all[b]);
        fputc('\n', file);
        if (!(point[k].share > CLEAR)) continue;
        f->points++;
        if (!isnan(lattice)) f->deviation = fmax(f->deviation, fabs(point[k].frequency / lattice - 1));
    }
}

/// Displacements of one component of all layers, by record; their largest magnitude.
static double gather(const scree_state *state, const scree_wave_numbers *own, int component, double *value)
{
    const scree_waves *m = scree_waves_of(state);
    const size_t layers = (size_t)own->layers, channels = scree_wave_channels(own);
    double most = 0;
    for (size_t r = 0; r < m->record_count; r++)
        for (size_t j = 0; j < layers; j++) {
            const double u = m->value[r * channels + (size_t)own->receiver_count + j][component];
            value[r * layers + j] = u;
            most = fmax(most, fabs(u));
        }
    return most;
}

static scree_status write_components(const scree_conclusion *run, const scree_wave_numbers *own, const crystal *c,
                                     FILE *file, double *value, scree_dispersion_point *point, findings *f,
                                     scree_error *error)
{
    const scree_state *state = &run->s->state;
    const scree_waves *m = scree_waves_of(state);
    const size_t layers = (size_t)own->layers;
    const double interval = (m->time[m->record_count - 1] - m->time[0]) / (double)(m->record_count - 1);
    double most = 0;
    scree_status status = SCREE_OK;
    for (int i = 0; i < state->dimension; i++) most = fmax(most, gather(state, own, i, value));
    for (int i = 0; i < state->dimension && !status; i++) {
        if (!(gather(state, own, i, value) > STILL * most)) continue;
        status = scree_dispersion_find(value, layers, m->record_count, m->spacing, interval,
                                       scree_periodic_repeats(scree_cell(state), own->axis), point, error);
        if (!status) write_points(file, c, own->axis, i, point, layers / 2, f);
    }
    return status;
}

/// Steps that were not all alike are not equidistant in time.
static bool is_even(const scree_waves *m)
{
    const double interval = (m->time[m->record_count - 1] - m->time[0]) / (double)(m->record_count - 1);
    for (size_t k = 1; k < m->record_count; k++)
        if (fabs(m->time[k] - m->time[k - 1] - interval) > 1e-6 * interval) return false;
    return true;
}

scree_status scree_waves_disperse(const scree_conclusion *run, scree_error *error)
{
    enum { LEAST = 16 };
    const scree_wave_numbers *own = scree_wave_numbers_of(&run->s->model);
    const scree_waves *m = scree_waves_of(&run->s->state);
    const size_t layers = (size_t)own->layers;
    char path[PATH_MAX];
    FILE *file;
    crystal c;
    findings f = {0};
    double *value = NULL;
    scree_dispersion_point *point = NULL;
    if (m->record_count < LEAST || !is_even(m)) return SCREE_OK;
    scree_status status = find_crystal(run->s, own, &c, error);
    if (!status) status = scree_allocate(&value, layers * m->record_count, sizeof *value, error);
    if (!status) status = scree_allocate(&point, layers / 2, sizeof *point, error);
    if (!status) status = scree_path_join(path, sizeof path, run->directory, SCREE_FILE_DISPERSION, error);
    if (!status) status = scree_replace_begin(path, &file, error);
    if (!status) {
        fputs("component [1],wavenumber [rad/m],frequency [rad/s],share [1],lattice [rad/s]", file);
        for (int b = 1; b <= SCREE_LATTICE_BRANCHES; b++) fprintf(file, ",wave_%d [rad/s]", b);
        fputc('\n', file);
        status = write_components(run, own, &c, file, value, point, &f, error);
        const scree_status written = scree_replace_finish(path, file, status == SCREE_OK, status ? NULL : error);
        if (!status) status = written;
    }
    scree_release(&value);
    scree_release(&point);
    if (status) return status;
    scree_summary_set_integer(run->summary, "dispersion_points", f.points);
    if (c.there && f.points > 0) scree_summary_set_number(run->summary, "dispersion_deviation", f.deviation);
    return SCREE_OK;
}
