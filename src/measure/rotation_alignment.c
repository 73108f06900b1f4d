/// What rotations have to do with the force network around the forced body. See rotation.h. Cost: O(bodies x strong
/// contacts) within the cut-off, O(contacts) for the rest.
#include "base/memory.h"
#include "measure/rotation_parts.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_statistics_double.h>
#include <math.h>

/// Inclined by more than 45 degrees.
#define ACROSS M_SQRT1_2

/// A contact that a straight line from the forced body may have to cross.
typedef struct barrier {
    uint32_t first, second; ///< rows
    double end[2][2];       ///< m, seen from the forced body
    scree_vector branch;    ///< unit
} barrier;

/// One body that counts.
typedef struct witness {
    double excess, alignment; ///< 1
    size_t bin, sector;
    bool behind;
} witness;

typedef struct scene {
    const scree_state *state;
    size_t forced;
    scree_vector centre;
    double *weight, *aligned; ///< per row: sums of f, and of f times the alignment of the contact, over the contacts
    barrier *barrier;
    size_t barriers;
    witness *witness;
    size_t witnesses;
    double *x, *y, *work; ///< of the ranks
} scene;

static void from_centre(const scene *s, size_t row, scree_vector out)
{
    scree_body_position(s->state, row, out);
    for (int i = 0; i < 3; i++) out[i] -= s->centre[i];
}

static void add_contact(scene *s, const scree_contact *contact)
{
    scree_vector branch;
    for (int i = 0; i < 3; i++) branch[i] = contact->branch[i];
    (void)scree_rotation_normalise(branch);
    for (int side = 0; side < 2; side++) {
        size_t row = side ? contact->second : contact->first;
        if (row == s->forced) continue;
        scree_vector outward;
        from_centre(s, row, outward);
        (void)scree_rotation_normalise(outward);
        double cosine = scree_rotation_dot(outward, branch), square = cosine * cosine;
        double force = scree_rotation_force(contact);
        s->weight[row] += force;
        s->aligned[row] += force * (s->state->dimension == 2 ? 2 * square - 1 : 1.5 * square - 0.5);
    }
}

static void add_barrier(scene *s, const scree_contact *contact)
{
    if (contact->first == s->forced || contact->second == s->forced) return;
    barrier *b = &s->barrier[s->barriers++];
    *b = (barrier){.first = contact->first, .second = contact->second};
    for (int i = 0; i < 3; i++) b->branch[i] = contact->branch[i];
    (void)scree_rotation_normalise(b->branch);
    scree_vector end;
    from_centre(s, contact->first, end);
    for (int i = 0; i < 2; i++) {
        b->end[0][i] = end[i];
        b->end[1][i] = end[i] - contact->branch[i];
    }
}

static void read_contacts(scene *s, const scree_contact_table *table)
{
    double mean = scree_rotation_mean_force(table);
    for (size_t c = 0; c < table->count; c++) {
        if (table->contact[c].wall) continue;
        add_contact(s, &table->contact[c]);
        if (s->state->dimension == 2 && scree_rotation_force(&table->contact[c]) > mean)
            add_barrier(s, &table->contact[c]);
    }
}

static double cross(const double a[2], const double b[2])
{
    return a[0] * b[1] - a[1] * b[0];
}

/// Whether the line from the forced body to `position` crosses the barrier.
static bool crosses(const barrier *b, const scree_vector position)
{
    const double to_second[2] = {b->end[1][0] - b->end[0][0], b->end[1][1] - b->end[0][1]};
    const double to_place[2] = {position[0] - b->end[0][0], position[1] - b->end[0][1]};
    const double to_centre[2] = {-b->end[0][0], -b->end[0][1]};
    // The ends lie on both sides of the line, and its ends on both sides of the contact.
    return cross(position, b->end[0]) * cross(position, b->end[1]) < 0 &&
           cross(to_second, to_centre) * cross(to_second, to_place) < 0;
}

static bool is_behind(const scene *s, size_t row, const scree_vector position, const scree_vector outward)
{
    for (size_t k = 0; k < s->barriers; k++) {
        const barrier *b = &s->barrier[k];
        if (b->first == row || b->second == row) continue;
        if (fabs(scree_rotation_dot(outward, b->branch)) < ACROSS && crosses(b, position)) return true;
    }
    return false;
}

/// The bodies that count within `limit` [mean diameters]; excess is the logarithm of the amount still.
static void find_witnesses(scene *s, double diameter, double limit, const scree_rotation_network *network)
{
    size_t id = 0;
    for (uint32_t row; (row = scree_next_by_id(s->state, &id)) != SCREE_NO_ROW;) {
        double own = scree_rotation_amount(s->state, row);
        if (row == s->forced || !scree_rotation_counts(s->state, row) || !(s->weight[row] > 0 && own > 0)) continue;
        scree_vector position, outward;
        from_centre(s, row, position);
        from_centre(s, row, outward);
        double distance = scree_rotation_normalise(outward) / diameter;
        size_t bin = scree_rotation_bin_at(distance);
        if (!(distance < limit) || bin == SCREE_ROTATION_BINS) continue;
        s->witness[s->witnesses++] = (witness){.excess = log(own),
                                               .alignment = s->aligned[row] / s->weight[row],
                                               .bin = bin,
                                               .sector = scree_rotation_sector(s->state->dimension, network, outward),
                                               .behind = is_behind(s, row, position, outward)};
    }
}

