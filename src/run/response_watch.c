/// Contacts under a load that grows (`measure.response_load`): the largest load up to which none was made, lost or
/// brought to sliding.
///
/// When the load begins to act all contacts are noted, by the ids of their ends (a wall by its number), with whether
/// their friction is used up. From then on the contacts of a step are compared with them whenever the load has grown by
/// 2 % over the largest one that was looked at, beginning with 1e-3 of the weight of the loaded grain, and every 100
/// steps while it does not grow, until the first difference is found: a contact that is not noted, one that is missing,
/// or one that slides and did not. Contacts between what is held do not change.
///
/// The noted contacts are state, the same in all parts of a sample; each process looks at its own contacts, and their
/// numbers are joined. Cost: a sum over the bodies a step, and a table of contacts at each look, until the first
/// difference; 16 bytes a contact.
#include "base/memory.h"
#include "comm/comm.h"
#include "contact/contact.h"
#include "load/prescribed.h"
#include "run/conclusion.h"
#include "run/response_load.h"
#include "search/neighbours.h"
#include "state/body.h"
#include "state/fields.h"

#include <math.h>
#include <stdlib.h>

static const double GROWTH = 1.02; ///< of the load between two looks
static const double FIRST = 1e-3;  ///< weights of the loaded grain, at the first one
enum { PAUSE = 100 };              ///< steps between two looks under a load that does not grow

// ---- state -------------------------------------------------------------------------------------------------------

/// A contact before the load.
typedef struct noted {
    uint32_t end[2]; ///< ids, that of a grain first; else the smaller one
    uint32_t slides; ///< 1: its friction was used up
} noted;

/// Contacts made, lost and brought to sliding at the first difference.
enum { MADE, LOST, SLIDING, KINDS };

typedef struct own {
    noted *contact; ///< in the order of their ends
    size_t count, capacity;
    uint64_t watching; ///< 1: no difference has been found
    uint64_t looked;   ///< evaluations of forces at the last look
    double least;      ///< N, load from which on there are looks
    double unchanged;  ///< N, largest load at which nothing had changed
    double before;     ///< N, that of the look before
    double changed;    ///< N, at the first difference; NAN: there was none
    double first[KINDS];
} own;

static own *own_of(const scree_state *state)
{
    return state->own[SCREE_SLOT_response_watch];
}

static const scree_group contacts = {
    .row = "contact",
    .symbol = "w",
    .count_offset = offsetof(own, count),
    .capacity_offset = offsetof(own, capacity),
};

#define CONTACT(name, member, components, meaning, ...)                                                                \
    SCREE_FIELD_GROUP(response_watch, own, contacts, contact, noted, "response/" name, SCREE_FIELD_UINT32, components, \
                      "1", meaning, .offset = offsetof(noted, member), __VA_ARGS__)
