/// Transmission of rotations: hand-made networks around a forced body whose answers are known.
#include "testing.h"

#include "base/random.h"
#include "measure/rotation_parts.h"

#include <math.h>
#include <string.h>

#define RADIUS 1e-3
#define DECAY  3.0 /* mean diameters */

enum { RINGS = 14 };

typedef struct cluster {
    scree_model model;
    scree_state state;
    scree_contact_table table;
    size_t forced;
} cluster;

static double uniform(uint64_t index)
{
    return scree_random_uniform(3, SCREE_RANDOM_TEST, index);
}

static size_t count_places(int dimension, double (*places)[3])
{
    size_t count = 0;
    double limit = 2 * RADIUS * RINGS, layers = dimension == 3 ? RINGS : 0, height = sqrt(3) * RADIUS;
    // A triangular lattice in the plane, a simple stack of square ones in space.
    for (double k = -layers; k <= layers; k++)
        for (double j = -20; j <= 20; j++)
            for (double i = -20; i <= 20; i++) {
                double x = dimension == 2 ? (2 * i + j) * RADIUS : 2 * i * RADIUS;
                double place[3] = {x, j * (dimension == 2 ? height : 2 * RADIUS), 2 * k * RADIUS};
                if (!(scree_length(place) <= limit)) continue;
                if (places) memcpy(places[count], place, sizeof place);
                count++;
            }
    return count;
}

static void add_contact(cluster *c, size_t first, size_t second, double force)
{
    scree_contact *contact = &c->table.contact[c->table.count++];
    scree_vector a, b;
    scree_body_position(&c->state, first, a);
    scree_body_position(&c->state, second, b);
    *contact = (scree_contact){.first = (uint32_t)first, .second = (uint32_t)second, .normal_force = force};
    for (int i = 0; i < 3; i++) contact->branch[i] = a[i] - b[i];
}

/// Bodies on a lattice that touch their neighbours with equal forces; spins fall as exp(-r / DECAY).
static void create(cluster *c, int dimension)
{
    double(*places)[3] = NULL;
    size_t count = count_places(dimension, NULL);
    *c = (cluster){.model = {.dimension = dimension, .mean_radius = RADIUS}};
    assert_int_equal(scree_state_create(&c->state, dimension, count, NULL), SCREE_OK);
    assert_int_equal(scree_allocate(&c->table.contact, 6 * count, sizeof *c->table.contact, NULL), SCREE_OK);
    assert_int_equal(scree_allocate(&places, count, sizeof *places, NULL), SCREE_OK);
    (void)count_places(dimension, places);
    for (size_t k = 0; k < count; k++) {
        double distance = scree_length(places[k]), spin = 0.03 * exp(-distance / (2 * RADIUS * DECAY));
        c->state.row[k] = (scree_row){.x = places[k][0], .y = places[k][1], .radius = RADIUS, .mass = 1};
        if (dimension == 3) {
            c->state.row[k].z = places[k][2];
            c->state.turn[k] = (scree_turn_row){.wx = 0.6 * spin, .wz = -0.8 * spin};
        } else {
            c->state.angle[k] = k % 2 ? spin : -spin;
        }
        c->state.sum[k].contacts = 2;
        if (distance < 1e-9) c->forced = k;
        for (size_t j = 0; j < k; j++) {
            double apart[3];
            for (int i = 0; i < 3; i++) apart[i] = places[k][i] - places[j][i];
            if (scree_length(apart) < 2.001 * RADIUS) add_contact(c, j, k, 2);
        }
    }
    scree_release(&places);
}

/// Segments exactly across have no direction away from the forced body; these tests leave them out.
static void drop_segments_across(cluster *c)
{
    for (size_t k = 0; k < c->table.count; k++) {
        scree_contact *contact = &c->table.contact[k];
        scree_vector a, b;
        scree_body_position(&c->state, contact->first, a);
        scree_body_position(&c->state, contact->second, b);
        double product = 0;
        for (int i = 0; i < 3; i++) product += (a[i] + b[i]) / 2 * contact->branch[i];
        if (fabs(product) < 1e-9 * RADIUS * RADIUS) contact->normal_force = 0;
    }
}

