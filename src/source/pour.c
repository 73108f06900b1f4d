/// Pouring: a pass at the begin of a step in which sources let grains go that are due.
///
/// When. A source has a birth due when its interval has passed since the last one. A grain is born in free space only:
/// its bounding circle (sphere) touches no body and no wall. Else the source waits; one with more than one point tries
/// another place in the next step. After a wait the interval counts from the birth on. What is born, where and how fast
/// is a function of the seed, the number of the body and the attempt, all of which are state, so a run that is stopped
/// goes on with the same births.
///
/// Layers. A source of one grain at a time has filled a layer when as many grains have been born as lie side by side in
/// it; one of layers lets all go at once that fit, when there is room for all of them. With a new layer it looks where
/// the top of the pile is (measure/pile.h), if it follows that.
///
/// What ends it: the number of the stage, of the source or of the case; a height or width of the pile, looked at before
/// each birth. All of it depends on the state alone, not on when samples are taken. So does the search for grains that
/// have fallen past everything that stands, every LOOK_STEPS steps.
///
/// Several processes. A birth, a look at the pile and the end of a patience are of the whole sample, which is put
/// together in all of them then (scree_pour_wants_all); that a source waits is found, and remembered, by parts.
///
/// Cost: a step without a birth due costs nothing; an attempt one pass over the bodies; a birth a new neighbour list,
/// and a table of contacts where the pile is measured.
#include "source/pour.h"
#include "base/vectors.h"
#include "comm/comm.h"
#include "prepare/birth.h"
#include "search/neighbours.h"
#include "shape/wall_set.h"
#include "source/source.h"
#include "state/plates.h"
#include "state/sleep.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { LOOK_STEPS = 256 };

/// What the births of one step share.
typedef struct step {
    const scree_context *c;
    scree_births *births;
    const scree_pour_config *stage;
    scree_pile pile;
    bool measured;
    bool saved; ///< the contacts lie in the state, so that bodies may come
} step;

// ---- the case ----------------------------------------------------------------------------------------------------

const scree_pour_config *scree_pour_config_of(const scree_model *model, const scree_state *state)
{
    if (state->stage.index >= model->stage_count) return NULL;
    const scree_config_stage *stage = &model->stages[state->stage.index];
    return scree_modules[stage->kind]->numbers->pours ? stage->own : NULL;
}

bool scree_source_pours_in(const scree_model *model, int64_t index, int64_t stage)
{
    const char *wanted = model->sources[index].stage, *name = model->stages[stage].name;
    if (!wanted) return true;
    return name && strcmp(wanted, name) == 0;
}

uint64_t scree_pour_wanted(const scree_model *model, const scree_pour_config *stage, uint64_t born)
{
    const uint64_t left = model->count > born ? model->count - born : 0;
    return stage->count > 0 && (uint64_t)stage->count < left ? (uint64_t)stage->count : left;
}

double scree_pour_time(const scree_model *model, int64_t stage, double count)
{
    double rate = 0;
    for (int64_t k = 0; k < model->source_count; k++) {
        const scree_config_source *source = &model->sources[k];
        if (!scree_source_pours_in(model, k, stage)) continue;
        scree_source_place place;
        scree_modules[source->kind]->source->place(source->own, &place);
        const bool layers = source->batch == SCREE_SOURCE_LAYER;
        rate += (layers ? (double)scree_source_layer(model, source, &place) : 1) / source->interval;
    }
    return rate > 0 ? count / rate : NAN;
}

double scree_pour_patience(const scree_model *model, const scree_pour_config *stage, int64_t source)
{
    const double gravity = scree_length(model->gravity), interval = model->sources[source].interval;
    const double falls = gravity > 0 ? sqrt(4 * scree_birth_largest_reach(model) / gravity) : 0;
    return isnan(stage->patience) ? fmax(100 * interval, 50 * falls) : stage->patience;
}

// ---- free space --------------------------------------------------------------------------------------------------

/// What is in the way of a birth.
typedef struct obstacle {
    enum { NOTHING, BODY, WALL, PLATE, ELSEWHERE } what; ///< ELSEWHERE: a body of another process
    size_t index;                                        ///< row, or number of the wall or plate
} obstacle;

