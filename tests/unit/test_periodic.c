/// The periodic cell: contacts through faces, motion, energy, lattices, control.
#include "periodic_fixture.h"
#include "state/periodic.h"
#include "state_bits.h"

static const double at_rest[3] = {0, 0, 0};

/// Force on the body with the id [N].
static void force_on(const periodic_sample *s, uint32_t id, double force[3])
{
    const scree_sum_row *sum = &s->state.sum[s->state.row_of_id[id]];
    force[0] = scree_fixed_to(sum->fx, s->state.force_quantum);
    force[1] = scree_fixed_to(sum->fy, s->state.force_quantum);
    force[2] = s->state.dimension == 3 ? scree_fixed_to(sum->fz, s->state.force_quantum) : 0;
}

/// Two bodies that touch, the second put away by whole lattice vectors.
static void place_pair(periodic_sample *s, const double lattice[9], const double shift[3], law_choice law)
{
    int dimension = lattice[8] == 1 ? 2 : 3;
    periodic_create(s, dimension, 2, lattice, law);
    double one[3] = {0.4e-3, 0.3e-3, dimension == 3 ? 0.5e-3 : 0}, two[3], away[3];
    const double branch[3] = {1.1e-3, -1.4e-3, dimension == 3 ? 0.6e-3 : 0};
    const double velocity[3] = {0.05, 0.02, dimension == 3 ? -0.03 : 0};
    scree_matrix_apply(lattice, shift, away);
    for (int i = 0; i < 3; i++) two[i] = one[i] + branch[i] + away[i];
    periodic_place(s, 0, one, at_rest, 1e-3);
    periodic_place(s, 1, two, velocity, 1e-3);
    s->state.largest_speed = 0.1;
}

/// The same pair within reach directly and through every face, edge and corner, from both sides.
static void contacts_across_faces_are_contacts(int dimension, law_choice law)
{
    const double lattice[9] = {12e-3, 4e-3, dimension == 3 ? -3e-3 : 0, 0, 11e-3, dimension == 3 ? 2e-3 : 0,
                               0,     0,    dimension == 3 ? 10e-3 : 1};
    const double none[3] = {0, 0, 0};
    periodic_sample direct, across;
    double expected[3], found[3], other[3];
    place_pair(&direct, lattice, none, law);
    periodic_forces(&direct);
    force_on(&direct, 0, expected);
    double size = scree_length(expected);
    assert_true(size > 1);
    int deep = dimension == 3;
    for (int code = 0; code < 27; code++) {
        const double shift[3] = {code % 3 - 1, code / 3 % 3 - 1, code / 9 - 1};
        if (!deep && code / 9 != 1) continue;
        place_pair(&across, lattice, shift, law);
        periodic_forces(&across);
        force_on(&across, 0, found);
        force_on(&across, 1, other);
        for (int i = 0; i < 3; i++) {
            // The rounding of a coordinate of 0.03 m, 2^-58 m, over an overlap of 1e-4 m: 3e-14, and its power.
            assert_true(fabs(found[i] - expected[i]) <= 1e-12 * size);
            assert_true(found[i] == -other[i]);
        }
        const scree_state *a = &direct.state, *b = &across.state;
        for (int k = 0; k < 9; k++)
            assert_true(fabs(scree_cell(a)->virial[k] - scree_cell(b)->virial[k]) <= 1e-12 * size * 2e-3);
        assert_int_equal(b->sum[0].contacts, 1);
        assert_int_equal(b->sum[1].contacts, 1);
        periodic_destroy(&across);
    }
    periodic_destroy(&direct);
}

static void pairs_touch_through_faces(void **unused)
{
    (void)unused;
    for (int dimension = 2; dimension <= 3; dimension++)
        for (int law = 0; law < 2; law++) contacts_across_faces_are_contacts(dimension, (law_choice)law);
}