static void destroy(cluster *c)
{
    scree_state_destroy(&c->state);
    scree_release(&c->table.contact);
}

/// The same in all shells.
static scree_rotation_background everywhere(double value)
{
    scree_rotation_background background = {.mean = value};
    for (int b = 0; b < SCREE_ROTATION_BINS; b++) background.shell[b] = value;
    return background;
}

/// What a shell must reach follows from what it did itself at rest.
static void shells_have_backgrounds_of_their_own(void **unused)
{
    (void)unused;
    cluster c;
    scree_rotation_decay decay;
    scree_rotation_background rest;
    create(&c, 2);
    // At rest a tenth of what there is under forcing, but in the fifth shell, from 4.5 diameters on, as much.
    for (size_t k = 0; k < c.state.count; k++) {
        const double away = hypot(c.state.row[k].x, c.state.row[k].y) / (2 * RADIUS);
        c.state.angle[k] *= k == c.forced || (away >= 4.5 && away < 5.5) ? 1 : 0.1;
    }
    const double driven = fabs(c.state.angle[c.forced]);
    scree_rotation_background_measure(&c.model, &c.state, c.forced, driven, &rest);
    for (size_t k = 0; k < c.state.count; k++) {
        const double away = hypot(c.state.row[k].x, c.state.row[k].y) / (2 * RADIUS);
        c.state.angle[k] /= k == c.forced || (away >= 4.5 && away < 5.5) ? 1 : 0.1;
    }
    scree_rotation_decay_measure(&c.model, &c.state, c.forced, NULL, &decay);
    assert_true(decay.reach > 5.5);
    assert_true(fabs(rest.shell[2] / (0.1 * decay.bin[2].mean) - 1) < 1e-12);
    assert_true(fabs(rest.shell[4] / decay.bin[4].mean - 1) < 1e-12);
    assert_true(isnan(rest.shell[SCREE_ROTATION_BINS - 1]));
    assert_true(fabs(rest.mean / (scree_rotation_mean_amount(&c.state, c.forced) / driven) - 0.1) < 0.2);
    scree_rotation_decay_measure(&c.model, &c.state, c.forced, &rest, &decay);
    assert_true(decay.reach == 4.5);
    assert_true(fabs(decay.bin[4].felt - 2 * rest.shell[4]) < 1e-12);
    destroy(&c);
}

static void an_exponential_decay_is_found(void **unused)
{
    (void)unused;
    for (int dimension = 2; dimension <= 3; dimension++) {
        cluster c;
        scree_rotation_decay decay;
        create(&c, dimension);
        scree_rotation_decay_measure(&c.model, &c.state, c.forced, NULL, &decay);
        // Shells are a diameter wide, and bodies lie anywhere in them: a quarter of one in 14 diameters.
        assert_true(fabs(decay.length - DECAY) < 0.02 * DECAY);
        // The interval is that of the scatter about the line; that of the places in the shells comes on top of it.
        assert_true(decay.length_low < 1.02 * DECAY && 0.98 * DECAY < decay.length_high);
        assert_true(decay.length_high - decay.length_low < 0.1 * DECAY);
        assert_true(fabs(log(decay.amplitude)) < 0.1);
        // The median of the outer seven shells is that of the one around 11 diameters, 0.0256; exp(-r / DECAY) is twice
        // that at 8.9, in the shell from 8.5 to 9.5. And it is 0.12, twice the background, at 6.4.
        assert_true(decay.reach == 8.5 || decay.reach == 9.5);
        scree_rotation_decay other;
        const scree_rotation_background background = everywhere(0.06);
        scree_rotation_decay_measure(&c.model, &c.state, c.forced, &background, &other);
        assert_true(other.reach == 6.5 && other.fitted == 6);
        size_t counted = 0;
        for (size_t b = 0; b < decay.bin_count; b++) counted += decay.bin[b].count;
        assert_int_equal(counted, c.state.count - 1);
        destroy(&c);
    }
}

