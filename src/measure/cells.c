/// Cells inside the boundary, and the gradient of a field in each: see cells.h.
///
/// With the edge vectors of a cell as columns of X and the differences of the values as columns of V, the gradient is
/// G = V X^-1 = V adj(X) / det X, so that volume x gradient = V adj(X) / d! has no division and flat cells spoil no
/// sum. Cost: Delaunay, 4 microseconds a disc and 30 a sphere; the rest 0.1 microseconds a cell.
#include "measure/cells.h"

#include "integrate/integrate.h"
#include "measure/facets.h"
#include "search/delaunay.h"
#include "search/tetrahedra.h"

#include <math.h>
#include <string.h>

#define NONE UINT32_MAX

// ---- assembly ----------------------------------------------------------------------------------------------------

scree_status scree_assembly_of_state(const scree_model *model, const scree_state *state, scree_assembly *assembly,
                                     scree_error *error)
{
    bool in_3d = state->dimension == 3;
    *assembly = (scree_assembly){
        .dimension = state->dimension, .thickness = in_3d ? 1 : model->thickness, .count = scree_grain_count(state)};
    uint32_t *row = NULL;
    scree_status status = scree_grains_by_id(state, &row, error);
    if (!status) status = scree_allocate(&assembly->id, assembly->count, sizeof *assembly->id, error);
    if (!status) status = scree_allocate(&assembly->position, 3 * assembly->count, sizeof *assembly->position, error);
    if (!status) status = scree_allocate(&assembly->radius, assembly->count, sizeof *assembly->radius, error);
    if (!status) status = scree_outlines_find(state, &assembly->outlines, error);
    for (size_t k = 0; k < assembly->count && !status; k++) {
        assembly->id[k] = state->id[row[k]];
        scree_body_position(state, row[k], assembly->position + 3 * k);
        assembly->radius[k] = scree_body_equivalent_radius(state, row[k]);
    }
    scree_release(&row);
    if (status) scree_assembly_destroy(assembly);
    return status;
}

void scree_assembly_destroy(scree_assembly *assembly)
{
    scree_release(&assembly->id);
    scree_release(&assembly->position);
    scree_release(&assembly->radius);
    scree_outlines_destroy(&assembly->outlines);
    assembly->count = 0;
}

// ---- geometry of a cell ------------------------------------------------------------------------------------------

/// Columns: from node 0 to the others; in 2D the third is the unit normal of the plane.
static void edges(const uint32_t node[4], int dimension, const double *value, double normal, double edge[3][3])
{
    for (int k = 0; k < dimension; k++)
        for (int i = 0; i < 3; i++)
            edge[i][k] = value[3 * (size_t)node[k + 1] + (size_t)i] - value[3 * (size_t)node[0] + (size_t)i];
    if (dimension == 3) return;
    edge[0][2] = edge[1][2] = 0;
    edge[2][2] = normal;
}

/// adj(X), and det X.
static double adjugate(double x[3][3], double adjugate[3][3])
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            int a = (j + 1) % 3, b = (j + 2) % 3, c = (i + 1) % 3, d = (i + 2) % 3;
            adjugate[i][j] = x[a][c] * x[b][d] - x[a][d] * x[b][c];
        }
    return x[0][0] * adjugate[0][0] + x[0][1] * adjugate[1][0] + x[0][2] * adjugate[2][0];
}

double scree_cell_volume_at(const scree_cells *cells, size_t k, const double *position)
{
    double x[3][3], adjugated[3][3];
    edges(cells->node[k], cells->dimension, position, 1, x);
    return adjugate(x, adjugated) / (cells->dimension == 3 ? 6 : 2);
}

void scree_cells_gradient(const scree_cells *cells, const double *position, const double *value, double (*gradient)[9])
{
    for (size_t k = 0; k < cells->count; k++) {
        double x[3][3], v[3][3], adjugated[3][3];
        edges(cells->node[k], cells->dimension, position, 1, x);
        edges(cells->node[k], cells->dimension, value, 0, v);
        double determinant = adjugate(x, adjugated);
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++)
                gradient[k][3 * i + j] =
                    (v[i][0] * adjugated[0][j] + v[i][1] * adjugated[1][j] + v[i][2] * adjugated[2][j]) / determinant;
    }
}