/// The table tells contacts as the evaluation saw them, with the branch to the ghost, and its virial is that of the
/// sums; also in a cell that deforms, with velocities relative to the affine field in the rows.
static void table_agrees_with_the_sums(void **unused)
{
    (void)unused;
    for (int dimension = 2; dimension <= 3; dimension++) {
        periodic_sample s;
        scree_error error;
        scree_contact_table table = {0};
        const double gradient[9] = {-2, 5, 0, 0, 1, 0, dimension == 3 ? 3.0 : 0, 0, 0};
        periodic_fill(&s, dimension, 5, HERTZ_MINDLIN, 0.02);
        periodic_run(&s, gradient, 300);
        check(scree_contact_table_build(&s.model, &s.state, &s.work, &table, &error), &error);
        double stress[9], virial[9], scale = 0;
        bool ghosts = false;
        scree_stress_from_contacts(&s.state, &table, 1, stress);
        for (size_t c = 0; c < table.count; c++) {
            ghosts = ghosts || table.contact[c].ghost;
            assert_true(scree_length(table.contact[c].branch) < 2.4e-3);
            assert_true(table.contact[c].first < s.state.count && table.contact[c].second < s.state.count);
        }
        for (int k = 0; k < 9; k++) {
            virial[k] = -stress[k];
            scale = fmax(scale, fabs(virial[k]));
        }
        assert_true(ghosts && scale > 0);
        // Forces from the table go through the velocities once more: round-off of v over v, some 1e-11 of a force.
        for (int k = 0; k < 9; k++) assert_true(fabs(virial[k] - scree_cell(&s.state)->virial[k]) < 1e-9 * scale);
        scree_contact_table_destroy(&table);
        periodic_destroy(&s);
    }
}

/// Velocities are relative to the affine field, and forces add up to nothing: their momentum obeys the drag alone.
static void momentum_is_conserved(void **unused)
{
    (void)unused;
    for (int dimension = 2; dimension <= 3; dimension++) {
        periodic_sample s;
        const double still[9] = {0};
        periodic_fill(&s, dimension, 5, HERTZ_MINDLIN, 0.1);
        periodic_run(&s, still, 500);
        int64_t sum[3] = {0};
        for (size_t k = 0; k < s.state.count; k++) {
            sum[0] += s.state.sum[k].fx;
            sum[1] += s.state.sum[k].fy;
            if (dimension == 3) sum[2] += s.state.sum[k].fz;
        }
        for (int i = 0; i < 3; i++) assert_true(sum[i] == 0);
        periodic_destroy(&s);
    }
}

/// Stress after a while of shear and compression, of a sample moved by `shift` in its cell.
static void stress_after(int dimension, law_choice law, const double shift[3], int remap, double stress[9])
{
    periodic_sample s;
    const double gradient[9] = {-3, 8, 0, 1, 0, 0, 0, dimension == 3 ? 4.0 : 0, 0};
    periodic_fill(&s, dimension, 5, law, 0.05);
    for (size_t k = 0; k < s.state.count; k++) {
        s.state.row[k].x += shift[0];
        s.state.row[k].y += shift[1];
        if (dimension == 3) s.state.row[k].z += shift[2];
    }
    // The same lattice by other vectors.
    for (int i = 0; i < 3; i++)
        scree_cell(&s.state)->lattice[3 * i + 1] += remap * scree_cell(&s.state)->lattice[3 * i];
    periodic_run(&s, gradient, 400);
    scree_periodic_stress(&s.model, &s.state, stress);
    periodic_destroy(&s);
}

/// With the spring of hertz_mindlin, and with the implicit friction that looks at what forces do to ghosts too.
static void faces_may_lie_anywhere(void **unused)
{
    (void)unused;
    static const law_choice laws[2] = {HERTZ_MINDLIN, HERTZ_BRILLIANTOV_IMPLICIT};
    for (int dimension = 2; dimension <= 3; dimension++)
        for (int law = 0; law < 2; law++) {
            const double here[3] = {0, 0, 0}, there[3] = {3.3e-3, -5.1e-3, dimension == 3 ? 4.7e-3 : 0};
            double expected[9], moved[9], remapped[9], scale = 0;
            stress_after(dimension, laws[law], here, 0, expected);
            stress_after(dimension, laws[law], there, 0, moved);
            stress_after(dimension, laws[law], here, 1, remapped);
            for (int k = 0; k < 9; k++) scale = fmax(scale, fabs(expected[k]));
            assert_true(scale > 1e3);
            // Round-off of positions, 2^-59 m over 1e-5 m of overlap, grown through 400 steps of collisions.
            for (int k = 0; k < 9; k++) {
                assert_true(fabs(moved[k] - expected[k]) < 1e-8 * scale);
                assert_true(fabs(remapped[k] - expected[k]) < 1e-8 * scale);
            }
        }
}

