/// The one table of modules: each row is the name of a module, whose descriptor `scree_module_NAME` stands in its own
/// file. Its place in the table is its slot (SCREE_SLOT_NAME), by which its state is found; the checksum of the state
/// takes what modules declare in the order of the rows, so new ones with words in it come behind
/// (docs/architecture.md).
#ifndef SCREE_MODULE_TABLE_H
#define SCREE_MODULE_TABLE_H

#define SCREE_STATE_MODULES(row)                                                                                       \
    row(gravity) row(plates) row(case_walls) row(periodic_cell) row(delaunay_boundary) row(pressure) row(own_force)    \
        row(imposed_gradient) row(selections) row(persistent) row(bonds) row(deformation) row(births) row(sleep)

/// Boundaries, in the order in which the case reference lists them; then those that no key chooses.
#define SCREE_BOUNDARY_MODULES(row)                                                                                    \
    row(pressure_boundary) row(plates_boundary) row(membrane) row(minimal) row(affine) row(walls) row(none)            \
        row(periodic)

/// What stages remember.
#define SCREE_STAGE_STATE_MODULES(row) row(forced_spin) row(loading)

/// Contact laws, each with its header in contact/laws.h.
#define SCREE_LAWS_OF_OVERLAPS(row) row(hertz_brilliantov) row(hertz_mindlin) row(hertz_jkr) row(hertz_dmt) row(linear)
#define SCREE_LAWS_OF_AREAS(row)    row(polygon_overlap) row(polygon_potential)
#define SCREE_LAWS(row)             SCREE_LAWS_OF_OVERLAPS(row) SCREE_LAWS_OF_AREAS(row)

/// Geometries of contacts, each with its header in contact/geometry.h, which numbers them in this order: those that are
/// evaluated in lanes, and those of which pairs are evaluated one at a time.
#define SCREE_GEOMETRIES_IN_LANES(row)   row(round)
#define SCREE_GEOMETRIES_ONE_BY_ONE(row) row(outlines) row(rounded)
#define SCREE_GEOMETRIES(row)            SCREE_GEOMETRIES_IN_LANES(row) SCREE_GEOMETRIES_ONE_BY_ONE(row)

/// Shapes of particles, in the order in which the case reference lists them.
#define SCREE_SHAPES(row) row(disc) row(sphere) row(polygon)

/// Kinds of selections, in the order in which the case reference lists them.
#define SCREE_SELECTION_MODULES(row)                                                                                   \
    row(select_all) row(select_box) row(select_circle) row(select_sphere) row(select_band) row(select_layer)           \
        row(select_side) row(select_top) row(select_ids) row(select_species) row(select_and) row(select_or)            \
            row(select_not)

/// Choices of the case, in the order in which the case reference lists them.
#define SCREE_CASE_MODULES(row)                                                                                        \
    SCREE_SHAPES(row)                                                                                                  \
    SCREE_LAWS(row)                                                                                                    \
    row(position_verlet) row(velocity_verlet) row(two_timescales) row(gear) row(drop_and_roll) row(hexagonal)          \
        row(square) row(centred_rectangular) row(face_centred) row(body_centred) row(cubic) row(gas) row(growth)       \
            row(dense) row(pair) row(bodies) row(file) row(empty) row(prepare) row(confine) row(compress) row(deform)  \
                row(load_path) row(rotate_particle) row(relax) row(iterate) row(collide) row(bond) row(pour)           \
                    row(point) row(line) row(region) row(background_damping) row(outlet) row(prescribed) row(plane)    \
                        row(box) row(cylinder) row(cone) row(mesh) row(wall_polygon) row(uniform) row(two_sizes)       \
                            row(equal) row(normal) row(log_normal) row(power_law) row(table) row(grading)

/// What is measured at the end of a run, with tables of its own.
#define SCREE_MEASURE_MODULES(row)                                                                                     \
    row(cells) row(breaks) row(moduli) row(waves) row(gauges) row(elastic_test) row(stability) row(mean_strain)        \
        row(slopes) row(pile) row(increments) row(response) row(response_watch) row(finite_elements) row(orientation) row(stress_path)     \
            row(outflow) row(surface) row(loading_curves) row(window_bands)

#define SCREE_MODULES(row)                                                                                             \
    SCREE_STATE_MODULES(row)                                                                                           \
    SCREE_BOUNDARY_MODULES(row)                                                                                        \
    SCREE_GEOMETRIES(row)                                                                                              \
    SCREE_STAGE_STATE_MODULES(row) SCREE_SELECTION_MODULES(row) SCREE_CASE_MODULES(row) SCREE_MEASURE_MODULES(row)

#endif
