/// A scene that the user asks for: the bodies of one snapshot, coloured by a field, or the network of their forces.
#include "view/plot_field.h"

#include "base/memory.h"
#include "io/run_directory.h"
#include "io/snapshot_when.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// ---- fields ------------------------------------------------------------------------------------------------------

static double length_of(double x, double y, double z)
{
    return sqrt(x * x + y * y + z * z);
}

static void take_speed(const scree_snapshot *start, const scree_snapshot *now, int axis, double *value)
{
    (void)start;
    const double *const component[] = {now->vx, now->vy, now->vz};
    for (size_t k = 0; k < now->count; k++)
        value[k] = axis >= 0 ? component[axis][k] : length_of(now->vx[k], now->vy[k], now->vz ? now->vz[k] : 0);
}

static void take_displacement(const scree_snapshot *start, const scree_snapshot *now, int axis, double *value)
{
    for (size_t k = 0; k < now->count; k++) {
        const double move[] = {now->x[k] - start->x[k], now->y[k] - start->y[k], now->z ? now->z[k] - start->z[k] : 0};
        value[k] = axis >= 0 ? move[axis] : length_of(move[0], move[1], move[2]);
    }
}

static void take_rotation(const scree_snapshot *start, const scree_snapshot *now, int axis, double *value)
{
    (void)axis;
    for (size_t k = 0; k < now->count; k++) value[k] = (now->angle[k] - start->angle[k]) * 180 / M_PI;
}

static void take_spin(const scree_snapshot *start, const scree_snapshot *now, int axis, double *value)
{
    (void)start;
    (void)axis;
    memcpy(value, now->spin, now->count * sizeof *value);
}

static void take_radius(const scree_snapshot *start, const scree_snapshot *now, int axis, double *value)
{
    (void)start;
    (void)axis;
    memcpy(value, now->radius, now->count * sizeof *value);
}

static void take_birth(const scree_snapshot *start, const scree_snapshot *now, int axis, double *value)
{
    (void)start;
    (void)axis;
    for (size_t k = 0; k < now->count; k++) value[k] = now->birth ? now->birth[k] : NAN;
}

/// Contacts that bear a force, with walls among them.
static void take_coordination(const scree_snapshot *start, const scree_snapshot *now, int axis, double *value)
{
    (void)start;
    (void)axis;
    memset(value, 0, now->count * sizeof *value);
    for (size_t k = 0; k < now->contact_count; k++) {
        if (now->normal_force[k] == 0) continue;
        if (now->first[k] < now->count) value[now->first[k]]++;
        if (now->second[k] < now->count) value[now->second[k]]++;
    }
}

/// The largest normal force of the contacts of each body.
static void take_force(const scree_snapshot *start, const scree_snapshot *now, int axis, double *value)
{
    (void)start;
    (void)axis;
    memset(value, 0, now->count * sizeof *value);
    for (size_t k = 0; k < now->contact_count; k++) {
        const uint32_t end[] = {now->first[k], now->second[k]};
        for (int e = 0; e < 2; e++)
            if (end[e] < now->count) value[end[e]] = fmax(value[end[e]], now->normal_force[k]);
    }
}