/// Large shear: the lattice leans over again and again and stays short, and its volume does not change.
static void lattices_are_reduced(void **unused)
{
    (void)unused;
    for (int dimension = 2; dimension <= 3; dimension++) {
        periodic_sample s;
        const double gradient[9] = {0, 2000, 0, 0, 0, dimension == 3 ? 700.0 : 0};
        periodic_fill(&s, dimension, 4, HERTZ_MINDLIN, 0);
        double volume = scree_periodic_extent(&s.state), longest = 0;
        // Far apart: nothing but the lattice moves.
        for (size_t k = 0; k < s.state.count; k++) s.state.row[k].radius *= 0.2;
        periodic_run(&s, gradient, 6000);
        const double *h = scree_cell(&s.state)->lattice;
        for (int k = 0; k < dimension; k++) longest = fmax(longest, hypot(hypot(h[k], h[3 + k]), h[6 + k]));
        assert_true(fabs(scree_cell(&s.state)->strain[1] - 2.4) < 1e-12);
        assert_true(longest < 2 * 4 * 1.97e-3);
        // Each step of the map has a determinant of 1 to 2^-53; the lattice was remapped a few times.
        assert_true(fabs(scree_periodic_extent(&s.state) / volume - 1) < 1e-11);
        periodic_destroy(&s);
    }
}

/// Residual of the ledger over the work, after the same time in steps of `step`.
static double residual(int dimension, const double gradient[9], int scheme, double step)
{
    periodic_sample s;
    scree_error error;
    scree_contact_table table = {0};
    scree_energy begin, end;
    periodic_fill(&s, dimension, 5, HERTZ_MINDLIN, 0.3);
    s.model.scheme = scheme;
    s.state.step_size = s.model.step = step;
    // Contacts that exist have no history; the first evaluation gives the elastic energy to begin with.
    periodic_forces(&s);
    s.state.ledger = (scree_ledger){0};
    check(scree_contact_table_build(&s.model, &s.state, &s.work, &table, &error), &error);
    scree_energy_measure(&s.model, &s.state, &table, &begin);
    s.state.ledger.initial = begin.kinetic + begin.kinetic_rotation + begin.elastic_normal + begin.elastic_tangential;
    periodic_run(&s, gradient, (int)lrint(2e-4 / step));
    check(scree_contact_table_build(&s.model, &s.state, &s.work, &table, &error), &error);
    scree_energy_measure(&s.model, &s.state, &table, &end);
    assert_true(fabs(s.state.ledger.periodic) > 0.02 * s.state.ledger.turnover);
    double relative = fabs(end.residual) / s.state.ledger.turnover;
    scree_contact_table_destroy(&table);
    periodic_destroy(&s);
    return relative;
}

/// The ledger closes as well as without a cell, in every kind of flow, and better with smaller steps.
static void energy_balance_closes(void **unused)
{
    (void)unused;
    const double flows[3][9] = {{0, 300, 0}, {-100, 0, 0, 0, 60}, {20, 150, 0, -90, -50, 40, 30, 0, 10}};
    for (int dimension = 2; dimension <= 3; dimension++)
        for (int flow = 0; flow < 3; flow++)
            for (int scheme = SCREE_SLOT_position_verlet; scheme <= SCREE_SLOT_velocity_verlet; scheme++) {
                double gradient[9];
                for (int k = 0; k < 9; k++)
                    gradient[k] = dimension == 2 && (k / 3 == 2 || k % 3 == 2) ? 0 : flows[flow][k];
                double coarse = residual(dimension, gradient, scheme, 4e-7);
                double fine = residual(dimension, gradient, scheme, 1e-7);
                // Trapezoids along Hertz springs: a hundred steps a collision leave some 1e-5 of the work.
                if (!(fine < 2e-5 && fine < 0.5 * coarse + 1e-9))
                    fail_msg("dimension %d flow %d scheme %d: %g, %g", dimension, flow, scheme, coarse, fine);
            }
}