#define ONE(member, type, unit, meaning, ...)                                                                          \
    SCREE_FIELD_ONE(response_watch, own, member, "response/" #member, type, 1, unit, meaning, __VA_ARGS__)
static const scree_field fields[] = {
    CONTACT("contact", end, 2, "ids of the ends of a contact before the load; of walls and their parts numbers", ),
    CONTACT("slides", slides, 1, "1: its friction was used up", SCREE_RANGE(0, 1)),
    ONE(watching, SCREE_FIELD_UINT64, "1", "1: contacts are watched, and have not changed", SCREE_RANGE(0, 1)),
    ONE(looked, SCREE_FIELD_UINT64, "1", "evaluations of forces at the last look at the contacts",
        SCREE_RANGE_TO(SCREE_LIMIT_EVALUATIONS)),
    ONE(least, SCREE_FIELD_DOUBLE, "N", "load from which on they are looked at"),
    ONE(unchanged, SCREE_FIELD_DOUBLE, "N", "largest load at which none had changed"),
    ONE(before, SCREE_FIELD_DOUBLE, "N", "load of the look before that"),
    ONE(changed, SCREE_FIELD_DOUBLE, "N", "load at which some first had; -1: none has", SCREE_RANGE(-1, 1e300)),
    SCREE_FIELD_ONE(response_watch, own, first, "response/first", SCREE_FIELD_DOUBLE, KINDS, "1",
                    "contacts made, lost and brought to sliding then"),
};

// ---- contacts ----------------------------------------------------------------------------------------------------

/// Between a grain and what is none friction is taken to be that of two such grains.
static bool slides(const scree_context *c, const scree_contact *contact)
{
    const int first = scree_body_material(c->state, contact->first);
    const int second = contact->wall ? first : scree_body_material(c->state, contact->second);
    return scree_response_slides(c->model->pairs[first][second].value[SCREE_FRICTION], contact->tangential_force,
                                 contact->normal_force);
}

static noted note(const scree_context *c, const scree_contact *contact)
{
    const uint32_t first = c->state->id[contact->first], second = scree_contact_second_id(c->state, contact);
    noted found = {{first, second}, slides(c, contact)};
    if (!contact->wall && second < first) found = (noted){{second, first}, found.slides};
    return found;
}

static int by_ends(const void *left, const void *right)
{
    const noted *a = left, *b = right;
    for (int k = 0; k < 2; k++)
        if (a->end[k] != b->end[k]) return a->end[k] < b->end[k] ? -1 : 1;
    return 0;
}

/// Numbers of contacts that are new, that are still there, and that slide and did not.
static void compare(const scree_context *c, const scree_contact_table *table, int64_t number[KINDS])
{
    const own *w = own_of(c->state);
    int64_t there = 0;
    number[MADE] = number[SLIDING] = 0;
    for (size_t k = 0; k < table->count; k++) {
        const noted now = note(c, &table->contact[k]);
        const noted *then = w->count > 0 ? bsearch(&now, w->contact, w->count, sizeof now, by_ends) : NULL;
        there += then != NULL;
        number[MADE] += then == NULL;
        number[SLIDING] += then && now.slides && !then->slides;
    }
    number[LOST] = there;
    scree_comm_add(c->state, number, KINDS);
    number[LOST] = (int64_t)w->count - number[LOST];
}

// ---- begin -------------------------------------------------------------------------------------------------------

static bool begins_whole(const scree_context *c)
{
    return scree_response_load_begins(c);
}

static scree_status note_all(const scree_context *c, scree_error *error)
{
    own *w = own_of(c->state);
    scree_contact_table table = {0};
    scree_status status = scree_contact_table_build(c->model, c->state, c->work, &table, error);
    if (!status) status = scree_group_reserve(c->state, &scree_module_response_watch, &contacts, table.count, error);
    w->count = 0;
    for (size_t k = 0; k < table.count && !status; k++) w->contact[w->count++] = note(c, &table.contact[k]);
    if (!status && w->count > 0) qsort(w->contact, w->count, sizeof *w->contact, by_ends);
    scree_contact_table_destroy(&table);
    return status;
}

static scree_status begin(const scree_context *c, scree_error *error)
{
    own *w = own_of(c->state);
    const scree_response_numbers *n = scree_response_numbers_of(c->model);
    uint32_t row;
    if (!scree_response_load_begins(c)) return SCREE_OK;
    scree_status status = scree_neighbours_refresh(c->model, c->state, c->work, error);
    if (!status) status = scree_response_find_loaded(c->model, c->state, n->load, &row, error);
    if (!status) status = note_all(c, error);
    if (status) return status;
    w->least = FIRST * scree_body_mass(c->state, row) * fabs(c->model->gravity[1]);
    w->watching = 1;
    w->looked = c->state->evaluations;
    w->unchanged = w->before = 0;
    w->changed = -1;
    return SCREE_OK;
}

// ---- the step ----------------------------------------------------------------------------------------------------

static bool in_use(const scree_context *c)
{
    const scree_response_numbers *n = scree_response_numbers_of(c->model);
    return n && scree_prescribed_of(c->state)->acts[n->load];
}

/// What a look at the contacts under a load found.
static void take(own *w, double load, const int64_t number[KINDS])
{
    if (number[MADE] + number[LOST] + number[SLIDING] == 0) {
        if (!(load > w->unchanged)) return;
        w->before = w->unchanged;
        w->unchanged = load;
        return;
    }
    w->watching = 0;
    w->changed = load;
    // A change under a load that was borne before came late: that load is none up to which nothing changes.
    if (!(load > w->unchanged)) w->unchanged = fmin(w->before, load);
    for (int k = 0; k < KINDS; k++) w->first[k] = (double)number[k];
}

static scree_status watch(const scree_context *c, scree_error *error)
{
    own *w = own_of(c->state);
    scree_contact_table table = {0};
    int64_t number[KINDS];
    double force[3];
    if (!w->watching) return SCREE_OK;
    scree_prescribed_force(c->state, scree_response_numbers_of(c->model)->load, force);
    const double load = -force[1];
    const bool grows = load >= fmax(w->least, GROWTH * w->unchanged);
    const bool waits = load >= w->least && c->state->evaluations - w->looked >= PAUSE;
    if (!grows && !waits) return SCREE_OK;
    w->looked = c->state->evaluations;
    scree_status status = scree_contact_table_build(c->model, c->state, c->work, &table, error);
    if (!status) {
        compare(c, &table, number);
        take(w, load, number);
    }
    scree_contact_table_destroy(&table);
    return status;
}

static const scree_pass passes[] = {{SCREE_PHASE_GUARD, .run = watch}};

// ---- results -----------------------------------------------------------------------------------------------------

static const scree_result results[] = {
    {"response_unchanged_force", "N",
     "largest load up to which no contact was made, lost or brought to sliding, of looks each 2 % of the load"},
    {"response_changed_force", "N", "load at the look that found the first of these; none without one"},
    {"response_first_made", "1", "contacts made at that look"},
    {"response_first_lost", "1", "contacts lost then"},
    {"response_first_sliding", "1", "contacts brought to sliding then"},
};

static scree_status conclude(const scree_conclusion *run, scree_error *error)
{
    static const char *const first[] = {"response_first_made", "response_first_lost", "response_first_sliding"};
    const own *w = own_of(&run->s->state);
    const scree_response_numbers *n = scree_response_numbers_of(&run->s->model);
    (void)error;
    const scree_prescribed *all = scree_prescribed_of(&run->s->state);
    if (!n || !all->acts[n->load] || !(scree_state_time(&run->s->state) > all->begun[n->load])) return SCREE_OK;
    scree_summary_set_number(run->summary, "response_unchanged_force", w->unchanged);
    if (w->changed < 0) return SCREE_OK;
    scree_summary_set_number(run->summary, "response_changed_force", w->changed);
    for (int k = 0; k < KINDS; k++) scree_summary_set_number(run->summary, first[k], w->first[k]);
    return SCREE_OK;
}

const scree_module scree_module_response_watch = {
    .name = "response_watch",
    .meaning = "contacts under a load on one grain: the load up to which none changes",
    .state_size = sizeof(own),
    .fields = fields,
    .field_count = sizeof fields / sizeof *fields,
    .begin = begin,
    .begins_whole = begins_whole,
    .passes = passes,
    .pass_count = sizeof passes / sizeof *passes,
    .in_use = in_use,
    .spreads = true,
    .results = SCREE_RESULTS(results, NULL),
    .conclude = conclude,
};