/// Means and standard errors of the shells from the bodies in them; the line through the logarithms of the means with
/// the numbers of bodies as weights, and Student's interval of its slope, from their formulas.
static void shells_and_the_fit_have_their_formulas(void **unused)
{
    (void)unused;
    cluster c;
    scree_rotation_decay decay;
    create(&c, 2);
    for (size_t k = 0; k < c.state.count; k++) c.state.angle[k] *= k == c.forced ? 1 : exp(2 * uniform(k) - 1);
    const scree_rotation_background background = everywhere(0.06);
    scree_rotation_decay_measure(&c.model, &c.state, c.forced, &background, &decay);
    for (size_t b = 0; b < decay.bin_count; b++) {
        double n = 0, sum = 0, squares = 0, driven = fabs(c.state.angle[c.forced]);
        for (int pass = 0; pass < 2; pass++)
            for (size_t k = 0; k < c.state.count; k++) {
                double away = hypot(c.state.row[k].x, c.state.row[k].y) / (2 * RADIUS) - decay.bin[b].lower;
                double ratio = fabs(c.state.angle[k]) / driven;
                if (k == c.forced || away < 0 || away >= 1) continue;
                n += pass == 0;
                sum += pass == 0 ? ratio : 0;
                squares += pass == 1 ? (ratio - sum / n) * (ratio - sum / n) : 0;
            }
        assert_true(fabs(decay.bin[b].mean - sum / n) < 1e-12);
        assert_true(fabs(decay.bin[b].standard_error / sqrt(squares / (n - 1) / n) - 1) < 1e-9);
    }
    double w = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
    assert_int_equal(decay.fitted, 6);
    for (size_t b = 0; b < decay.fitted; b++) {
        const scree_rotation_bin *bin = &decay.bin[b];
        double weight = (double)bin->count, value = log(bin->mean);
        w += weight;
        x += weight * bin->distance;
        y += weight * value;
        xx += weight * bin->distance * bin->distance;
        xy += weight * bin->distance * value;
        yy += weight * value * value;
    }
    double sxx = xx - x * x / w, sxy = xy - x * y / w, syy = yy - y * y / w, slope = sxy / sxx;
    // Quantile 0.975 of Student's distribution with four degrees of freedom, from tables.
    double half = 2.77644511 * sqrt((syy - slope * sxy) / 4 / sxx);
    assert_true(fabs(decay.length * -slope - 1) < 1e-9);
    assert_true(fabs(decay.length_low * (half - slope) - 1) < 1e-7);
    assert_true(fabs(decay.length_high * (-half - slope) - 1) < 1e-7);
    destroy(&c);
}

/// Directions anywhere on the sphere fall into its sectors, caps and zones about the first axis, alike.
static void sectors_have_equal_solid_angles(void **unused)
{
    (void)unused;
    enum { DRAWS = 36000 };
    scree_rotation_network network = {.axis = {{0.6, 0, 0.8}}};
    const scree_vector ahead = {0.6, 0, 0.8}, astern = {-0.6, 0, -0.8};
    size_t count[SCREE_ROTATION_SECTORS] = {0};
    for (uint64_t k = 0; k < DRAWS; k++) {
        double height = 2 * uniform(2 * k) - 1, angle = 2 * M_PI * uniform(2 * k + 1), r = sqrt(1 - height * height);
        const scree_vector outward = {r * cos(angle), r * sin(angle), height};
        count[scree_rotation_sector(3, &network, outward)]++;
    }
    // Five times the square root of the thousand in each.
    for (int k = 0; k < SCREE_ROTATION_SECTORS; k++)
        assert_true(fabs((double)count[k] - (double)DRAWS / SCREE_ROTATION_SECTORS) < 5 * sqrt(1000));
    assert_int_equal(scree_rotation_sector(3, &network, ahead), 0);
    assert_int_equal(scree_rotation_sector(3, &network, astern), SCREE_ROTATION_SECTORS - 1);
}