/// The cell works with its stress on its gradient: against a sum over contacts and bodies, step by step.
static void power_is_volume_times_stress_times_rate(void **unused)
{
    (void)unused;
    for (int dimension = 2; dimension <= 3; dimension++) {
        periodic_sample s;
        scree_error error;
        scree_contact_table table = {0};
        const double flows[2][9] = {{-40, 200, 0, 30, 20}, {-40, 200, -70, 30, 20, 60, -50, 90, 10}};
        const double *gradient = flows[dimension - 2];
        double before[9], moved[9], now[9], work = 0, size = 0;
        periodic_fill(&s, dimension, 5, HERTZ_MINDLIN, 0.2);
        periodic_run(&s, gradient, 50);
        memcpy(before, scree_cell(&s.state)->virial, sizeof before);
        double last = s.state.ledger.periodic;
        for (int step = 0; step < 50; step++) {
            periodic_run(&s, gradient, 1);
            check(scree_contact_table_build(&s.model, &s.state, &s.work, &table, &error), &error);
            scree_stress_from_contacts(&s.state, &table, -1, now);
            memset(moved, 0, sizeof moved);
            for (size_t k = 0; k < s.state.count; k++) {
                scree_vector velocity, spin, middle;
                double back[9], matrix[9];
                scree_body_half_velocity(&s.model, &s.state, k, velocity, spin);
                scree_matrix_unit_plus(-0.5 * s.state.step_size, gradient, matrix);
                scree_matrix_invert(matrix, back);
                scree_matrix_apply(back, velocity, middle);
                for (int i = 0; i < 9; i++) moved[i] += s.state.row[k].mass * middle[i / 3] * middle[i % 3];
            }
            double dt = s.state.step_size,
                   contacts = 0.5 * (scree_matrix_contract(before, gradient) + scree_matrix_contract(now, gradient));
            work -= dt * (contacts + scree_matrix_contract(moved, gradient));
            size += dt * (fabs(contacts) + fabs(scree_matrix_contract(moved, gradient)));
            memcpy(before, now, sizeof before);
        }
        // Round-off of some 1e-13 a term; the table computes forces again, as above.
        if (!(fabs(s.state.ledger.periodic - last - work) < 1e-9 * size))
            fail_msg("accumulated %.17g, found %.17g", s.state.ledger.periodic - last, work);
        scree_contact_table_destroy(&table);
        periodic_destroy(&s);
    }
}

/// A free body that leaves through faces while the cell deforms: seen from the affine field it goes as far as its own
/// velocity says.
static void displacements_go_across_faces(void **unused)
{
    (void)unused;
    periodic_sample s;
    const double side = 12e-3, lattice[9] = {side, 0, 0, 0, side, 0, 0, 0, 1}, gradient[9] = {0, 40};
    const double place[3] = {5e-3, 6e-3, 0}, velocity[3] = {0, 3, 0};
    periodic_create(&s, 2, 1, lattice, HERTZ_MINDLIN);
    periodic_place(&s, 0, place, velocity, 1e-3);
    s.state.step_size = 1e-5;
    int steps = 2000;
    periodic_run(&s, gradient, steps);
    double t = steps * 1e-5, inverse[9], deformation[9], carried[3], u[3], f[3];
    scree_matrix_invert(scree_cell(&s.state)->reference, inverse);
    scree_matrix_multiply(scree_cell(&s.state)->lattice, inverse, deformation);
    scree_matrix_apply(deformation, s.state.reference[0], carried);
    scree_body_position(&s.state, 0, u);
    scree_matrix_invert(scree_cell(&s.state)->lattice, inverse);
    scree_matrix_apply(inverse, u, f);
    for (int k = 0; k < 2; k++) assert_true(f[k] > -0.2 && f[k] < 1.2);
    for (int k = 0; k < 3; k++) u[k] -= carried[k];
    // c' = -L c: c_y stays, c_x = -rate c_y t; and x' = c + L x, of which the affine map takes away the carried part:
    // u_y = c_y t, u_x' = c_x + rate u_y = 0.
    assert_true(fabs(u[1] - 3 * t) < 1e-12 && fabs(u[0]) < 1e-12);
    periodic_destroy(&s);
}

/// The servo brings the sample to three different normal stresses and a shear stress.
static void stresses_are_held(void **unused)
{
    (void)unused;
    for (int dimension = 2; dimension <= 3; dimension++) {
        periodic_sample s;
        scree_periodic_demand drive = {.rate = {0}};
        periodic_fill(&s, dimension, 5, HERTZ_MINDLIN, 0);
        double stress[9], wanted[9] = {-1e6, 5e4, 0, 0, -1.3e6, 0, 0, 0, -1.1e6};
        for (int k = 0; k < 9; k++) drive.stress[k] = NAN;
        for (int i = 0; i < dimension; i++) drive.stress[4 * i] = wanted[4 * i];
        drive.stress[1] = wanted[1];
        scree_periodic_fit(&s.model, &s.state, 1e6);
        for (int step = 0; step < 30000; step++) {
            scree_periodic_control(&s.model, &s.state, &drive, 1);
            periodic_step(&s);
        }
        scree_periodic_stress(&s.model, &s.state, stress);
        // What is left of the motion of the grains after the creep; the damping of contacts ends it.
        for (int k = 0; k < 9; k++)
            if (!isnan(drive.stress[k]) && !(fabs(stress[k] - wanted[k]) < 2e-3 * 1e6))
                fail_msg("dimension %d component %d: %g wanted %g", dimension, k, stress[k], wanted[k]);
        periodic_destroy(&s);
    }
}

