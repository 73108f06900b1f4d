/// The scenes of a run: single snapshots, coloured by what has happened since the start of loading, or
/// since that of the run where nothing is loaded.
#include "view/plot_parts.h"

#include "base/memory.h"
#include "view/projection.h"
#include "view/scene.h"

#include <math.h>
#include <stdio.h>

enum { FIELD_NONE, FIELD_ROTATION, FIELD_SPIN, FIELD_SPIN_MAGNITUDE, FIELD_SPEED, FIELD_DISPLACEMENT, FIELD_BIRTH };
enum { VIEW_PLANE, VIEW_SPACE, VIEW_SECTION }; // VIEW_PLANE is for discs, the others for spheres

static const struct field_entry {
    const char *meaning, *unit;
    scree_colour_map map;
    bool compares; ///< since the start
} fields[] = {
    [FIELD_ROTATION] = {"rotation", " (degrees), counter-clockwise positive", SCREE_COLOUR_DIVERGING, true},
    [FIELD_SPIN] = {"spin", " (rad/s), counter-clockwise positive", SCREE_COLOUR_DIVERGING, false},
    [FIELD_SPIN_MAGNITUDE] = {"spin, magnitude", " (rad/s)", SCREE_COLOUR_SEQUENTIAL, false},
    [FIELD_SPEED] = {"speed", " (mm/s)", SCREE_COLOUR_SEQUENTIAL, false},
    [FIELD_DISPLACEMENT] = {"displacement", " (mm)", SCREE_COLOUR_SEQUENTIAL, true},
    [FIELD_BIRTH] = {"time of birth", " (s)", SCREE_COLOUR_SEQUENTIAL, false},
};

typedef struct scene_row {
    scree_figure figure;
    const char *title;
    scree_plot_when when;
    int field;
    bool force_network, boundary;
    int view;
} scene_row;

static const scene_row rows[] = {
    {{"packing-start", "particles at the start of loading, or of the run", SCREE_ON_REQUEST},
     "Packing at the start",
     SCREE_AT_START,
     .boundary = true},
    {{"packing-end", "particles at the end, coloured by their rotation since the start", SCREE_USUAL},
     "Packing at the end: rotations",
     SCREE_AT_END,
     .field = FIELD_ROTATION,
     .boundary = true},
    {{"forces-peak", "contact forces at the peak of the stress ratio", SCREE_ON_REQUEST},
     "Force network at the peak of the stress ratio",
     SCREE_AT_PEAK,
     .force_network = true},
    {{"forces-end", "contact forces at the end", SCREE_USUAL},
     "Force network at the end",
     SCREE_AT_END,
     .force_network = true},
    {{"speed-end", "particles at the end, coloured by their speed", SCREE_WITHOUT_LOADING},
     "Speed at the end",
     SCREE_AT_END,
     .field = FIELD_SPEED},
    {{"spin-end", "particles at the end, coloured by their spin", SCREE_ON_REQUEST},
     "Spin at the end",
     SCREE_AT_END,
     .field = FIELD_SPIN},
    {{"pile", "the pile at the end, its particles coloured by when they were born", SCREE_USUAL},
     "Pile: time of birth",
     SCREE_AT_END,
     .field = FIELD_BIRTH},
    {{"packing-start", "particles at the start of loading, or of the run", SCREE_ON_REQUEST},
     "Packing at the start",
     SCREE_AT_START,
     .view = VIEW_SPACE},
    {{"packing-end", "particles at the end, coloured by their displacement since the start", SCREE_USUAL},
     "Packing at the end: displacements",
     SCREE_AT_END,
     .field = FIELD_DISPLACEMENT,
     .view = VIEW_SPACE},
    {{"section-end", "section at the end, coloured by displacements since the start", SCREE_WITHOUT_LOADING},
     "Section at the end: displacements",
     SCREE_AT_END,
     .field = FIELD_DISPLACEMENT,
     .view = VIEW_SECTION},
    {{"spin-section-end", "section at the end, coloured by spins", SCREE_ON_REQUEST},
     "Section at the end: spin",
     SCREE_AT_END,
     .field = FIELD_SPIN_MAGNITUDE,
     .view = VIEW_SECTION},
    {{"forces-end", "contact forces at the end", SCREE_USUAL},
     "Force network at the end",
     SCREE_AT_END,
     .force_network = true,
     .view = VIEW_SPACE},
    {{"pile", "the pile at the end, its particles coloured by when they were born", SCREE_USUAL},
     "Pile: time of birth",
     SCREE_AT_END,
     .field = FIELD_BIRTH,
     .view = VIEW_SPACE},
    {{"pile-section", "section of the pile at the end, coloured by when its particles were born", SCREE_USUAL},
     "Section of the pile: time of birth",
     SCREE_AT_END,
     .field = FIELD_BIRTH,
     .view = VIEW_SECTION},
};

static double displacement(const scree_snapshot *start, const scree_snapshot *now, size_t k)
{
    double z = now->z ? now->z[k] - start->z[k] : 0;
    return sqrt(pow(now->x[k] - start->x[k], 2) + pow(now->y[k] - start->y[k], 2) + z * z);
}

