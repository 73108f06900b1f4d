/// Particle-steps per second of the stepping loop (integrator, neighbour list, contact forces), in two settings:
///
/// 1. a settled biaxial cell: drop-and-roll packing of the built-in case between four plates that close around it and
///    are then held; both laws, one and more threads; beside it, in turn and when its command is
///    given, LAMMPS on the same configuration (bench/peers/lammps_biaxial.in);
/// 2. large assemblies, 10,000 to 1,000,000 discs: a hexagonal lattice of slightly unequal discs under pressure.
///
/// A measurement is the best of several short runs, since other processes use the machine too; one thread is timed by
/// its processor time. Only ratios measured in turn mean anything. Arguments: --peer COMMAND (such as "lmp"), --folder
/// FOLDER for its files, --cell and --large choose one setting, --count N the size of the cell.
#include "bench.h"
#include "state/plates.h"

#include "base/processor.h"
#include "boundary/plates.h"
#include "case/case.h"
#include "contact/contact.h"
#include "contact/laws.h"
#include "integrate/integrate.h"
#include "prepare/prepare.h"
#include "search/neighbours.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { RUNS = 5, CLOSING_STEPS = 40000, RESTING_STEPS = 6000, LATTICE_STEPS = 40 };
static const double run_seconds = 0.4;
static const double closing = 1e-6;                                  // strain a step
static const double dense = 2.0;                                     // contacts a body
static const double lattice_spacing = 1.997, lattice_spread = 0.002; // mean radii

typedef struct options {
    const char *peer, *folder;
    long count;
    bool cell, large;
} options;

typedef struct sample {
    scree_case *c;
    scree_model model;
    scree_state state;
    scree_work work;
    const scree_integrator *integrator;
} sample;

/// The built-in biaxial case with `count` discs under `law`, as a model.
static void open_case(sample *s, const char *law, long count)
{
    char number[64], name[64];
    (void)snprintf(number, sizeof number, "particles.count=%ld", count);
    (void)snprintf(name, sizeof name, "contact.law=%s", law);
    const char *overrides[] = {number, name, "boundary.lateral=plates"};
    scree_case_options choice = {.overrides = overrides, .override_count = 3};
    scree_problems *problems = NULL;
    scree_error error;
    if (scree_case_read(SCREE_SOURCE_DIR "/cases/biaxial.yaml", &choice, &s->c, &problems))
        require(SCREE_ERROR_INPUT, scree_problems_get(problems, 0));
    require(scree_model_build(&s->c->config, &s->model, &error), &error);
    s->integrator = scree_integrator_get(s->model.scheme);
}

static void step(sample *s)
{
    scree_error error;
    scree_plates_move(&s->state);
    s->integrator->first(&s->model, &s->state, &s->work);
    s->state.step++;
    require(scree_neighbours_refresh(&s->model, &s->state, &s->work, &error), &error);
    scree_contact_set_quanta(&s->model, &s->state, 0);
    scree_contact_forces(&s->model, &s->state, &s->work);
    if (s->integrator->second) s->integrator->second(&s->model, &s->state, &s->work);
    if (s->work.flags) {
        (void)fprintf(stderr, "bench_biaxial: the kernels raised flag %u\n", s->work.flags);
        exit(EXIT_FAILURE);
    }
}

static void close_sample(sample *s)
{
    scree_contact_scratch_destroy(&s->work);
    scree_work_destroy(&s->work);
    scree_state_destroy(&s->state);
    scree_case_free(s->c);
}

/// Contacts a body, walls counted half.
static double contacts_a_body(const sample *s)
{
    int64_t touching = 0;
    for (size_t k = 0; k < s->state.count; k++) touching += s->state.sum[k].contacts;
    return 0.5 * (double)touching / (double)s->state.count;
}

/// Four plates close around the packing, without friction, until it is dense; then they are held and it comes to rest.
static void settle(sample *s)
{
    scree_state *state = &s->state;
    scree_model model = s->model;
    double top = 0;
    for (size_t k = 0; k < state->count; k++) top = fmax(top, state->row[k].y + state->row[k].radius);
    scree_plates(state)[SCREE_WALL_TOP] = (scree_wall){.position = -top, .normal = {0, -1}};
    for (int w = 0; w <= SCREE_WALL_RIGHT; w++) {
        scree_plates(state)[w].active = 1;
        scree_plates(state)[w].velocity =
            closing * scree_plate_area(&model, state, w) / model.thickness / state->step_size;
    }
    s->model = scree_model_with_friction(&model, 0);
    for (int k = 0; k < CLOSING_STEPS && contacts_a_body(s) < dense; k++) step(s);
    s->model = model;
    for (int w = 0; w < SCREE_WALL_COUNT; w++) scree_plates(state)[w].velocity = 0;
    for (int k = 0; k < RESTING_STEPS; k++) step(s);
}