static void spins_that_do_not_decay_have_no_reach(void **unused)
{
    (void)unused;
    cluster c;
    scree_rotation_decay decay;
    create(&c, 2);
    for (size_t k = 0; k < c.state.count; k++) c.state.angle[k] = 0.01 * (0.5 + uniform(k));
    // All of it is there without forcing too.
    const scree_rotation_background background = everywhere(1);
    scree_rotation_decay_measure(&c.model, &c.state, c.forced, &background, &decay);
    assert_true(decay.reach == 0 && decay.fitted == 0 && isnan(decay.length));
    destroy(&c);
}

/// A body that touches one other or none keeps its spin for ever; it is not counted.
static void bodies_that_nothing_holds_do_not_count(void **unused)
{
    (void)unused;
    cluster c;
    scree_rotation_decay with, without;
    create(&c, 2);
    scree_rotation_decay_measure(&c.model, &c.state, c.forced, NULL, &without);
    size_t loose = c.forced + 7;
    double mean = scree_rotation_mean_amount(&c.state, c.forced);
    c.state.angle[loose] = 1e3;
    c.state.sum[loose].contacts = 1;
    assert_true(!scree_rotation_counts(&c.state, loose) && scree_rotation_counts(&c.state, c.forced));
    scree_rotation_decay_measure(&c.model, &c.state, c.forced, NULL, &with);
    // One of more than six hundred bodies is missing.
    assert_true(fabs(with.length / without.length - 1) < 0.01);
    assert_true(fabs(scree_rotation_mean_amount(&c.state, c.forced) / mean - 1) < 0.01);
    destroy(&c);
}

/// A strong contact across the way: the bodies in its shadow turn half as much as the others in their shells.
static void rotations_behind_a_strong_chain(void **unused)
{
    (void)unused;
    cluster c;
    scree_rotation_decay decay;
    scree_rotation_network network;
    scree_rotation_alignment alignment;
    create(&c, 2);
    size_t shadowed = 0;
    // A chain along y at x = 3.5 diameters, between y = -3 and 3, is strong; it has no neighbours that bear as much.
    c.table.count = 0;
    for (size_t k = 1; k < c.state.count; k++)
        if (k != c.forced) add_contact(&c, k, k - 1 == c.forced ? k - 2 : k - 1, 1e-3);
    c.table.contact[0] = (scree_contact){.first = 0, .second = 1, .normal_force = 1};
    c.state.row[0].x = c.state.row[1].x = 7 * RADIUS;
    c.state.row[0].y = 6 * RADIUS;
    c.state.row[1].y = -6 * RADIUS;
    c.table.contact[0].branch[1] = 12 * RADIUS;
    for (size_t k = 2; k < c.state.count; k++) {
        const scree_row *row = &c.state.row[k];
        bool behind = row->x > 7 * RADIUS && fabs(row->y) < row->x * 6 / 7;
        shadowed += behind;
        if (behind) c.state.angle[k] *= 0.5;
    }
    scree_rotation_decay_measure(&c.model, &c.state, c.forced, NULL, &decay);
    scree_rotation_network_measure(&c.model, &c.state, &c.table, c.forced, 10, &network);
    assert_int_equal(scree_rotation_alignment_measure(&c.model, &c.state, &c.table, c.forced, 100, &decay, &network,
                                                      &alignment, NULL),
                     SCREE_OK);
    assert_true(alignment.across.behind > 50 && alignment.across.behind <= shadowed);
    // Inside a shell of one diameter the spins fall by exp(-1/3), which shifts the means of the groups a little.
    assert_true(fabs(alignment.across.value - 0.5) < 0.02);
    assert_true(alignment.across.low < 0.5 && alignment.across.high > 0.5 && alignment.across.high < 0.6);
    // Turned by more than 45 degrees it leads rotations outward, and hides nothing.
    c.state.row[0].x = 5 * RADIUS, c.state.row[0].y = 1.2 * RADIUS;
    c.state.row[1].x = 13 * RADIUS, c.state.row[1].y = -1.2 * RADIUS;
    c.table.contact[0].branch[0] = -8 * RADIUS, c.table.contact[0].branch[1] = 2.4 * RADIUS;
    assert_int_equal(scree_rotation_alignment_measure(&c.model, &c.state, &c.table, c.forced, 100, &decay, &network,
                                                      &alignment, NULL),
                     SCREE_OK);
    assert_int_equal(alignment.across.behind, 0);
    destroy(&c);
}