// clang-format off
static const scree_field_row fields[] = {
    {"speed", "speed", "@m/s", SCREE_COLOUR_SEQUENTIAL, take_speed, -1, 0, false},
    {"velocity_x", "velocity along x", "@m/s", SCREE_COLOUR_DIVERGING, take_speed, 0, 0, false},
    {"velocity_y", "velocity along y", "@m/s", SCREE_COLOUR_DIVERGING, take_speed, 1, 0, false},
    {"velocity_z", "velocity along z", "@m/s", SCREE_COLOUR_DIVERGING, take_speed, 2, 3, false},
    {"displacement", "displacement", "@m", SCREE_COLOUR_SEQUENTIAL, take_displacement, -1, 0, true},
    {"displacement_x", "displacement along x", "@m", SCREE_COLOUR_DIVERGING, take_displacement, 0, 0, true},
    {"displacement_y", "displacement along y", "@m", SCREE_COLOUR_DIVERGING, take_displacement, 1, 0, true},
    {"displacement_z", "displacement along z", "@m", SCREE_COLOUR_DIVERGING, take_displacement, 2, 3, true},
    {"rotation", "rotation, counter-clockwise positive", "degrees", SCREE_COLOUR_DIVERGING, take_rotation, -1, 2, true},
    {"spin", "spin, counter-clockwise positive", "rad/s", SCREE_COLOUR_DIVERGING, take_spin, -1, 2, false},
    {"spin", "spin, magnitude", "rad/s", SCREE_COLOUR_SEQUENTIAL, take_spin, -1, 3, false},
    {"radius", "radius", "@m", SCREE_COLOUR_SEQUENTIAL, take_radius, -1, 0, false},
    {"coordination", "contacts of each particle", "1", SCREE_COLOUR_SEQUENTIAL, take_coordination, -1, 0, false},
    {"force", "largest normal force at each particle", "@N", SCREE_COLOUR_SEQUENTIAL, take_force, -1, 0, false},
    {"birth", "time of birth", "s", SCREE_COLOUR_SEQUENTIAL, take_birth, -1, 0, false},
    {"forces", "force network", "", SCREE_COLOUR_SEQUENTIAL, NULL, -1, 0, false},
};
// clang-format on
enum { FIELDS = sizeof fields / sizeof *fields };

void scree_plot_field_visit(void (*visit)(void *user, const char *name, const char *meaning), void *user)
{
    for (int k = 0; k < FIELDS; k++)
        if (k == 0 || strcmp(fields[k].name, fields[k - 1].name) != 0) visit(user, fields[k].name, fields[k].meaning);
}

static scree_status find_field(const scree_asked_scene *asked, int dimension, const scree_field_row **row,
                               scree_error *error)
{
    const char *known[FIELDS], *name = asked->scene->field;
    size_t count = 0;
    *row = NULL;
    for (int k = 0; k < FIELDS; k++) {
        if (fields[k].dimension != 0 && fields[k].dimension != dimension) continue;
        known[count++] = fields[k].name;
        if (strcmp(fields[k].name, name) == 0) *row = &fields[k];
    }
    if (*row) return SCREE_OK;
    const char *nearest = scree_nearest(name, known, count);
    char list[sizeof error->accepted];
    size_t used = 0;
    for (size_t k = 0; k < count && used < sizeof list; k++)
        used += (size_t)snprintf(list + used, sizeof list - used, "%s%s", k > 0 ? ", " : "", known[k]);
    return scree_error_refuse(error, asked->frame ? "--movie" : "--scene", nearest ? nearest : list,
                              "scenes of this run have no field '%s'", name);
}

// ---- which snapshot ----------------------------------------------------------------------------------------------

/// The first snapshot of the loading stage that was the last.
static size_t find_start(const scree_snapshot_mark *mark, size_t count)
{
    size_t first = count;
    while (first > 0 && !isfinite(mark[first - 1].axial_strain)) first--;
    if (first == 0) return 0;
    first--;
    while (first > 0 && isfinite(mark[first - 1].axial_strain) &&
           !scree_snapshot_begins_stage(mark[first - 1].stage, mark[first].stage, mark[first].axial_strain))
        first--;
    return first;
}

// ---- drawing -----------------------------------------------------------------------------------------------------

static scree_status read_snapshots(scree_asked_scene *asked, scree_error *error)
{
    scree_status status = scree_snapshot_read(asked->run.directory, asked->which, &asked->now, error);
    if (!status) status = find_field(asked, asked->now.dimension, &asked->row, error);
    if (!status && asked->scene->section && (asked->now.dimension == 2 || !asked->row->values))
        status = scree_error_refuse(error, "--section", "a run of spheres and a field of bodies",
                                    asked->now.dimension == 2 ? "discs cannot be cut" : "a cut has no contacts");
    // What is compared with a later start is compared with the first snapshot.
    asked->start_at = find_start(asked->mark, asked->run.snapshot_count);
    if (asked->which < asked->start_at) asked->start_at = 0;
    if (!status && asked->row->compares) {
        scree_snapshot_destroy(&asked->now);
        status = scree_plot_read_two(&asked->run, asked->start_at, asked->which, &asked->start, &asked->now, error);
    }
    return status;
}