static void make_cell(sample *s, const char *law, long count)
{
    scree_error error;
    open_case(s, law, count);
    require(scree_prepare(&s->model, &s->c->config.stages[0], &s->state, &error), &error);
    require(scree_work_create(&s->work, &s->model, 1, &error), &error);
    settle(s);
}

/// Slightly unequal discs on a hexagonal lattice in a box of four plates that presses them together.
static void make_lattice(sample *s, const char *law, long count)
{
    scree_error error;
    open_case(s, law, count);
    size_t side = (size_t)sqrt((double)count);
    require(scree_state_create(&s->state, 2, side * side, &error), &error);
    require(scree_work_create(&s->work, &s->model, 1, &error), &error);
    s->state.step_size = s->model.step;
    double spacing = lattice_spacing * s->model.mean_radius, half = 0.5 * spacing;
    for (size_t k = 0; k < s->state.count; k++) {
        scree_row *row = &s->state.row[k];
        double i = (double)(k % side), j = (double)(k / side);
        row->radius = s->model.mean_radius * (1 + lattice_spread * sin(12.9898 * i + 78.233 * j));
        row->mass = s->model.density[0] * M_PI * row->radius * row->radius * s->model.thickness;
        row->x = half + spacing * (i + 0.5 * fmod(j, 2));
        row->y = half + spacing * sqrt(0.75) * j;
    }
    double width = spacing * ((double)side + 0.5), height = spacing * (sqrt(0.75) * (double)(side - 1) + 1);
    const double normal[][2] = {{0, 1}, {0, -1}, {1, 0}, {-1, 0}};
    const double position[] = {0, -height, 0, -width};
    for (int w = 0; w <= SCREE_WALL_RIGHT; w++)
        scree_plates(&s->state)[w] =
            (scree_wall){.position = position[w], .normal = {normal[w][0], normal[w][1]}, .active = 1};
    for (int k = 0; k < LATTICE_STEPS; k++) step(s);
}

/// Best particle-steps per second of several runs.
static double measure(sample *s, int threads)
{
    double best = 0;
    s->work.threads = threads;
    step(s);
    for (int run = 0; run < RUNS; run++) {
        double begin = seconds(threads), elapsed = 0;
        long steps = 0;
        for (; elapsed < run_seconds; elapsed = seconds(threads) - begin)
            for (int k = 0; k < 8; k++, steps++) step(s);
        best = fmax(best, (double)s->state.count * (double)steps / elapsed);
    }
    return best;
}

static double bytes_a_body(const sample *s)
{
    size_t live;
    scree_allocation_statistics(&live, NULL);
    return (double)live / (double)s->state.count;
}

static void print_head(void)
{
    printf("%-18s %8s %8s %7s %9s %7s %8s\n", "law", "discs", "contacts", "threads", "Mps/s", "ns", "bytes");
}

static void print_line(const sample *s, const char *law, int threads, double rate)
{
    printf("%-18s %8zu %8.2f %7d %9.2f %7.1f %8.0f\n", law, s->state.count, contacts_a_body(s), threads, 1e-6 * rate,
           1e9 / rate, bytes_a_body(s));
    (void)fflush(stdout);
}

/// The configuration as a LAMMPS data file: mass is given through a density of spheres.
static void export_data(const sample *s, const char *path)
{
    FILE *file = fopen(path, "w");
    if (!file) require(SCREE_ERROR_IO, &(scree_error){.message = "cannot write the peer's data file"});
    const scree_wall *w = scree_plates(&s->state);
    double margin = s->model.mean_radius;
    (void)fprintf(file, "a settled biaxial cell\n\n%zu atoms\n1 atom types\n", s->state.count);
    (void)fprintf(file, "%.17g %.17g xlo xhi\n", w[SCREE_WALL_LEFT].position - margin,
                  -w[SCREE_WALL_RIGHT].position + margin);
    (void)fprintf(file, "%.17g %.17g ylo yhi\n", w[SCREE_WALL_BOTTOM].position - margin,
                  -w[SCREE_WALL_TOP].position + margin);
    (void)fprintf(file, "%.17g %.17g zlo zhi\n\nAtoms\n\n", -margin, margin);
    for (size_t k = 0; k < s->state.count; k++) {
        const scree_row *row = &s->state.row[k];
        double volume = 4.0 / 3.0 * M_PI * row->radius * row->radius * row->radius;
        (void)fprintf(file, "%zu 1 %.17g %.17g %.17g %.17g 0\n", k + 1, 2 * row->radius, row->mass / volume, row->x,
                      row->y);
    }
    (void)fprintf(file, "\nVelocities\n\n");
    for (size_t k = 0; k < s->state.count; k++) {
        const scree_row *row = &s->state.row[k];
        (void)fprintf(file, "%zu %.17g %.17g 0 0 0 %.17g\n", k + 1, row->vx, row->vy, row->spin);
    }
    (void)fclose(file);
}