static obstacle find_obstacle(const scree_state *state, const scree_work *work, const scree_vector place, double reach)
{
    for (int w = 0; w < 2 * state->dimension; w++) {
        const scree_wall *plate = &scree_plates(state)[w];
        if (plate->active && scree_dot(plate->normal, place) - plate->position < reach)
            return (obstacle){PLATE, (size_t)w};
    }
    for (int k = 0; work->wall_set && k < work->wall_set->count; k++)
        if (scree_surface_clearance(work->wall_set, k, place, reach) < reach) return (obstacle){WALL, (size_t)k};
    // Of several bodies any may be named, but the same one in every run: that with the lowest id.
    obstacle found = {NOTHING, 0};
    for (size_t row = 0; row < state->count; row++) {
        scree_vector other, way;
        scree_body_position(state, row, other);
        scree_subtract(place, other, way);
        const double near = reach + scree_body_bounding_radius(state, row);
        if (scree_dot(way, way) >= near * near) continue;
        if (found.what == NOTHING || state->id[row] < state->id[found.index]) found = (obstacle){BODY, row};
    }
    return found;
}

static scree_status stop_blocked(const step *s, int64_t index, const scree_vector place, const obstacle *by,
                                 scree_error *error)
{
    const scree_state *state = s->c->state;
    const scree_source_state *own = &s->births->source[index];
    const double waited = (double)(state->step - own->since) * state->tick;
    char what[160];
    const char *remedy = "give it another place";
    if (by->what == BODY) {
        const bool rests = scree_body_contacts(state, by->index) > 0;
        (void)snprintf(what, sizeof what, "particle %u, which %s", state->id[by->index],
                       rests ? "touches others: the pile has reached the source, or a funnel has clogged"
                             : "has not fallen away");
        remedy = rests ? "raise the source, pour fewer particles, or let it stay `above` the pile"
                       : "give it a larger `interval` or `velocity`, or gravity";
    } else if (by->what == WALL)
        (void)snprintf(what, sizeof what, "wall '%s'", s->c->work->wall_set->surface[by->index].config->name);
    else
        (void)snprintf(what, sizeof what, "a plate");
    return scree_error_set(error, SCREE_ERROR_GUARD,
                           "step %llu: source '%s' has been blocked for %.3g s (stages.%lld.patience), at (%.4g, %.4g, "
                           "%.4g) m by %s; %s",
                           (unsigned long long)state->step, s->c->model->sources[index].name, waited,
                           (long long)state->stage.index, place[0], place[1], place[2], what, remedy);
}

/// Whether the source, which waits, has been blocked for longer than the stage has patience.
static bool is_over(const step *s, int64_t index)
{
    const scree_state *state = s->c->state;
    const double patience = scree_pour_patience(s->c->model, s->stage, index);
    return (double)(state->step - s->births->source[index].since) * state->tick > patience;
}

/// The source waits from now on, or goes on waiting.
static scree_status wait(step *s, int64_t index, const scree_vector place, const obstacle *by, scree_error *error)
{
    scree_state *state = s->c->state;
    scree_source_state *own = &s->births->source[index];
    if (own->attempts++ == 0) {
        own->since = state->step;
        own->waits++;
    }
    return is_over(s, index) ? stop_blocked(s, index, place, by, error) : SCREE_OK;
}

// ---- the pile ----------------------------------------------------------------------------------------------------

static scree_status measure_pile(step *s, scree_error *error)
{
    const scree_context *c = s->c;
    scree_contact_table table = {0};
    if (s->measured) return SCREE_OK;
    scree_status status = scree_neighbours_refresh(c->model, c->state, c->work, error);
    if (!status) status = scree_contact_table_build(c->model, c->state, c->work, &table, error);
    if (!status) status = scree_pile_measure_circles(c->model, c->state, c->work, &table, &s->pile, error);
    s->measured = !status;
    s->saved = false;
    scree_contact_table_destroy(&table);
    return status;
}

static void end(step *s, scree_pour_end why)
{
    s->births->end = why;
    s->births->ended = s->c->state->step;
}

