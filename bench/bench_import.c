/// Reading a million grains: the table that a user writes, CSV with radii, velocities, spins and materials. Prints the
/// processor time, the best of three.
#include "bench.h"

#include "grains/grains.h"

#include "base/random.h"

#include <math.h>
#include <unistd.h>

enum { SIDE = 1000 };

/// A square lattice whose grains do not touch.
static void write_table(const char *path)
{
    FILE *file = fopen(path, "we");
    if (!file) exit(EXIT_FAILURE);
    (void)fputs("x [mm],y [mm],radius [mm],vx [m/s],vy [m/s],wz [rad/s],material\n", file);
    for (uint64_t k = 0; k < (uint64_t)SIDE * SIDE; k++) {
        double draw[4];
        for (uint64_t i = 0; i < 4; i++) draw[i] = scree_random_uniform(1, SCREE_RANDOM_TEST, 4 * k + i);
        (void)fprintf(file, "%.6f,%.6f,%.6f,%.8g,%.8g,%.8g,sand\n", 1 + 2.0 * (double)(k % SIDE),
                      1 + 2.0 * (double)(k / SIDE), 0.5 + 0.45 * draw[0], draw[1], draw[2], draw[3]);
    }
    if (fclose(file) != 0) exit(EXIT_FAILURE);
}

static double read_table(const char *path)
{
    const scree_grains_options options = {.length = 1, .time = 1, .frame = NAN};
    scree_error error = {0};
    scree_grains grains;
    const double begin = seconds(1);
    require(scree_grains_read(path, &options, &grains, &error), &error);
    const double taken = seconds(1) - begin;
    if (grains.count != (size_t)SIDE * SIDE) exit(EXIT_FAILURE);
    scree_grains_destroy(&grains);
    return taken;
}

int main(void)
{
    char path[] = "/tmp/scree_bench_import_XXXXXX.csv";
    const int file = mkstemps(path, 4);
    if (file < 0 || close(file) != 0) return EXIT_FAILURE;
    write_table(path);
    double best = INFINITY;
    for (int k = 0; k < 3; k++) best = fmin(best, read_table(path));
    (void)printf("reading %d grains, 7 columns: %.2f s\n", SIDE * SIDE, best);
    return unlink(path) == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