void scree_cell_centre(const scree_cells *cells, size_t k, const double *position, scree_vector centre)
{
    int nodes = cells->dimension + 1;
    for (int i = 0; i < 3; i++) {
        double sum = 0;
        for (int n = 0; n < nodes; n++) sum += position[3 * (size_t)cells->node[k][n] + (size_t)i];
        centre[i] = sum / nodes;
    }
}

// ---- building ----------------------------------------------------------------------------------------------------

/// A triangulation of either dimension with the cells that are kept.
typedef struct simplices {
    size_t count;
    uint32_t (*triangle)[3];
    int32_t (*triangle_neighbour)[3];
    uint32_t (*tetrahedron)[4];
    int32_t (*tetrahedron_neighbour)[4];
    uint8_t *outside;
} simplices;

/// Copies the simplices inside, with neighbours renumbered.
static scree_status keep_inside(const simplices *all, const scree_assembly *assembly, scree_cells *cells,
                                scree_error *error)
{
    int nodes = assembly->dimension + 1;
    int32_t *number = NULL;
    scree_status status = scree_allocate(&number, all->count, sizeof *number, error);
    if (status) return status;
    for (size_t t = 0; t < all->count; t++) number[t] = all->outside[t] ? -1 : (int32_t)cells->count++;
    status = scree_allocate(&cells->node, cells->count, sizeof *cells->node, error);
    if (!status) status = scree_allocate(&cells->neighbour, cells->count, sizeof *cells->neighbour, error);
    if (!status) status = scree_allocate(&cells->volume, cells->count, sizeof *cells->volume, error);
    for (size_t t = 0; t < all->count && !status; t++) {
        if (number[t] < 0) continue;
        size_t k = (size_t)number[t];
        cells->node[k][3] = NONE;
        cells->neighbour[k][3] = -1;
        for (int n = 0; n < nodes; n++) {
            int32_t behind = nodes == 3 ? all->triangle_neighbour[t][n] : all->tetrahedron_neighbour[t][n];
            cells->node[k][n] = nodes == 3 ? all->triangle[t][n] : all->tetrahedron[t][n];
            cells->neighbour[k][n] = behind < 0 ? -1 : number[behind];
        }
        cells->volume[k] = assembly->thickness * scree_cell_volume_at(cells, k, assembly->position);
    }
    scree_release(&number);
    return status;
}

/// Triangles inside the boundary loop. A flat one on a straight side counts as outside.
static scree_status find_triangles(const scree_assembly *assembly, const double *points, const scree_peel_rule *rule,
                                   scree_cells *cells, scree_error *error)
{
    scree_triangulation triangulation;
    scree_peel_rule of_outlines = *rule;
    of_outlines.outline = assembly->outlines.core;
    uint32_t *loop = NULL;
    size_t loop_count;
    scree_status status = scree_triangulation_build(points, assembly->count, &triangulation, error);
    if (status) return status;
    simplices all = {
        .count = triangulation.count, .triangle = triangulation.vertex, .triangle_neighbour = triangulation.neighbour};
    status = scree_allocate(&all.outside, all.count, 1, error);
    if (!status)
        status = scree_boundary_loop(&triangulation, points, assembly->radius, assembly->count, &of_outlines, &loop,
                                     &loop_count, all.outside, error);
    for (size_t t = 0; t < all.count && !status; t++) {
        const double *p[3];
        for (int n = 0; n < 3; n++) p[n] = points + 2 * (size_t)all.triangle[t][n];
        double ab[2] = {p[1][0] - p[0][0], p[1][1] - p[0][1]}, ac[2] = {p[2][0] - p[0][0], p[2][1] - p[0][1]};
        double area = ab[0] * ac[1] - ab[1] * ac[0], size = fmax(fabs(ab[0]) + fabs(ab[1]), fabs(ac[0]) + fabs(ac[1]));
        all.outside[t] = all.outside[t] == SCREE_TRIANGLE_CUT || area < 1e-9 * size * size;
    }
    if (!status) status = keep_inside(&all, assembly, cells, error);
    scree_release(&loop);
    scree_release(&all.outside);
    scree_triangulation_destroy(&triangulation);
    return status;
}