static bool wants_extent(const scree_pour_config *stage)
{
    return !isnan(stage->height) || !isnan(stage->width);
}

/// Whether the pile has become what the stage wants.
static scree_status check_extent(step *s, scree_error *error)
{
    const scree_pour_config *stage = s->stage;
    if (!wants_extent(stage)) return SCREE_OK;
    scree_status status = measure_pile(s, error);
    if (status) return status;
    if (s->pile.top - s->pile.base >= stage->height)
        end(s, SCREE_POUR_HEIGHT);
    else if (s->pile.right - s->pile.left >= stage->width)
        end(s, SCREE_POUR_WIDTH);
    return SCREE_OK;
}

// ---- births ------------------------------------------------------------------------------------------------------

/// Once before the births of a step.
static scree_status save_contacts(step *s, scree_error *error)
{
    if (s->saved) return SCREE_OK;
    scree_status status = scree_neighbours_refresh(s->c->model, s->c->state, s->c->work, error);
    if (!status) status = scree_contacts_save(s->c->state, s->c->work, error);
    s->saved = !status;
    return status;
}

static scree_status give_birth(step *s, int64_t index, const scree_vector place, scree_error *error)
{
    const scree_context *c = s->c;
    const scree_config_source *source = &c->model->sources[index];
    scree_birth birth = {.species = scree_source_species(c->model, source), .position = {place[0], place[1], place[2]}};
    uint32_t row;
    scree_source_draw_motion(c->model, source, c->state->next_id, birth.velocity, &birth.angle);
    scree_status status = save_contacts(s, error);
    if (!status) status = scree_birth_append(c->model, c->state, c->work, &birth, &row, error);
    if (status) return status;
    s->births->source[index].born++;
    s->births->source[index].in_layer++;
    s->births->in_stage++;
    return SCREE_OK;
}

/// Grains that the source may still pour, of what source, stage and case have.
static uint64_t left_for(const step *s, int64_t index)
{
    const scree_config_source *source = &s->c->model->sources[index];
    uint64_t left = s->c->model->count - s->c->state->next_id;
    if (scree_source_used_up(s->c->model, source, &s->births->source[index])) return 0;
    if (s->stage->count > 0 && (uint64_t)s->stage->count - s->births->in_stage < left)
        left = (uint64_t)s->stage->count - s->births->in_stage;
    if (source->count > 0 && (uint64_t)source->count - s->births->source[index].born < left)
        left = (uint64_t)source->count - s->births->source[index].born;
    return left;
}

/// When the next one is due, and whether a layer is full.
static void go_on(step *s, int64_t index, uint64_t layer)
{
    const scree_state *state = s->c->state;
    scree_source_state *own = &s->births->source[index];
    const uint64_t largest = s->c->model->largest_step;
    uint64_t interval = (uint64_t)ceil(s->c->model->sources[index].interval / state->tick / (double)largest) * largest;
    if (own->attempts > 0) own->waited += state->step - own->since;
    own->due = (own->attempts > 0 ? state->step : own->due) + interval;
    if (own->due <= state->step) own->due = state->step + interval;
    own->attempts = 0;
    if (own->in_layer < layer) return;
    own->layer++;
    own->in_layer = 0;
}

/// What a source lets go next: one grain, or a layer of them.
typedef struct trial {
    bool layer;
    int species;
    double reach; ///< m, of the grain, or of the largest one
    uint64_t first;
    size_t count;
    scree_source_place place;
    scree_source_slots slots; ///< of a layer
} trial;

static trial make_trial(const step *s, int64_t index)
{
    const scree_context *c = s->c;
    const scree_config_source *source = &c->model->sources[index];
    const scree_source_state *own = &s->births->source[index];
    const uint64_t left = left_for(s, index);
    trial t = {.species = scree_source_species(c->model, source), .first = c->state->next_id, .count = 1};
    t.layer = source->batch == SCREE_SOURCE_LAYER;
    t.reach = t.layer ? scree_birth_largest_reach(c->model) : scree_birth_reach(c->model, t.species, t.first);
    scree_source_place_now(c->model, source, own, scree_state_time(c->state), t.reach, &t.place);
    if (!t.layer) return t;
    t.slots = scree_source_make_slots(&t.place, t.reach);
    t.count = t.slots.count < left ? t.slots.count : (size_t)left;
    return t;
}