/// Six like bonds around the body and everything else by symmetry: T is isotropic and symmetric.
/// To the right forces are strong and rotations decay half as fast as to the left.
static void contacts_hand_on_what_their_bodies_say(void **unused)
{
    (void)unused;
    for (int dimension = 2; dimension <= 3; dimension++) {
        cluster c;
        scree_rotation_transmission all, near;
        create(&c, dimension);
        double driven = scree_rotation_amount(&c.state, c.forced);
        for (size_t k = 0; k < c.state.count; k++)
            if (fabs(c.state.row[k].x) < 1e-9) {
                c.state.sum[k].contacts = 1; // does not count
            } else if (c.state.row[k].x < 0) {
                double factor = scree_rotation_amount(&c.state, k) / driven;
                if (dimension == 2) {
                    c.state.angle[k] *= factor;
                    continue;
                }
                c.state.turn[k].wx *= factor;
                c.state.turn[k].wz *= factor;
            }
        for (size_t k = 0; k < c.table.count; k++) {
            scree_contact *contact = &c.table.contact[k];
            double middle = c.state.row[contact->first].x + c.state.row[contact->second].x;
            contact->normal_force = middle > 1e-9 ? 3 : 1;
        }
        scree_rotation_transmission_measure(&c.model, &c.state, &c.table, c.forced, 10, 0, &all);
        // The two sides mirror each other; those in the middle do not count.
        assert_true(all.strong.count > 50 && all.weak.count > 50 && all.aside.count > 50);
        assert_true(fabs(log(all.weak.value) / log(all.strong.value) - 2) < 1e-9);
        // Between the centres of two bodies in contact that lead outward there are 0.7 to 1 diameters.
        assert_true(all.strong.value > exp(-1 / DECAY) && all.strong.value < exp(-M_SQRT1_2 / DECAY));
        assert_true(log(all.aside.value) > 0.7 * log(all.strong.value));
        // Only what is felt: exp(-6 / DECAY) is 6 diameters on the right and 3 on the left.
        scree_rotation_transmission_measure(&c.model, &c.state, &c.table, c.forced, 10, exp(-6 / DECAY), &near);
        assert_true((double)near.weak.count < 0.5 * (double)near.strong.count && near.strong.count < all.strong.count);
        destroy(&c);
    }
}