/// Six volumes of a tetrahedron over the cube of its longest edge from the first corner.
static double shape_of(const double *points, const uint32_t vertex[4])
{
    double edge[3][3], longest = 0;
    for (int n = 0; n < 3; n++) {
        double square = 0;
        for (int k = 0; k < 3; k++) {
            edge[n][k] = points[3 * (size_t)vertex[n + 1] + (size_t)k] - points[3 * (size_t)vertex[0] + (size_t)k];
            square += edge[n][k] * edge[n][k];
        }
        longest = fmax(longest, square);
    }
    double volume = edge[0][0] * (edge[1][1] * edge[2][2] - edge[1][2] * edge[2][1]) +
                    edge[0][1] * (edge[1][2] * edge[2][0] - edge[1][0] * edge[2][2]) +
                    edge[0][2] * (edge[1][0] * edge[2][1] - edge[1][1] * edge[2][0]);
    return volume / (longest * sqrt(longest));
}

/// Tetrahedra inside the hull. Flat ones, as lattices have them, count as outside.
static scree_status find_tetrahedra(const scree_assembly *assembly, const double *points, const scree_peel_rule *rule,
                                    scree_cells *cells, scree_error *error)
{
    scree_tetrahedra tetrahedra;
    scree_triangle_surface surface = {0};
    scree_status status = scree_tetrahedra_build(points, assembly->count, &tetrahedra, error);
    if (status) return status;
    simplices all = {
        .count = tetrahedra.count, .tetrahedron = tetrahedra.vertex, .tetrahedron_neighbour = tetrahedra.neighbour};
    status = scree_allocate(&all.outside, all.count, 1, error);
    if (!status)
        status = scree_boundary_surface(&tetrahedra, points, assembly->radius, assembly->count, rule, &surface,
                                        all.outside, error);
    for (size_t t = 0; t < all.count && !status; t++)
        all.outside[t] = all.outside[t] == SCREE_TRIANGLE_CUT || shape_of(points, all.tetrahedron[t]) < 1e-9;
    if (!status) status = keep_inside(&all, assembly, cells, error);
    scree_triangle_surface_destroy(&surface);
    scree_release(&all.outside);
    scree_tetrahedra_destroy(&tetrahedra);
    return status;
}

scree_status scree_cells_build(const scree_assembly *assembly, const scree_peel_rule *rule, scree_cells *cells,
                               scree_error *error)
{
    *cells = (scree_cells){.dimension = assembly->dimension, .bodies = assembly->count};
    size_t d = (size_t)assembly->dimension;
    double *points = NULL;
    scree_status status = scree_allocate(&points, d * assembly->count, sizeof *points, error);
    if (status) return status;
    for (size_t i = 0; i < assembly->count; i++) memcpy(points + d * i, assembly->position + 3 * i, d * sizeof *points);
    if (d == 3)
        status = find_tetrahedra(assembly, points, rule, cells, error);
    else
        status = find_triangles(assembly, points, rule, cells, error);
    scree_release(&points);
    if (status) scree_cells_destroy(cells);
    return status;
}

void scree_cells_destroy(scree_cells *cells)
{
    void *const arrays[] = {&cells->id,       &cells->node,   &cells->neighbour,  &cells->volume,
                            &cells->gradient, &cells->stress, &cells->distortion, &cells->pressure};
    for (size_t k = 0; k < sizeof arrays / sizeof *arrays; k++) scree_release(arrays[k]);
    cells->count = 0;
}

// ---- everything of a state ---------------------------------------------------------------------------------------

