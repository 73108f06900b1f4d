/// Movies: the scenes of all snapshots of a run in one frame, with one scale of colours, as PNG files; ffmpeg, where it
/// is there, makes one file of them.
///
/// The snapshots are read twice: first the frame and the colours are widened until all fit in, then they are drawn.
/// What is compared with the start of loading begins there.
#include "base/program.h"
#include "io/run_directory.h"
#include "view/plot_field.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define RATE "12" /* frames a second */

typedef struct movie {
    scree_asked_scene asked;
    scree_scene_frame frame;
    size_t first;          ///< place of the snapshot of frame 0
    char folder[PATH_MAX]; ///< of the frames
    char name[100];        ///< of the file, without a folder
    double factor;         ///< of the values
} movie;

/// Where the field is compared with the start of loading the movie begins there.
static scree_status find_first(movie *m, scree_error *error)
{
    m->asked.which = m->asked.run.snapshot_count - 1;
    scree_status status = scree_asked_read(&m->asked, error);
    if (!status) m->first = m->asked.row->compares ? m->asked.start_at : 0;
    return status;
}

static scree_status measure(movie *m, scree_error *error)
{
    double largest = 0;
    scree_status status = SCREE_OK;
    for (size_t k = m->first; k < m->asked.run.snapshot_count && !status; k++) {
        m->asked.which = k;
        status = scree_asked_read(&m->asked, error);
        for (size_t i = 0; m->asked.value && i < m->asked.now.count && !status; i++)
            if (isfinite(m->asked.value[i])) largest = fmax(largest, fabs(m->asked.value[i]));
        if (!status) status = scree_asked_draw(&m->asked, 1, "", error);
    }
    m->factor = m->asked.value && !status ? scree_asked_name(&m->asked, largest > 0 ? largest : 1) : 1;
    for (int end = 0; end < 2; end++) m->frame.limits[end] *= m->factor;
    m->frame.whole = true;
    return status;
}

/// Frames of an earlier movie that was longer.
static void remove_rest(const movie *m, size_t from)
{
    char path[PATH_MAX + 32];
    do (void)snprintf(path, sizeof path, "%s/frame-%06zu.png", m->folder, from++);
    while (unlink(path) == 0);
}

static scree_status draw(movie *m, scree_error *error)
{
    char path[PATH_MAX + 32];
    scree_status status = SCREE_OK;
    for (size_t k = m->first; k < m->asked.run.snapshot_count && !status; k++) {
        m->asked.which = k;
        status = scree_asked_read(&m->asked, error);
        (void)snprintf(path, sizeof path, "%s/frame-%06zu", m->folder, k - m->first);
        if (!status) status = scree_asked_draw(&m->asked, m->factor, path, error);
    }
    remove_rest(m, m->asked.run.snapshot_count - m->first);
    return status;
}

static scree_status make_folder(movie *m, scree_error *error)
{
    scree_status status = scree_plot_make_folder(&m->asked.run, error);
    if (status) return status;
    (void)snprintf(m->name, sizeof m->name, "movie-%.60s%s", m->asked.row->name,
                   m->asked.scene->section ? "-section" : "");
    (void)snprintf(m->folder, sizeof m->folder, "%.*s/%s", PATH_MAX - 110, m->asked.run.figures, m->name);
    if (mkdir(m->folder, 0777) == 0 || errno == EEXIST) return SCREE_OK;
    return scree_error_set(error, SCREE_ERROR_IO, "cannot make the folder '%s': %s", m->folder, strerror(errno));
}

/// One file of the frames; both sides of its picture are even, as the common pixel format wants it. *why is empty when
/// it was made.
static scree_status join(const movie *m, char *why, size_t size, scree_error *error)
{
    char file[128];
    (void)snprintf(file, sizeof file, "../%s.mp4", m->name);
    const char *const arguments[] = {"ffmpeg",     "-y",
                                     "-loglevel",  "error",
                                     "-framerate", RATE,
                                     "-i",         "frame-%06d.png",
                                     "-vf",        "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white",
                                     "-pix_fmt",   "yuv420p",
                                     file,         NULL};
    const scree_program program = {.folder = m->folder, .arguments = arguments};
    scree_program_end end = {0};
    why[0] = 0;
    if (!scree_program_is_there("ffmpeg")) {
        (void)snprintf(why, size, "ffmpeg is not installed");
        return SCREE_OK;
    }
    scree_status status = scree_program_run(&program, &end, error);
    if (!status && !end.done) (void)snprintf(why, size, "ffmpeg failed: %s", end.said);
    return status;
}

static scree_status tell(const movie *m, const char *why, void (*message)(void *user, const char *path), void *user)
{
    char said[2 * PATH_MAX];
    const size_t frames = m->asked.run.snapshot_count - m->first;
    if (why[0])
        (void)snprintf(said, sizeof said, "warning: %s, so there are the frames alone: %zu in %s", why, frames,
                       m->folder);
    else
        (void)snprintf(said, sizeof said, "%s.mp4", m->folder);
    if (message) message(user, said);
    return SCREE_OK;
}

scree_status scree_plot_movie(const char *directory, const scree_plot_scene *scene,
                              void (*message)(void *user, const char *path), void *user, scree_error *error)
{
    scree_folder_lock taken;
    movie m = {.asked.scene = scene, .frame = scree_scene_frame_begin()};
    char why[700];
    m.asked.frame = &m.frame;
    scree_status status = scree_plot_lock(&taken, directory, error);
    if (!status) status = scree_asked_open(&m.asked, directory, error);
    if (!status) status = find_first(&m, error);
    if (!status) status = make_folder(&m, error);
    if (!status) status = measure(&m, error);
    if (!status) status = draw(&m, error);
    if (!status) status = join(&m, why, sizeof why, error);
    if (!status) scree_plot_warn(message, user);
    if (!status) status = tell(&m, why, message, user);
    scree_asked_close(&m.asked);
    scree_folder_lock_release(&taken);
    return status;
}