static void subtract_means(scene *s)
{
    double sum[SCREE_ROTATION_BINS] = {0}, count[SCREE_ROTATION_BINS] = {0};
    for (size_t k = 0; k < s->witnesses; k++) {
        sum[s->witness[k].bin] += s->witness[k].excess;
        count[s->witness[k].bin]++;
    }
    for (size_t k = 0; k < s->witnesses; k++) s->witness[k].excess -= sum[s->witness[k].bin] / count[s->witness[k].bin];
}

/// Spearman's rank correlation with Fisher's z and the variance of Bonett and Wright.
static scree_rank_correlation correlate(const scene *s, size_t count)
{
    scree_rank_correlation r = {NAN, NAN, NAN, count};
    if (count < 4) return r;
    r.value = gsl_stats_spearman(s->x, 1, s->y, 1, count, s->work);
    double z = atanh(r.value), half = sqrt((1 + 0.5 * r.value * r.value) / ((double)count - 3));
    half *= gsl_cdf_ugaussian_Pinv(0.975);
    r.low = tanh(z - half);
    r.high = tanh(z + half);
    return r;
}

static scree_rank_correlation correlate_bodies(const scene *s)
{
    for (size_t k = 0; k < s->witnesses; k++) {
        s->x[k] = s->witness[k].alignment;
        s->y[k] = s->witness[k].excess;
    }
    return correlate(s, s->witnesses);
}

static scree_rank_correlation correlate_sectors(const scene *s, scree_rotation_network *network)
{
    double sum[SCREE_ROTATION_SECTORS] = {0}, count[SCREE_ROTATION_SECTORS] = {0};
    size_t sectors = 0;
    for (size_t k = 0; k < s->witnesses; k++) {
        sum[s->witness[k].sector] += s->witness[k].excess;
        count[s->witness[k].sector]++;
    }
    for (size_t k = 0; k < SCREE_ROTATION_SECTORS; k++) {
        if (count[k] == 0) continue;
        network->followed[k] = sum[k] / count[k];
        s->x[sectors] = network->rose[k];
        s->y[sectors++] = network->followed[k];
    }
    return correlate(s, sectors);
}

/// Difference of the mean excess of the two groups in each shell, put together; see rotation.h.
static scree_rotation_ratio compare_groups(const scene *s)
{
    double sum[SCREE_ROTATION_BINS][2] = {{0}}, count[SCREE_ROTATION_BINS][2] = {{0}};
    double weights = 0, difference = 0, squares = 0, freedom = 0;
    scree_rotation_ratio ratio = {.value = NAN, .low = NAN, .high = NAN};
    for (size_t k = 0; k < s->witnesses; k++) {
        const witness *w = &s->witness[k];
        sum[w->bin][w->behind] += w->excess;
        count[w->bin][w->behind]++;
    }
    for (size_t b = 0; b < SCREE_ROTATION_BINS; b++) {
        const double *n = count[b];
        if (n[0] == 0 || n[1] == 0) continue;
        double weight = n[0] * n[1] / (n[0] + n[1]);
        weights += weight;
        difference += weight * (sum[b][1] / n[1] - sum[b][0] / n[0]);
        freedom += n[0] + n[1] - 2;
        ratio.elsewhere += (size_t)n[0];
        ratio.behind += (size_t)n[1];
    }
    if (!(weights > 0)) return ratio;
    for (size_t k = 0; k < s->witnesses; k++) {
        const witness *w = &s->witness[k];
        if (count[w->bin][0] == 0 || count[w->bin][1] == 0) continue;
        squares += pow(w->excess - sum[w->bin][w->behind] / count[w->bin][w->behind], 2);
    }
    double half = gsl_cdf_ugaussian_Pinv(0.975) * sqrt(squares / freedom / weights);
    ratio.value = exp(difference / weights);
    ratio.low = exp(difference / weights - half);
    ratio.high = exp(difference / weights + half);
    return ratio;
}

scree_status scree_rotation_alignment_measure(const scree_model *model, const scree_state *state,
                                              const scree_contact_table *table, size_t forced, double cutoff,
                                              const scree_rotation_decay *decay, scree_rotation_network *network,
                                              scree_rotation_alignment *alignment, scree_error *error)
{
    scene s = {.state = state, .forced = forced};
    size_t most = state->count + SCREE_ROTATION_SECTORS;
    double **const arrays[] = {&s.weight, &s.aligned, &s.x, &s.y};
    scree_status status = scree_allocate(&s.work, 2 * most, sizeof *s.work, error);
    for (size_t k = 0; k < sizeof arrays / sizeof *arrays && !status; k++)
        status = scree_allocate(arrays[k], most, sizeof **arrays[k], error);
    if (!status) status = scree_allocate(&s.barrier, table->count, sizeof *s.barrier, error);
    if (!status) status = scree_allocate(&s.witness, state->count, sizeof *s.witness, error);
    if (!status) {
        scree_body_position(state, forced, s.centre);
        read_contacts(&s, table);
        find_witnesses(&s, 2 * model->mean_radius, fmin(cutoff, decay->reach), network);
        subtract_means(&s);
        alignment->alignment = correlate_bodies(&s);
        alignment->chains = correlate_sectors(&s, network);
        alignment->across = compare_groups(&s);
    }
    for (size_t k = 0; k < sizeof arrays / sizeof *arrays; k++) scree_release(arrays[k]);
    scree_release(&s.work);
    scree_release(&s.barrier);
    scree_release(&s.witness);
    return status;
}