static void give_back(scree_asked_scene *asked)
{
    scree_snapshot_destroy(&asked->start);
    scree_snapshot_destroy(&asked->now);
    scree_release(&asked->value);
}

scree_status scree_asked_read(scree_asked_scene *asked, scree_error *error)
{
    give_back(asked);
    scree_status status = read_snapshots(asked, error);
    if (!status) status = scree_plot_keep_standing(&asked->run, asked->which, &asked->now, error);
    if (status || !asked->row->values) return status;
    status = scree_allocate(&asked->value, asked->now.count, sizeof *asked->value, error);
    if (!status) asked->row->values(&asked->start, &asked->now, asked->row->axis, asked->value);
    return status;
}

double scree_asked_name(scree_asked_scene *asked, double largest)
{
    char pattern[160];
    const scree_field_row *row = asked->row;
    const char *since = !row->compares ? "" : asked->start_at > 0 ? " since the start of loading" : " since the start";
    (void)snprintf(pattern, sizeof pattern, "%s%s (%s)", row->meaning, since, row->unit);
    return scree_plot_label(asked->label, sizeof asked->label, pattern, largest);
}

scree_status scree_asked_draw(scree_asked_scene *asked, double factor, const char *path, scree_error *error)
{
    const scree_snapshot *now = &asked->now;
    char title[100];
    for (size_t k = 0; asked->value && k < now->count; k++) asked->value[k] *= factor;
    (void)snprintf(title, sizeof title, "%c%.90s", toupper((unsigned char)asked->row->meaning[0]),
                   asked->row->meaning + 1);
    scree_scene scene = {.title = title,
                         .field = asked->value,
                         .field_name = asked->label,
                         .map = asked->row->map,
                         .force_network = !asked->row->values,
                         .of_cell = now->periodic.directions == (1u << now->dimension) - 1,
                         .plates = true,
                         .frame = asked->frame};
    if (now->dimension == 2) return scree_scene_draw(path, now, &scene, error);
    return asked->scene->section ? scree_plot_section(path, now, &scene, error)
                                 : scree_plot_space(path, now, &scene, error);
}

scree_status scree_asked_open(scree_asked_scene *asked, const char *directory, scree_error *error)
{
    size_t count = 0;
    asked->run.directory = directory;
    scree_status status = scree_snapshot_marks(directory, &asked->mark, &count, error);
    if (!status) status = scree_allocate(&asked->run.strain, count, sizeof *asked->run.strain, error);
    if (status) return status;
    asked->run.snapshot_count = count;
    for (size_t k = 0; k < count; k++) asked->run.strain[k] = asked->mark[k].axial_strain;
    return scree_snapshot_find_when(asked->mark, count, asked->scene->at ? asked->scene->at : "end", "--at",
                                    &asked->which, error);
}

void scree_asked_close(scree_asked_scene *asked)
{
    give_back(asked);
    scree_release(&asked->mark);
    scree_release(&asked->run.strain);
}

scree_status scree_plot_field(const char *directory, const scree_plot_scene *scene,
                              void (*message)(void *user, const char *path), void *user, scree_error *error)
{
    scree_folder_lock taken;
    scree_asked_scene asked = {.scene = scene};
    char path[PATH_MAX], said[PATH_MAX + 8];
    scree_status status = scree_plot_lock(&taken, directory, error);
    if (!status) status = scree_asked_open(&asked, directory, error);
    if (!status) status = scree_asked_read(&asked, error);
    if (!status) status = scree_plot_make_folder(&asked.run, error);
    if (!status) {
        const double factor =
            asked.value ? scree_asked_name(&asked, scree_plot_largest(asked.value, asked.now.count)) : 1;
        (void)snprintf(path, sizeof path, "%.*s/scene-%s%s-%06lld", PATH_MAX - 64, asked.run.figures, asked.row->name,
                       scene->section ? "-section" : "", (long long)asked.now.index);
        status = scree_asked_draw(&asked, factor, path, error);
    }
    if (!status && message) {
        (void)snprintf(said, sizeof said, "%s.svg", path);
        scree_plot_warn(message, user);
        message(user, said);
    }
    scree_asked_close(&asked);
    scree_folder_lock_release(&taken);
    return status;
}
