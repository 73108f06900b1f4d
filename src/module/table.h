/// The one table of modules: each row is the name of a module, whose descriptor `scree_module_NAME` stands in its own
/// file. Its place in the table is its slot (SCREE_SLOT_NAME), by which its state is found; the checksum of the state
/// takes what modules declare in the order of the rows, so new ones come behind (docs/architecture.md).
#ifndef SCREE_MODULE_TABLE_H
#define SCREE_MODULE_TABLE_H

#define SCREE_MODULES(row)                                                                                             \
    row(plates) row(case_walls) row(periodic_cell) row(delaunay_boundary) row(pressure) row(own_force)                 \
        row(imposed_gradient) row(membrane) row(forced_spin)

#endif