/// Where grain `k` of them would be.
static void draw_place(const step *s, int64_t index, const trial *t, size_t k, scree_vector at)
{
    const scree_model *model = s->c->model;
    if (t->layer)
        scree_source_draw_slot(model, &t->slots, k, t->reach, t->first + k, at);
    else
        scree_source_draw(model, &t->place, t->first, s->births->source[index].attempts, at);
}

/// What is in the way of one of them, which would be at `at`. All processes find something, or none does.
static obstacle look(const step *s, int64_t index, const trial *t, scree_vector at)
{
    const scree_context *c = s->c;
    obstacle by = {NOTHING, 0};
    for (size_t k = 0; k < t->count && by.what == NOTHING; k++) {
        draw_place(s, index, t, k, at);
        by = find_obstacle(c->state, c->work, at, scree_birth_reach(c->model, t->species, t->first + k));
    }
    double blocked = by.what != NOTHING;
    scree_comm_maximum(c->state, &blocked, 1);
    if (blocked > 0 && by.what == NOTHING) by.what = ELSEWHERE;
    return by;
}

/// All of them, when there is room for all.
static scree_status pour_next(step *s, int64_t index, scree_error *error)
{
    const scree_model *model = s->c->model;
    const trial t = make_trial(s, index);
    scree_vector at;
    scree_status status = SCREE_OK;
    const obstacle by = look(s, index, &t, at);
    if (by.what != NOTHING) return wait(s, index, at, &by, error);
    for (size_t k = 0; k < t.count && !status; k++) {
        draw_place(s, index, &t, k, at);
        status = give_birth(s, index, at, error);
    }
    if (!status) go_on(s, index, t.layer ? 0 : scree_source_layer(model, &model->sources[index], &t.place));
    return status;
}

/// A source begins when it pours first.
static void begin_source(const scree_state *state, scree_source_state *own)
{
    if (own->begun) return;
    *own = (scree_source_state){.begun = 1, .start = scree_state_time(state), .due = state->step};
    own->top = own->left = own->right = NAN;
}

/// Whether a source that is due looks where the top of the pile is: at the begin of a layer.
static bool looks_at_pile(const scree_config_source *source, const scree_source_state *own)
{
    return own->in_layer == 0 && own->attempts == 0 && scree_source_follows(source);
}

/// Whether one that stands above the top, and waits, looks where it is now: ten times before the stage has no more
/// patience, since the pile may have grown up to it within a layer.
static bool looks_again(const step *s, int64_t index)
{
    const scree_state *state = s->c->state;
    const scree_source_state *own = &s->births->source[index];
    const double patience = scree_pour_patience(s->c->model, s->stage, index);
    const uint64_t every = (uint64_t)ceil(0.1 * patience / state->tick), last = s->c->model->largest_step;
    const uint64_t waited = state->step - own->since;
    if (isnan(s->c->model->sources[index].above) || own->attempts == 0 || waited < last) return false;
    return waited / every > (waited - last) / every;
}

static scree_status pour_source(step *s, int64_t index, scree_error *error)
{
    const scree_context *c = s->c;
    const scree_config_source *source = &c->model->sources[index];
    scree_source_state *own = &s->births->source[index];
    scree_status status = SCREE_OK;
    begin_source(c->state, own);
    if (own->due < c->state->stage.first_step) own->due = c->state->stage.first_step;
    if (c->state->step < own->due || left_for(s, index) == 0) return SCREE_OK;
    if (looks_at_pile(source, own)) {
        if ((status = measure_pile(s, error))) return status;
        scree_source_begin_layer(c->model, source, &s->pile, own);
        if (left_for(s, index) == 0) return SCREE_OK;
    } else if (looks_again(s, index)) {
        if ((status = measure_pile(s, error))) return status;
        own->top = s->pile.top;
    }
    return pour_next(s, index, error);
}