/// The command line of the peer for this sample.
static void write_command(const sample *s, const options *o, long steps, char *command, size_t size)
{
    const scree_config_material *m = &s->model.config->materials[0];
    const scree_mindlin_material *own = scree_config_own(&scree_module_hertz_mindlin, "materials", m->own);
    const scree_wall *w = scree_plates(&s->state);
    (void)snprintf(
        command, size,
        "cd '%s' && OMP_NUM_THREADS=1 %s -in '%s/bench/peers/lammps_biaxial.in' -log none -var data cell.data "
        "-var young %.17g -var poisson %.17g -var restitution %.17g -var friction %.17g -var step %.17g "
        "-var skin %.17g -var steps %ld -var left %.17g -var right %.17g -var bottom %.17g -var top %.17g",
        o->folder, o->peer, SCREE_SOURCE_DIR, m->young_modulus, m->poisson_ratio, own->restitution, m->friction,
        s->state.step_size, s->work.skin, steps, w[SCREE_WALL_LEFT].position, -w[SCREE_WALL_RIGHT].position,
        w[SCREE_WALL_BOTTOM].position, -w[SCREE_WALL_TOP].position);
}

/// One run of the peer: particle-steps per second of processor time.
static double run_peer(const sample *s, const options *o, long steps)
{
    char command[2048];
    write_command(s, o, steps, command, sizeof command);
    double elapsed = peer_seconds(command, NULL, NULL);
    return elapsed > 0 ? (double)s->state.count * (double)steps / elapsed : 0;
}

/// Our loop and the peer's in turn; the best of each.
static void compare_with_peer(sample *s, const options *o)
{
    char path[1024];
    double ours = 0, theirs = 0;
    (void)snprintf(path, sizeof path, "%s/cell.data", o->folder);
    export_data(s, path);
    for (int turn = 0; turn < 3; turn++) {
        ours = fmax(ours, measure(s, 1));
        theirs = fmax(theirs, run_peer(s, o, 4000000 / (long)s->state.count));
    }
    if (theirs > 0)
        printf("%s: %.2f million particle-steps per second; ratio %.2f (hertz_mindlin, one core, in turn)\n", o->peer,
               1e-6 * theirs, ours / theirs);
    else
        printf("%s: no result\n", o->peer);
}

static void bench_cell(const options *o)
{
    const char *const laws[] = {"hertz_mindlin", "hertz_brilliantov"};
    printf("\nsettled biaxial cell, four plates\n");
    print_head();
    for (int law = 0; law < 2; law++) {
        sample s = {0};
        make_cell(&s, laws[law], o->count);
        for (int threads = 1; threads <= scree_processor_count() && threads <= 4; threads *= 2)
            print_line(&s, laws[law], threads, measure(&s, threads));
        if (law == 0 && o->peer) compare_with_peer(&s, o);
        close_sample(&s);
    }
}

static void bench_large(void)
{
    double smallest = 0, rate = 0;
    printf("\nhexagonal lattice of unequal discs\n");
    print_head();
    for (long count = 10000; count <= 1000000; count *= 10) {
        sample s = {0};
        make_lattice(&s, "hertz_mindlin", count);
        rate = measure(&s, 1);
        if (count == 10000) smallest = rate;
        print_line(&s, "hertz_mindlin", 1, rate);
        close_sample(&s);
    }
    printf("cost of a particle-step at 1,000,000 discs over that at 10,000: %.2f\n", smallest / rate);
}

int main(int argc, char **argv)
{
    options o = {.folder = ".", .count = 4000};
    for (int k = 1; k < argc; k++) {
        if (strcmp(argv[k], "--cell") == 0)
            o.cell = true;
        else if (strcmp(argv[k], "--large") == 0)
            o.large = true;
        else if (strcmp(argv[k], "--peer") == 0 && k + 1 < argc)
            o.peer = argv[++k];
        else if (strcmp(argv[k], "--folder") == 0 && k + 1 < argc)
            o.folder = argv[++k];
        else if (strcmp(argv[k], "--count") == 0 && k + 1 < argc)
            o.count = strtol(argv[++k], NULL, 10);
        else
            return (void)fprintf(stderr, "bench_biaxial: what is '%s'?\n", argv[k]), EXIT_FAILURE;
    }
    printf("kernels: x86-64-v%d\n", scree_processor_level());
    if (o.cell || !o.large) bench_cell(&o);
    if (o.large || !o.cell) bench_large();
    return EXIT_SUCCESS;
}