static double field_value(int field, const scree_snapshot *start, const scree_snapshot *now, size_t k)
{
    switch (field) {
    case FIELD_ROTATION:
        return (now->angle[k] - start->angle[k]) * 180 / M_PI;
    case FIELD_SPIN:
    case FIELD_SPIN_MAGNITUDE:
        return now->spin[k];
    case FIELD_DISPLACEMENT:
        return 1e3 * displacement(start, now, k);
    case FIELD_BIRTH:
        return now->birth ? now->birth[k] : NAN;
    default:
        return 1e3 * sqrt(now->vx[k] * now->vx[k] + now->vy[k] * now->vy[k] + (now->vz ? now->vz[k] * now->vz[k] : 0));
    }
}

scree_status scree_plot_section(const char *path, const scree_snapshot *now, scree_scene *scene, scree_error *error)
{
    scree_snapshot plane;
    scree_status status = scree_section_create(now, &plane, error);
    if (status) return status;
    scene->section = true;
    status = scree_scene_draw(path, &plane, scene, error);
    scree_snapshot_destroy(&plane);
    return status;
}

scree_status scree_plot_space(const char *path, const scree_snapshot *now, scree_scene *scene, scree_error *error)
{
    scree_projection projection;
    scree_status status = scree_projection_create(now, &projection, error);
    if (status) return status;
    scene->depth = projection.depth;
    scene->projection = &projection;
    status = scree_scene_draw(path, &projection.plane, scene, error);
    scree_projection_destroy(&projection);
    return status;
}

static const char *since(const scree_plot_run *run, int field)
{
    if (!fields[field].compares) return "";
    return run->row_count > 0 ? " since the start of loading" : " since the start";
}

static scree_status draw_scene(const scree_plot_run *run, const scree_figure_job *job, const scree_snapshot *start,
                               const scree_snapshot *now, scree_error *error)
{
    const scene_row *entry = (const scene_row *)job->figure;
    double *field = NULL;
    char label[120] = "";
    double heap[2];
    scree_status status = SCREE_OK;
    if (entry->field != FIELD_NONE) status = scree_allocate(&field, now->count, sizeof *field, error);
    for (size_t k = 0; field && k < now->count; k++) field[k] = field_value(entry->field, start, now, k);
    if (field)
        (void)snprintf(label, sizeof label, "%s%s%s", fields[entry->field].meaning, since(run, entry->field),
                       fields[entry->field].unit);
    scree_scene scene = {.title = entry->title,
                         .field = field,
                         .field_name = label,
                         .map = fields[entry->field].map,
                         .force_network = entry->force_network,
                         .boundary = entry->boundary,
                         .of_cell = run->of_cell,
                         .plates = true};
    if (entry->view == VIEW_PLANE && entry->when == SCREE_AT_END && scree_plot_heap(run, heap)) scene.shown = heap;
    if (!status)
        status = entry->view == VIEW_PLANE   ? scree_scene_draw(job->path, now, &scene, error)
                 : entry->view == VIEW_SPACE ? scree_plot_space(job->path, now, &scene, error)
                                             : scree_plot_section(job->path, now, &scene, error);
    scree_release(&field);
    return status;
}

static bool is_meant(const scree_plot_run *run, const scree_figure *figure)
{
    const scene_row *row = (const scene_row *)figure;
    const bool born = row->field != FIELD_BIRTH || scree_series_get(&run->series, "pile_grains");
    return run->snapshot_count > 0 && born && (row->view == VIEW_PLANE) == (run->dimension == 2);
}

static scree_status has_snapshot(const scree_plot_run *run, const scree_figure_job *job, scree_error *error)
{
    size_t which;
    return scree_plot_find_snapshot(run, ((const scene_row *)job->figure)->when, &which, error);
}

scree_status scree_plot_keep_standing(const scree_plot_run *run, size_t which, scree_snapshot *now, scree_error *error)
{
    scree_snapshot next;
    if (which > 0 || isfinite(run->strain[which]) || run->snapshot_count < 2) return SCREE_OK;
    scree_status status = scree_snapshot_read(run->directory, which + 1, &next, error);
    if (status) return status;
    for (int w = 0; w < SCREE_WALL_COUNT; w++) now->wall[w].active = now->wall[w].active && next.wall[w].active;
    scree_snapshot_destroy(&next);
    return SCREE_OK;
}

static scree_status draw(const scree_plot_run *run, const scree_figure_job *job, scree_error *error)
{
    const scene_row *row = (const scene_row *)job->figure;
    scree_snapshot start = {0}, now;
    size_t which;
    scree_status status = scree_plot_find_snapshot(run, row->when, &which, error);
    // Bodies may have come since the start.
    if (!status && fields[row->field].compares)
        status = scree_plot_read_two(run, scree_plot_end_snapshot(run, false), which, &start, &now, error);
    else if (!status)
        status = scree_snapshot_read(run->directory, which, &now, error);
    if (status) return status;
    status = scree_plot_keep_standing(run, which, &now, error);
    if (!status) status = draw_scene(run, job, &start, &now, error);
    scree_snapshot_destroy(&start);
    scree_snapshot_destroy(&now);
    return status;
}

const scree_figure_family scree_figures_scenes = {
    SCREE_FIGURE_ROWS(rows),
    .meant = is_meant,
    .applies = has_snapshot,
    .draw = draw,
};