/// The cells inside the boundary of the state as it would be found now, with its memory: without that they would be
/// those of another region (boundary.gap_hysteresis).
static scree_status build_inside_boundary(const scree_model *model, const scree_state *state,
                                          const scree_assembly *assembly, scree_cells *cells, scree_error *error)
{
    scree_grain_place *grain = NULL;
    uint32_t *past = NULL;
    scree_peel_rule rule;
    scree_status status = scree_allocate(&grain, assembly->count, sizeof *grain, error);
    for (size_t k = 0; k < assembly->count && !status; k++) grain[k].id = assembly->id[k];
    if (!status) status = scree_facet_rule(model, state, grain, assembly->count, &rule, &past, error);
    if (!status) status = scree_cells_build(assembly, &rule, cells, error);
    scree_release(&past);
    scree_release(&grain);
    return status;
}

static scree_status measure_motion(const scree_model *model, const scree_state *state, const scree_assembly *assembly,
                                   scree_cells *cells, scree_error *error)
{
    double *velocity = NULL;
    scree_vector spin;
    scree_status status = scree_allocate(&velocity, 3 * assembly->count, sizeof *velocity, error);
    if (status) return status;
    for (size_t k = 0; k < assembly->count; k++)
        scree_body_velocity(model, state, scree_state_row_of(state, cells->id[k]), velocity + 3 * k, spin);
    scree_cells_gradient(cells, assembly->position, velocity, cells->gradient);
    scree_release(&velocity);
    return SCREE_OK;
}

scree_status scree_cells_measure(const scree_model *model, const scree_state *state, const scree_contact_table *table,
                                 scree_cells *cells, scree_error *error)
{
    scree_assembly assembly;
    *cells = (scree_cells){0};
    scree_status status = scree_assembly_of_state(model, state, &assembly, error);
    if (status) return status;
    status = build_inside_boundary(model, state, &assembly, cells, error);
    if (!status) {
        cells->id = assembly.id;
        assembly.id = NULL;
    }
    if (!status) status = scree_allocate(&cells->gradient, cells->count, sizeof *cells->gradient, error);
    if (!status) status = scree_allocate(&cells->stress, cells->count, sizeof *cells->stress, error);
    if (!status) status = scree_allocate(&cells->distortion, cells->count, sizeof *cells->distortion, error);
    if (!status) status = scree_allocate(&cells->pressure, cells->count, sizeof *cells->pressure, error);
    if (!status) status = measure_motion(model, state, &assembly, cells, error);
    if (!status) status = scree_cells_stress(cells, state, table, cells->stress, error);
    for (size_t k = 0; k < cells->count && !status; k++) {
        const double *s = cells->stress[k];
        cells->distortion[k] = scree_distortion(cells->gradient[k], cells->dimension);
        cells->pressure[k] = -(s[0] + s[4] + s[8]) / cells->dimension;
    }
    scree_assembly_destroy(&assembly);
    if (status) scree_cells_destroy(cells);
    return status;
}

double scree_cells_mean(const scree_cells *cells, const double *value)
{
    double sum = 0, volume = 0;
    for (size_t k = 0; k < cells->count; k++) {
        sum += cells->volume[k] * value[k];
        volume += cells->volume[k];
    }
    return sum / volume;
}

void scree_cells_circles(const scree_cells *cells, const double *position, const scree_vector centre, double step,
                         size_t count, double *pressure, double *volume)
{
    for (size_t c = 0; c < count; c++) pressure[c] = volume[c] = 0;
    for (size_t k = 0; k < cells->count; k++) {
        scree_vector at;
        scree_cell_centre(cells, k, position, at);
        for (int i = 0; i < 3; i++) at[i] -= centre[i];
        double ring = floor(2 * scree_length(at) / step);
        if (!(ring < (double)count)) continue;
        volume[(size_t)ring] += cells->volume[k];
        pressure[(size_t)ring] += cells->volume[k] * cells->pressure[k];
    }
    for (size_t c = 1; c < count; c++) {
        volume[c] += volume[c - 1];
        pressure[c] += pressure[c - 1];
    }
    for (size_t c = 0; c < count; c++) pressure[c] /= volume[c];
}