/// Bodies in pairs that touch, radially from the forced one, on both sides of the major direction, which is y: by force
/// over the mean of 4 N and by angle each bin is known, and so are its mean and its interval.
static void contacts_are_sorted_by_force_and_angle(void **unused)
{
    (void)unused;
    static const double angle[] = {5, 20, 35, 50, 65, 80}, force[] = {10, 7, 5, 3, 1, 1.2}, spread = 1.3;
    enum { PAIRS = 14 }; // the last two do not count: their force makes the mean one 4 N
    cluster c = {.model = {.dimension = 2, .mean_radius = RADIUS}};
    assert_int_equal(scree_state_create(&c.state, 2, 1 + 2 * PAIRS, NULL), SCREE_OK);
    assert_int_equal(scree_allocate(&c.table.contact, PAIRS, sizeof *c.table.contact, NULL), SCREE_OK);
    c.state.row[0] = (scree_row){.radius = RADIUS, .mass = 1};
    c.state.angle[0] = 0.03;
    for (size_t k = 0; k < PAIRS; k++) {
        const bool counts = k < PAIRS - 2;
        const double side = k % 2 ? 1 : -1, turn = counts ? side * angle[k / 2] * M_PI / 180 : 0;
        for (size_t end = 0; end < 2; end++) {
            const size_t row = 1 + 2 * k + end;
            const double distance = (3 + (double)end) * 2 * RADIUS;
            c.state.row[row] =
                (scree_row){.x = distance * sin(turn), .y = distance * cos(turn), .radius = RADIUS, .mass = 1};
            c.state.sum[row].contacts = counts ? 2 : 1;
            c.state.angle[row] = end == 0 ? 0.01 : -0.01 / (double)(2 + k / 2) * pow(spread, side);
        }
        add_contact(&c, 1 + 2 * k, 2 + 2 * k, counts ? force[k / 2] : 0.8);
        scree_contact *contact = &c.table.contact[k];
        for (int i = 0; i < 3; i++) contact->normal[i] = contact->branch[i] / (2 * RADIUS);
    }
    scree_rotation_transmission t;
    scree_rotation_transmission_measure(&c.model, &c.state, &c.table, 0, 10, 0.1, &t);
    assert_true(fabs(t.major[1] - 1) < 1e-12);
    for (size_t k = 0; k < 6; k++) {
        const scree_rotation_handed *bin = &t.by_angle[k];
        const double value = 1 / (double)(2 + k), width = exp(1.959964 * log(spread));
        assert_int_equal(bin->count, 2);
        assert_true(fabs(bin->value / value - 1) < 1e-9 && fabs(bin->low * width / value - 1) < 1e-9);
        assert_true(fabs(bin->high / width / value - 1) < 1e-9 && fabs(bin->force - force[k] / 4) < 1e-9);
        assert_true(fabs(bin->angle - angle[k] * M_PI / 180) < 1e-9);
    }
    // 2.5, 1.75, 1.25, 0.75 of the mean have a bin each, 0.25 and 0.3 one together.
    for (size_t k = 0; k < 4; k++) assert_true(fabs(t.by_force[4 - k].value * (double)(2 + k) - 1) < 1e-9);
    assert_int_equal(t.by_force[0].count, 4);
    assert_true(fabs(t.by_force[0].value - 1 / sqrt(6 * 7)) < 1e-9 && fabs(t.by_force[0].force - 1.1 / 4) < 1e-9);
    // What turns by less than is felt hands on nothing.
    scree_rotation_transmission_measure(&c.model, &c.state, &c.table, 0, 10, 0.4, &t);
    assert_true(t.by_angle[0].count == 0 && isnan(t.by_angle[0].value) && isnan(t.by_force[0].low));
    destroy(&c);
}

/// Three pairs lead outward and hand on different shares; at the outer end of each a third body bears a strong contact:
/// across, at 40 degrees to the branch (a chain that leads on), and across, but weak.
static void strong_chains_cross_what_leads_outward(void **unused)
{
    (void)unused;
    static const double across[] = {90, 40, 90}, force[] = {5, 5, 0.5}, handed[] = {0.25, 0.5, 0.8};
    enum { ARMS = 3 };
    cluster c = {.model = {.dimension = 2, .mean_radius = RADIUS}};
    assert_int_equal(scree_state_create(&c.state, 2, 1 + 3 * ARMS, NULL), SCREE_OK);
    assert_int_equal(scree_allocate(&c.table.contact, 2 * ARMS, sizeof *c.table.contact, NULL), SCREE_OK);
    c.state.row[0] = (scree_row){.radius = RADIUS, .mass = 1};
    c.state.angle[0] = 0.03;
    for (size_t arm = 0; arm < ARMS; arm++) {
        const double turn = (20 + 120 * (double)arm) * M_PI / 180, aside = turn + across[arm] * M_PI / 180;
        const size_t inner = 1 + 3 * arm, outer = inner + 1, third = outer + 1;
        for (size_t end = 0; end < 2; end++) {
            const double distance = (3 + (double)end) * 2 * RADIUS;
            c.state.row[inner + end] =
                (scree_row){.x = distance * cos(turn), .y = distance * sin(turn), .radius = RADIUS, .mass = 1};
        }
        c.state.row[third] = c.state.row[outer];
        c.state.row[third].x += 2 * RADIUS * cos(aside);
        c.state.row[third].y += 2 * RADIUS * sin(aside);
        for (size_t end = 0; end < 3; end++) c.state.sum[inner + end].contacts = 2;
        c.state.sum[third].contacts = 1; // does not count, and hands on nothing
        c.state.angle[inner] = 0.01;
        c.state.angle[outer] = -0.01 * handed[arm];
        add_contact(&c, arm % 2 ? outer : inner, arm % 2 ? inner : outer, 1);
        add_contact(&c, third, outer, force[arm]);
    }
    scree_rotation_transmission t;
    scree_rotation_transmission_measure(&c.model, &c.state, &c.table, 0, 10, 0.1, &t);
    assert_int_equal(t.crossed.count, 1);
    assert_true(fabs(t.crossed.value - handed[0]) < 1e-9);
    assert_int_equal(t.open.count, 2);
    assert_true(fabs(t.open.value - sqrt(handed[1] * handed[2])) < 1e-9);
    destroy(&c);
}