/// The dashpot of the servo resists changes of a rate: at the wanted stress a lasting one stays as it is.
static void lasting_rates_are_not_resisted(void **unused)
{
    (void)unused;
    for (int lasting = 0; lasting < 2; lasting++) {
        periodic_sample s;
        scree_periodic_demand drive = {.rate = {0}};
        periodic_fill(&s, 3, 5, HERTZ_MINDLIN, 0);
        scree_periodic_cell *cell = scree_cell(&s.state);
        for (int k = 0; k < 9; k++) drive.stress[k] = k % 4 == 0 ? -1e6 : NAN;
        scree_periodic_fit(&s.model, &s.state, 1e6);
        for (int k = 0; k < 9; k += 4) {
            cell->virial[k] = 1e6 * scree_periodic_extent(&s.state);
            cell->gradient[k] = 0.5 * cell->limit;
            cell->drift[k] = lasting ? cell->gradient[k] : 0;
        }
        scree_periodic_control(&s.model, &s.state, &drive, 1);
        for (int k = 0; k < 9; k += 4) {
            double kept = cell->gradient[k] / (0.5 * cell->limit);
            // A dashpot of Z / I, implicitly; round-off of the stress over the inertia.
            double expected = lasting ? 1 : 1 / (1 + s.state.step_size * cell->damping);
            assert_true(fabs(kept - expected) < 1e-9 && (lasting || expected < 0.99));
        }
        periodic_destroy(&s);
    }
}

/// A lateral pressure (in 3D a shear stress, too) is held while other components deform the cell: what is prescribed
/// is exact, what is held keeps to its stress, and the cell does the work of its whole stress on its gradient.
static void rates_and_stresses_are_mixed(void **unused)
{
    (void)unused;
    for (int dimension = 2; dimension <= 3; dimension++) {
        const bool in_3d = dimension == 3;
        const int axial = 4 * (dimension - 1), confining = 8000, loading = 12000;
        periodic_sample s;
        scree_periodic_demand drive = {.rate = {0}};
        double stress[9], begin[9], mean[9] = {0}, wanted[9] = {-1e6, 0, 0, 0, -1.2e6, 5e4, 0, 0, -1e6};
        periodic_fill(&s, dimension, 5, HERTZ_MINDLIN, 0);
        for (int k = 0; k < 9; k++) drive.stress[k] = k % 4 == 0 && k / 4 < dimension ? wanted[k] : NAN;
        scree_periodic_fit(&s.model, &s.state, 1e6);
        for (int step = 0; step < confining; step++) {
            scree_periodic_control(&s.model, &s.state, &drive, 1);
            periodic_step(&s);
        }
        drive.stress[axial] = NAN;
        if (in_3d) drive.stress[5] = wanted[5];
        drive.rate[axial] = -3;
        drive.rate[1] = 1.5;
        drive.rate[3] = -0.5;
        if (in_3d) drive.rate[6] = 0.7;
        memcpy(begin, scree_cell(&s.state)->strain, sizeof begin);
        double before = s.state.ledger.periodic, work = 0;
        for (int step = 0; step < loading; step++) {
            const scree_periodic_cell *cell = scree_cell(&s.state);
            scree_periodic_control(&s.model, &s.state, &drive, 1);
            work -= 0.5 * s.model.step * scree_matrix_contract(cell->virial, cell->gradient);
            periodic_step(&s);
            work -= 0.5 * s.model.step * scree_matrix_contract(cell->virial, cell->gradient);
            work -= s.model.step * scree_matrix_contract(cell->motion, cell->gradient);
            scree_periodic_stress(&s.model, &s.state, stress);
            for (int k = 0; k < 9 && step >= loading / 2; k++) mean[k] += stress[k] / (loading / 2);
        }
        for (int k = 0; k < 9; k++) {
            double strain = scree_cell(&s.state)->strain[k] - begin[k],
                   prescribed = drive.rate[k] * loading * s.model.step;
            // Sums of equal increments, each rounded to 2^-53 of what there is.
            bool held = !isnan(drive.stress[k]), exact = fabs(strain - prescribed) <= 1e-12 * fabs(prescribed);
            // A servo without overshoot is as near as the motion of the grains lets it, see stresses_are_held.
            if (held ? !(fabs(mean[k] - wanted[k]) < 2e-3 * 1e6) || exact : !exact)
                fail_msg("dimension %d component %d: mean %g, strain %g", dimension, k, mean[k], strain);
        }
        // Every step with the gradient that it had; sums of as many terms.
        double last = s.state.ledger.periodic - before;
        if (!(fabs(last - work) < 1e-12 * fabs(work))) fail_msg("accumulated %.17g, found %.17g", last, work);
        periodic_destroy(&s);
    }
}

