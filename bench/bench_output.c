/// What a snapshot of a large run costs beside the disk: bench_output [DISCS [SNAPSHOTS]] (200,000 and 4). Snapshots
/// with contacts and cells and the ParaView files beside them are written into a folder here, and gathered into run.h5
/// as at the end of a run. Beside it as many bytes as they have in the end, in one file, written and flushed: what the
/// disk needs. Times are those of the clock, behind them those of the processor, which other programs disturb less.
/// Both are repeated in turn; a figure is the best.
#include "bench.h"

#include "io/cell_file.h"
#include "io/file_names.h"
#include "io/manifest.h"
#include "io/paraview.h"
#include "io/run_directory.h"
#include "io/run_file.h"
#include "io/snapshot.h"
#include "run/simulation.h"

#include <dirent.h>
#include <fcntl.h>
#include <limits.h>
#include <math.h>
#include <sys/stat.h>
#include <unistd.h>

enum { ROUNDS = 5, BLOCK = 1 << 20 };
static const char folder[] = "bench-output";

static const char text[] = "name: large\n"
                           "materials: [{name: quartz, young_modulus: 3 GPa, density: 2.675e8 kg/m3, friction: 0.45}]\n"
                           "particles: {material: quartz, count: %ld, radius_min: 0.5 mm, radius_max: 1 mm}\n"
                           "integrator: {step: 2e-5 s}\n"
                           "stages: [{stage: prepare, aspect_ratio: 2}, {stage: relax, boundary: plates, duration: 1 s}]\n";

/// Time of the clock and of the processor [s].
typedef struct cost {
    double clock, processor;
} cost;

static cost now(void)
{
    return (cost){seconds(2), seconds(1)};
}

static cost since(cost begin)
{
    const cost end = now();
    return (cost){end.clock - begin.clock, end.processor - begin.processor};
}

static void take_less(cost *best, cost one)
{
    best->clock = fmin(best->clock, one.clock);
    best->processor = fmin(best->processor, one.processor);
}

static void open_packing(long count, scree_case **c, scree_simulation *s)
{
    scree_error error;
    scree_problems *problems = NULL;
    FILE *file = fopen("bench-output.yaml", "we");
    if (!file || fprintf(file, text, count) < 0 || fclose(file) != 0) exit(EXIT_FAILURE);
    if (scree_case_read("bench-output.yaml", NULL, c, &problems))
        require(SCREE_ERROR_INPUT, scree_problems_get(problems, 0));
    require(scree_simulation_open(*c, 1, s, &error), &error);
    // Somewhat into the stage: contacts have their memory.
    while (s->state.step < 20) require(scree_simulation_step(s, &error), &error);
    require(scree_contact_table_build(&s->stage_model, &s->state, &s->work, &s->table, &error), &error);
}

/// Bytes of the files of a folder below here; all of them are removed.
static off_t take_away(const char *path)
{
    off_t bytes = 0;
    DIR *open = opendir(path);
    for (struct dirent *entry; open && (entry = readdir(open));) {
        struct stat file;
        if (fstatat(dirfd(open), entry->d_name, &file, 0) != 0 || !S_ISREG(file.st_mode)) continue;
        bytes += file.st_size;
        (void)unlinkat(dirfd(open), entry->d_name, 0);
    }
    if (open) closedir(open);
    return bytes;
}

static off_t files_of_run(void)
{
    char paraview[PATH_MAX];
    (void)snprintf(paraview, sizeof paraview, "%s/%s", folder, SCREE_FOLDER_PARAVIEW);
    const off_t inner = take_away(paraview);
    (void)rmdir(paraview);
    return inner + take_away(folder);
}

/// Snapshots, ParaView files and run.h5; their bytes.
static off_t write_run(scree_simulation *s, long snapshots, cost part[3])
{
    scree_error error;
    const char *none[1] = {NULL};
    scree_notes notes = {0};
    require(scree_folders_make(folder, &error), &error);
    require(scree_manifest_create(folder, none, 0, &error), &error);
    scree_cells cells = {0};
    require(scree_cells_measure(&s->stage_model, &s->state, &s->table, &cells, &error), &error);
    for (long k = 0; k < snapshots; k++) {
        const scree_snapshot_info info = {.index = k,
                                          .time = 1e-3 * (double)k,
                                          .axial_strain = NAN,
                                          .stage = "relax",
                                          .restartable = true,
                                          .cells = &cells};
        cost begin = now(), spent;
        require(scree_snapshot_write(folder, &s->stage_model, &s->state, &s->table, &info, &error), &error);
        spent = since(begin);
        part[0] = (cost){part[0].clock + spent.clock, part[0].processor + spent.processor};
        begin = now();
        require(scree_paraview_write(folder, &s->stage_model, &s->state, &s->table, &info, &error), &error);
        spent = since(begin);
        part[1] = (cost){part[1].clock + spent.clock, part[1].processor + spent.processor};
    }
    const cost begin = now();
    require(scree_run_file_finish(folder, &notes, &error), &error);
    part[2] = since(begin);
    scree_cells_destroy(&cells);
    return files_of_run();
}

/// So many bytes in one file, flushed.
static cost write_plain(off_t bytes)
{
    char name[PATH_MAX];
    (void)snprintf(name, sizeof name, "%s/plain", folder);
    char *block = malloc(BLOCK);
    if (!block) exit(EXIT_FAILURE);
    for (size_t k = 0; k < BLOCK; k++) block[k] = (char)(k * k >> 3);
    const cost begin = now();
    const int file = open(name, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    for (off_t left = bytes; left > 0; left -= BLOCK)
        if (write(file, block, left < BLOCK ? (size_t)left : BLOCK) <= 0) exit(EXIT_FAILURE);
    if (fsync(file) != 0 || close(file) != 0) exit(EXIT_FAILURE);
    const cost spent = since(begin);
    free(block);
    (void)unlink(name);
    return spent;
}

int main(int count, char **arguments)
{
    const long discs = count > 1 ? strtol(arguments[1], NULL, 10) : 200000;
    const long snapshots = count > 2 ? strtol(arguments[2], NULL, 10) : 4;
    scree_case *c;
    scree_simulation s;
    open_packing(discs, &c, &s);
    const cost never = {INFINITY, INFINITY};
    cost best[5] = {never, never, never, never, never};
    static const char *const names[] = {"snapshots", "ParaView files", "gathering", "together", "as many bytes, plain"};
    off_t bytes = 0;
    for (int round = 0; round < ROUNDS; round++) {
        cost part[4] = {{0, 0}};
        bytes = write_run(&s, snapshots, part);
        for (int k = 0; k < 3; k++) {
            part[3] = (cost){part[3].clock + part[k].clock, part[3].processor + part[k].processor};
            take_less(&best[k], part[k]);
        }
        take_less(&best[3], part[3]);
        take_less(&best[4], write_plain(bytes));
    }
    printf("%ld discs, %ld snapshots, %.1f MB in the end\n", discs, snapshots, 1e-6 * (double)bytes);
    for (size_t k = 0; k < sizeof best / sizeof *best; k++)
        printf("%-22s %8.3f s, processor %8.3f s\n", names[k], best[k].clock, best[k].processor);
    printf("together over plain: %.2f\n", best[3].clock / best[4].clock);
    (void)rmdir(folder);
    (void)unlink("bench-output.yaml");
    scree_simulation_close(&s);
    scree_case_free(c);
    return EXIT_SUCCESS;
}