/// What is due in this step.
typedef struct due {
    bool more;  ///< a source of the stage has grains left
    bool now;   ///< one of them has a birth due
    bool fresh; ///< one that has not been tried before
} due;

static due find_due(const step *s)
{
    const scree_context *c = s->c;
    due found = {false, false, false};
    for (int64_t k = 0; k < c->model->source_count; k++) {
        const scree_source_state *own = &s->births->source[k];
        if (!scree_source_pours_in(c->model, k, c->state->stage.index) || left_for(s, k) == 0) continue;
        const bool now = !own->begun || c->state->step >= own->due;
        found.more = true;
        found.now = found.now || now;
        found.fresh = found.fresh || (now && own->attempts == 0);
    }
    return found;
}

/// Why the sources of the stage have no grains left.
static scree_pour_end why_no_more(const step *s)
{
    const scree_model *model = s->c->model;
    if (s->stage->count > 0 && s->births->in_stage >= (uint64_t)s->stage->count) return SCREE_POUR_COUNT;
    for (int64_t k = 0; k < model->source_count && s->c->state->next_id < (uint64_t)model->count; k++)
        if (scree_source_pours_in(model, k, s->c->state->stage.index) &&
            scree_source_used_up(model, &model->sources[k], &s->births->source[k]))
            return SCREE_POUR_PLATEAU;
    return SCREE_POUR_OUT;
}

static scree_status pour_due(step *s, scree_error *error)
{
    const due found = find_due(s);
    scree_status status = SCREE_OK;
    if (!found.more)
        end(s, why_no_more(s));
    else if (found.fresh)
        status = check_extent(s, error);
    for (int64_t k = 0; k < s->c->model->source_count && found.now && !status; k++)
        if (s->births->end == SCREE_POUR_GOES_ON && scree_source_pours_in(s->c->model, k, s->c->state->stage.index))
            status = pour_source(s, k, error);
    return status;
}

// ---- the pass ----------------------------------------------------------------------------------------------------

static step begin_step(const scree_context *c)
{
    return (step){.c = c, .births = scree_births_of(c->state), .stage = scree_pour_config_of(c->model, c->state)};
}

static bool looks_for_lost(const scree_context *c)
{
    return c->state->evaluations % LOOK_STEPS == 0;
}

/// Whether a source needs all bodies: it begins, looks at the pile, has room for its birth, or ends the run.
static bool source_wants_all(const step *s, int64_t index)
{
    const scree_context *c = s->c;
    const scree_source_state *own = &s->births->source[index];
    if (!scree_source_pours_in(c->model, index, c->state->stage.index) || left_for(s, index) == 0) return false;
    if (!own->begun) return true;
    if (c->state->step < own->due) return false;
    if (looks_at_pile(&c->model->sources[index], own) || looks_again(s, index)) return true;
    scree_vector at;
    const trial t = make_trial(s, index);
    return look(s, index, &t, at).what == NOTHING || (own->attempts > 0 && is_over(s, index));
}

scree_status scree_pour_wants_all(const scree_context *c, bool *wanted, scree_error *error)
{
    const step s = begin_step(c);
    scree_status status = SCREE_OK;
    *wanted = false;
    if (looks_for_lost(c)) status = scree_pour_loses(c, wanted, error);
    if (status || *wanted || s.births->end != SCREE_POUR_GOES_ON) return status;
    const due found = find_due(&s);
    *wanted = found.fresh && wants_extent(s.stage);
    for (int64_t k = 0; k < c->model->source_count && found.now && !*wanted; k++) *wanted = source_wants_all(&s, k);
    return SCREE_OK;
}

scree_status scree_pour(const scree_context *c, scree_error *error)
{
    step s = begin_step(c);
    scree_status status = SCREE_OK;
    // Of a part scree_pour_wants_all has found that nothing is lost.
    if (looks_for_lost(c) && !c->state->part) status = scree_pour_look_for_lost(c, s.stage, error);
    if (!status && s.births->end == SCREE_POUR_GOES_ON) status = pour_due(&s, error);
    scree_pile_destroy(&s.pile);
    return status;
}