/// 600 steps of a flow; the list is thrown away every `discard`-th step.
static uint64_t flow_checksum(int dimension, int threads, int discard)
{
    periodic_sample s;
    scree_error error;
    const double gradient[9] = {-40, 900, 0, 0, 30, 0, 0, dimension == 3 ? 500.0 : 0, 0};
    periodic_fill(&s, dimension, 5, HERTZ_MINDLIN, 2);
    scree_contact_scratch_destroy(&s.work);
    scree_work_destroy(&s.work);
    check(scree_work_create(&s.work, &s.model, threads, &error), &error);
    for (int step = 1; step <= 600; step++) {
        periodic_run(&s, gradient, 1);
        if (discard > 0 && step % discard == 0) scree_neighbours_invalidate(&s.work);
    }
    check(scree_contacts_save(&s.state, &s.work, &error), &error);
    uint64_t checksum = state_bits(&s.state);
    periodic_destroy(&s);
    return checksum;
}

static void order_and_threads_do_not_show(void **unused)
{
    (void)unused;
    for (int dimension = 2; dimension <= 3; dimension++) {
        uint64_t reference = flow_checksum(dimension, 1, 0);
        assert_true(flow_checksum(dimension, 1, 7) == reference);
        assert_true(flow_checksum(dimension, 2, 0) == reference);
        assert_true(flow_checksum(dimension, 3, 11) == reference);
    }
}

/// Grains at rest in the affine field, at first farther from each other than the list looks: it is the gradient alone
/// that uses the list up.
static void the_flow_alone_brings_contacts(void **unused)
{
    (void)unused;
    for (int dimension = 2; dimension <= 3; dimension++) {
        periodic_sample s;
        const double gradient[9] = {-1000, 0, 0, 0, -1000, 0, 0, 0, dimension == 3 ? -1000 : 0};
        periodic_fill(&s, dimension, 6, HERTZ_MINDLIN, 0);
        for (size_t k = 0; k < s.state.count; k++) s.state.row[k].radius *= 0.7;
        s.model.radius_max *= 0.7;
        periodic_forces(&s);
        assert_int_equal(s.work.pairs.count, 0);
        // From spacings of 1.97 mm to 1.38 mm, below two radii of 0.7 mm.
        periodic_run(&s, gradient, 1780);
        size_t touched = 0;
        for (size_t k = 0; k < s.state.count; k++) touched += s.state.sum[k].contacts > 0;
        assert_true(touched > s.state.count / 2);
        periodic_destroy(&s);
    }
}

static void narrow_cells_are_refused(void **unused)
{
    (void)unused;
    periodic_sample s;
    scree_error error;
    const double lattice[9] = {12e-3, 0, 0, 0, 4.1e-3, 0, 0, 0, 1}, place[3] = {1e-3, 1e-3, 0};
    periodic_create(&s, 2, 1, lattice, HERTZ_MINDLIN);
    periodic_place(&s, 0, place, at_rest, 1e-3);
    assert_int_equal(scree_neighbours_refresh(&s.model, &s.state, &s.work, &error), SCREE_ERROR_GUARD);
    assert_non_null(strstr(error.message, "only 0.0041 m wide"));
    periodic_destroy(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pairs_touch_through_faces),
        cmocka_unit_test(table_agrees_with_the_sums),
        cmocka_unit_test(momentum_is_conserved),
        cmocka_unit_test(faces_may_lie_anywhere),
        cmocka_unit_test(lattices_are_reduced),
        cmocka_unit_test(energy_balance_closes),
        cmocka_unit_test(power_is_volume_times_stress_times_rate),
        cmocka_unit_test(displacements_go_across_faces),
        cmocka_unit_test(stresses_are_held),
        cmocka_unit_test(lasting_rates_are_not_resisted),
        cmocka_unit_test(rates_and_stresses_are_mixed),
        cmocka_unit_test(order_and_threads_do_not_show),
        cmocka_unit_test(the_flow_alone_brings_contacts),
        cmocka_unit_test(narrow_cells_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