static void an_isotropic_network_has_an_isotropic_tensor(void **unused)
{
    (void)unused;
    for (int dimension = 2; dimension <= 3; dimension++) {
        cluster c;
        scree_rotation_network network;
        create(&c, dimension);
        drop_segments_across(&c);
        scree_rotation_network_measure(&c.model, &c.state, &c.table, c.forced, 10, &network);
        double scale = network.value[0];
        assert_true(scale > 0 && network.contacts > 100);
        for (int i = 0; i < dimension; i++)
            for (int j = 0; j < dimension; j++) {
                double expected = i == j ? network.tensor[0] : 0;
                assert_true(fabs(network.tensor[3 * i + j] - expected) < 1e-12 * (double)network.contacts * scale);
            }
        destroy(&c);
    }
}

/// P: diagonal if all segments are radial, off-diagonal if all are tangential.
static void radial_and_tangential_segments(void **unused)
{
    (void)unused;
    cluster c;
    scree_rotation_network network;
    create(&c, 2);
    c.table.count = 2;
    // One segment on the x axis, its middle at 3 diameters; then one there across it; f / <f> = 1.
    for (int across = 0; across < 2; across++) {
        c.state.row[0].x = 6 * RADIUS + (across ? 0 : RADIUS);
        c.state.row[0].y = across ? RADIUS : 0;
        c.state.row[1].x = 6 * RADIUS - (across ? 0 : RADIUS);
        c.state.row[1].y = across ? -RADIUS : 0;
        c.table.count = 0;
        add_contact(&c, 1, 0, 7);
        scree_rotation_network_measure(&c.model, &c.state, &c.table, c.forced, 10, &network);
        double whole = 1 / (6 * RADIUS);
        assert_int_equal(network.contacts, 1);
        assert_true(fabs(network.tensor[0] - (across ? 0 : whole)) < 1e-12 * whole);
        assert_true(fabs(fabs(network.tensor[1]) - (across ? whole : 0)) < 1e-12 * whole);
        assert_true(fabs(network.rose[0] + network.rose[SCREE_ROTATION_SECTORS - 1] - (across ? 0 : whole)) <
                    1e-12 * whole);
        if (!across) assert_true(fabs(fabs(network.axis[0][0]) - 1) < 1e-12);
        scree_rotation_network_measure(&c.model, &c.state, &c.table, c.forced, 2.9, &network);
        assert_int_equal(network.contacts, 0);
    }
    destroy(&c);
}

/// Strong contacts along one lattice direction through the forced body, where spins are larger too; then smaller.
static void rotations_that_follow_chains_correlate(void **unused)
{
    (void)unused;
    for (int sign = -1; sign <= 1; sign++) {
        cluster c;
        scree_rotation_decay decay;
        scree_rotation_network network;
        scree_rotation_alignment alignment;
        create(&c, 2);
        for (size_t k = 0; k < c.table.count; k++) {
            scree_contact *contact = &c.table.contact[k];
            if (fabs(contact->branch[1]) < 1e-9) contact->normal_force = 10 + uniform(k);
        }
        for (size_t k = 0; k < c.state.count; k++) {
            scree_row *row = &c.state.row[k];
            double cosine = row->x / fmax(1e-9, hypot(row->x, row->y));
            c.state.angle[k] *= exp(sign * (cosine * cosine - 0.5) + 0.5 * (uniform(5000 + k) - 0.5));
        }
        scree_rotation_decay_measure(&c.model, &c.state, c.forced, NULL, &decay);
        scree_rotation_network_measure(&c.model, &c.state, &c.table, c.forced, 10, &network);
        assert_int_equal(scree_rotation_alignment_measure(&c.model, &c.state, &c.table, c.forced, 10, &decay, &network,
                                                          &alignment, NULL),
                         SCREE_OK);
        assert_true(alignment.alignment.count > 100);
        assert_true(alignment.alignment.low < alignment.alignment.value &&
                    alignment.alignment.value < alignment.alignment.high);
        if (sign > 0) assert_true(alignment.alignment.low > 0.2 && alignment.chains.low > 0.1);
        if (sign < 0) assert_true(alignment.alignment.high < -0.2 && alignment.chains.high < -0.1);
        if (sign == 0) assert_true(alignment.alignment.low < 0 && alignment.alignment.high > 0);
        // The chains lie along x, and so do the first axis and the peak of the rose (one sector has 10 degrees).
        assert_true(fabs(network.axis[0][0]) > 0.99);
        assert_true(fabs(network.peak) < 0.2);
        destroy(&c);
    }
}

/// A turned assembly has a turned tensor: R T R'.
static void a_rotated_assembly_has_a_rotated_tensor(void **unused)
{
    (void)unused;
    cluster c;
    scree_rotation_network before, after;
    create(&c, 2);
    for (size_t k = 0; k < c.table.count; k++) c.table.contact[k].normal_force = uniform(k);
    drop_segments_across(&c);
    scree_rotation_network_measure(&c.model, &c.state, &c.table, c.forced, 8.03, &before);
    const double angle = 0.7, r[2][2] = {{cos(angle), -sin(angle)}, {sin(angle), cos(angle)}};
    for (size_t k = 0; k < c.state.count; k++) {
        scree_row *row = &c.state.row[k];
        double x = row->x, y = row->y;
        row->x = r[0][0] * x + r[0][1] * y;
        row->y = r[1][0] * x + r[1][1] * y;
    }
    for (size_t k = 0; k < c.table.count; k++) {
        double *branch = c.table.contact[k].branch, x = branch[0], y = branch[1];
        branch[0] = r[0][0] * x + r[0][1] * y;
        branch[1] = r[1][0] * x + r[1][1] * y;
    }
    scree_rotation_network_measure(&c.model, &c.state, &c.table, c.forced, 8.03, &after);
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 2; j++) {
            double expected = 0;
            for (int k = 0; k < 2; k++)
                for (int l = 0; l < 2; l++) expected += r[i][k] * before.tensor[3 * k + l] * r[j][l];
            // Round-off of a thousand terms.
            assert_true(fabs(after.tensor[3 * i + j] - expected) < 1e-9 * before.value[0]);
        }
    destroy(&c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shells_have_backgrounds_of_their_own),
        cmocka_unit_test(an_exponential_decay_is_found),
        cmocka_unit_test(shells_and_the_fit_have_their_formulas),
        cmocka_unit_test(sectors_have_equal_solid_angles),
        cmocka_unit_test(spins_that_do_not_decay_have_no_reach),
        cmocka_unit_test(bodies_that_nothing_holds_do_not_count),
        cmocka_unit_test(rotations_behind_a_strong_chain),
        cmocka_unit_test(contacts_hand_on_what_their_bodies_say),
        cmocka_unit_test(contacts_are_sorted_by_force_and_angle),
        cmocka_unit_test(strong_chains_cross_what_leads_outward),
        cmocka_unit_test(an_isotropic_network_has_an_isotropic_tensor),
        cmocka_unit_test(radial_and_tangential_segments),
        cmocka_unit_test(rotations_that_follow_chains_correlate),
        cmocka_unit_test(a_rotated_assembly_has_a_rotated_tensor),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
