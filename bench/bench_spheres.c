/// Particle-steps per second and memory of 3D: the bed of bench/data/bed32k.csv.gz (32,000 spheres, hertz_mindlin with
/// history and ledger, step 1e-5 s) on its floor in a box periodic in x and y, settled for 5000 steps more, and after
/// it, when its command is given, LAMMPS on the same configuration and in turn (bench/peers/lammps_spheres.in), springs
/// clear in both, with the energies of both after the same 1000 steps. Then memory and speed of a bed that is this one
/// many times beside itself.
///
/// A measurement is the best of several short runs, since other processes use the machine too, by processor time; only
/// ratios measured in turn mean anything. Arguments: --peer COMMAND (such as "lmp"), --folder FOLDER for its files,
/// --bed and --large choose one setting, --skin LENGTH the skin of both codes [m].
#include "bench.h"
#include "state/plates.h"

#include "base/processor.h"
#include "boundary/periodic.h"
#include "contact/contact.h"
#include "contact/laws.h"
#include "integrate/integrate.h"
#include "measure/measure.h"
#include "search/neighbours.h"
#include "size/limits.h"
#include "state/periodic.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { RUNS = 3, SETTLING_STEPS = 5000, STEPS = 1000, TURNS = 3, COPIES = 32 };
static const double run_seconds = 1.0;
static const double side = 0.05728; // m, of the periodic box
static const double gravity = 9.81, step_size = 1e-5;

typedef struct options {
    const char *peer, *folder;
    double skin;
    bool bed, large;
} options;

typedef struct sample {
    scree_config config;
    scree_config_material material;
    _Alignas(16) unsigned char sizes[1024]; ///< of the particles
    scree_model model;
    scree_state state;
    scree_work work;
    const scree_integrator *integrator;
} sample;

/// The damping coefficient for a restitution e as the peer has it, a fit (Tsuji et al. 1992), so that both codes have
/// one law.
static double peer_damping(double e)
{
    return 1.2728 + e * (-4.2783 + e * (11.087 + e * (-22.348 + e * (27.467 + e * (-18.022 + e * 4.8218)))));
}

static scree_mindlin_material *mindlin_of(const sample *s)
{
    const void *own = scree_config_own(&scree_module_hertz_mindlin, "materials", s->material.own);
    return (scree_mindlin_material *)(uintptr_t)own;
}

static void open_model(sample *s)
{
    static char name[] = "glass";
    static _Alignas(16) unsigned char own[2][1024]; // structs of modules
    scree_error error;
    s->material = (scree_config_material){.name = name,
                                          .young_modulus = 5e6,
                                          .poisson_ratio = 0.3,
                                          .density = 2500,
                                          .friction = 0.5,
                                          .wall_friction = NAN,
                                          .own = own[0]};
    mindlin_of(s)->restitution = 0.3;
    s->config = (scree_config){.dimension = 3, .materials = &s->material, .material_count = 1};
    s->config.particles = (scree_config_particles){.shape = SCREE_SLOT_sphere,
                                                   .material = name,
                                                   .count = 1,
                                                   .distribution = SCREE_SLOT_uniform,
                                                   .thickness = NAN,
                                                   .own = s->sizes};
    *(scree_size_limits *)(uintptr_t)scree_config_own(&scree_module_uniform, "particles", s->sizes) =
        (scree_size_limits){0.5e-3, 1e-3};
    s->config.contact = (scree_config_contact){.law = SCREE_SLOT_hertz_mindlin, .own = own[1]};
    s->config.integrator =
        (scree_config_integrator){.scheme = SCREE_SLOT_velocity_verlet, .step = NAN, .step_fraction = 0.5};
    s->config.guard = (scree_config_guard){.overlap = 0.5, .energy_growth = 0.05};
    require(scree_model_build(&s->config, &s->model, &error), &error);
    s->model.gravity[2] = -gravity;
    s->model.pairs[0][0].value[HERTZ_DAMPING] = s->model.walls[0].value[HERTZ_DAMPING] =
        peer_damping(mindlin_of(s)->restitution);
    s->model.step = step_size; // the model, which knows no load, is more careful
    s->integrator = scree_integrator_get(s->model.scheme);
}

/// The bed, `copies` times beside itself along x. The header has two lines.
static void read_bed(sample *s, size_t copies)
{
    FILE *pipe = popen("gzip -dc '" SCREE_SOURCE_DIR "/bench/data/bed32k.csv.gz'", "r");
    char line[512];
    scree_error error;
    size_t count = 32000, read = 0;
    require(scree_state_create(&s->state, 3, count * copies, &error), &error);
    while (pipe && fgets(line, sizeof line, pipe)) {
        double v[10];
        if (read == count || sscanf(line, "%*d,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf", v, v + 1, v + 2, v + 3, v + 4,
                                    v + 5, v + 6, v + 7, v + 8, v + 9) != 10)
            continue;
        for (size_t c = 0; c < copies; c++) {
            scree_row *row = &s->state.row[c * count + read];
            *row = (scree_row){.x = v[1] + side * (double)c, .y = v[2], .radius = v[0], .vx = v[4], .vy = v[5]};
            row->z = v[3];
            row->vz = v[6];
            row->mass = scree_model_mass(&s->model, 0, v[0]);
            s->state.turn[c * count + read] = (scree_turn_row){v[7], v[8], v[9], 0};
        }
        read++;
    }
    if (!pipe || pclose(pipe) != 0 || read != count)
        require(SCREE_ERROR_IO, &(scree_error){.message = "cannot read the bed"});
}

/// A floor under a box that is periodic in x and y.
static void put_box(scree_state *state, size_t copies)
{
    const double sides[3] = {side * (double)copies, side, 1};
    scree_periodic_set(scree_cell(state), SCREE_PERIODIC_XY, sides);
    scree_plates(state)[SCREE_WALL_BOTTOM] = (scree_wall){.normal = {0, 0, 1}, .active = 1};
}

static void forces(sample *s)
{
    scree_error error;
    require(scree_neighbours_refresh(&s->model, &s->state, &s->work, &error), &error);
    scree_contact_set_quanta(&s->model, &s->state, 0);
    scree_contact_forces(&s->model, &s->state, &s->work);
    scree_periodic_settle(&s->state, &s->work);
    if (!s->work.flags) return;
    (void)fprintf(stderr, "bench_spheres: the kernels raised flag %u\n", s->work.flags);
    exit(EXIT_FAILURE);
}

static void step(sample *s)
{
    scree_error error;
    s->integrator->first(&s->model, &s->state, &s->work);
    require(scree_periodic_move(&s->model, &s->state, &s->work, &error), &error);
    s->state.step++;
    s->state.evaluations++;
    forces(s);
    s->integrator->second(&s->model, &s->state, &s->work);
}

/// Pairs and forces of a sample that has bodies and walls.
static void start(sample *s, const options *o)
{
    scree_error error;
    s->state.largest_speed = 1;
    require(scree_work_create(&s->work, &s->model, 1, &error), &error);
    if (o->skin > 0) s->work.skin = o->skin;
    // The forces at the start move nothing: springs begin at rest, as in the peer.
    s->state.step_size = 0;
    forces(s);
    s->state.step_size = step_size;
}

static void open_bed(sample *s, const options *o, size_t copies)
{
    open_model(s);
    read_bed(s, copies);
    put_box(&s->state, copies);
    start(s, o);
}

/// The bodies and walls of `from`, springs clear.
static void open_copy(sample *s, const options *o, const sample *from)
{
    scree_error error;
    open_model(s);
    require(scree_state_create(&s->state, 3, from->state.count, &error), &error);
    memcpy(s->state.row, from->state.row, s->state.count * sizeof *s->state.row);
    memcpy(s->state.turn, from->state.turn, s->state.count * sizeof *s->state.turn);
    memcpy(scree_plates(&s->state), scree_plates(&from->state), SCREE_WALL_COUNT * sizeof(scree_wall));
    *scree_cell(&s->state) = *scree_cell(&from->state);
    start(s, o);
}

static void close_sample(sample *s)
{
    scree_contact_scratch_destroy(&s->work);
    scree_work_destroy(&s->work);
    scree_state_destroy(&s->state);
}

static double contacts_a_body(const sample *s)
{
    int64_t touching = 0;
    for (size_t k = 0; k < s->state.count; k++) touching += s->state.sum[k].contacts;
    return 0.5 * (double)touching / (double)s->state.count;
}

/// Best particle-steps per second of several runs.
static double measure(sample *s)
{
    double best = 0;
    for (int run = 0; run < RUNS; run++) {
        double begin = seconds(1), elapsed = 0;
        long steps = 0;
        for (; elapsed < run_seconds; elapsed = seconds(1) - begin)
            for (int k = 0; k < 8; k++, steps++) step(s);
        best = fmax(best, (double)s->state.count * (double)steps / elapsed);
    }
    return best;
}

static void print_line(const sample *s, double rate)
{
    size_t live, peak;
    double count = (double)s->state.count;
    scree_allocation_statistics(&live, &peak);
    printf(
        "%9zu spheres  %.2f contacts  %.2f pairs each  %7.2f Mps/s  %6.1f ns  %4.0f bytes (peak %4.0f)  %llu lists\n",
        s->state.count, contacts_a_body(s), (double)s->work.pairs.count / count, 1e-6 * rate, 1e9 / rate,
        (double)live / count, (double)peak / count, (unsigned long long)s->work.rebuilds);
    (void)fflush(stdout);
}

/// Energies [J] at one time: kinetic of translation and of rotation, and m g z.
typedef struct energies {
    double translation, rotation, height;
} energies;

static energies measure_energies(const sample *s)
{
    energies e = {0};
    for (size_t id = 0; id < s->state.count; id++) {
        size_t k = s->state.row_of_id[id];
        scree_vector velocity, spin;
        const scree_row *row = &s->state.row[k];
        scree_body_velocity(&s->model, &s->state, k, velocity, spin);
        e.translation += 0.5 * row->mass * scree_length(velocity) * scree_length(velocity);
        e.rotation += 0.5 * scree_body_inertia(&s->state, k) * scree_length(spin) * scree_length(spin);
        e.height += row->mass * gravity * row->z;
    }
    return e;
}

/// The configuration as a LAMMPS data file.
static void export_data(const sample *s, const char *path)
{
    FILE *file = fopen(path, "w");
    if (!file) require(SCREE_ERROR_IO, &(scree_error){.message = "cannot write the peer's data file"});
    (void)fprintf(file, "a bed of spheres\n\n%zu atoms\n1 atom types\n", s->state.count);
    (void)fprintf(file, "0 %.17g xlo xhi\n0 %.17g ylo yhi\n", side, side);
    (void)fprintf(file, "-1e-3 0.045 zlo zhi\n\nAtoms\n\n");
    for (size_t k = 0; k < s->state.count; k++) {
        const scree_row *row = &s->state.row[k];
        (void)fprintf(file, "%zu 1 %.17g %.17g %.17g %.17g %.17g\n", k + 1, 2 * row->radius, s->material.density,
                      row->x, row->y, row->z);
    }
    (void)fprintf(file, "\nVelocities\n\n");
    for (size_t k = 0; k < s->state.count; k++) {
        const scree_row *row = &s->state.row[k];
        const scree_turn_row *turn = &s->state.turn[k];
        (void)fprintf(file, "%zu %.17g %.17g %.17g %.17g %.17g %.17g\n", k + 1, row->vx, row->vy, row->vz, turn->wx,
                      turn->wy, turn->wz);
    }
    (void)fclose(file);
}

static void write_command(const sample *s, const options *o, char *command, size_t size)
{
    const scree_config_material *m = &s->material;
    (void)snprintf(
        command, size,
        "cd '%s' && OMP_NUM_THREADS=1 %s -in '%s/bench/peers/lammps_spheres.in' -log none -var data spheres.data "
        "-var young %.17g -var poisson %.17g -var restitution %.17g -var friction %.17g -var gravity %.17g "
        "-var step %.17g -var skin %.17g -var steps %d -var wall_normal %.17g -var wall_tangential %.17g",
        o->folder, o->peer, SCREE_SOURCE_DIR, m->young_modulus, m->poisson_ratio, mindlin_of(s)->restitution,
        m->friction, gravity, step_size, s->work.skin, STEPS, s->model.walls[0].value[HERTZ_NORMAL],
        s->model.walls[0].value[HERTZ_TANGENTIAL]);
}

/// Energies in a line of the peer's table.
static void read_energies(const char *line, void *user)
{
    double at, number;
    energies e;
    if (sscanf(line, "%lf %lf %lf %lf %lf", &at, &number, &e.translation, &e.rotation, &e.height) == 5)
        *(energies *)user = e;
}

/// One run of the peer: particle-steps per second of processor time, and its energies in the last line of its table.
static double run_peer(const sample *s, const options *o, energies *last)
{
    char command[2048];
    write_command(s, o, command, sizeof command);
    double elapsed = peer_seconds(command, read_energies, last);
    return elapsed > 0 ? (double)s->state.count * (double)STEPS / elapsed : 0;
}

/// The same 1000 steps in both codes, in turn; the best of each.
static void compare_with_peer(const options *o, const sample *bed)
{
    double ours = 0, theirs = 0;
    energies e = {0}, other = {0};
    char path[1024];
    (void)snprintf(path, sizeof path, "%s/spheres.data", o->folder);
    export_data(bed, path);
    for (int turn = 0; turn < TURNS; turn++) {
        sample s = {0};
        open_copy(&s, o, bed);
        double begin = seconds(1);
        for (int k = 0; k < STEPS; k++) step(&s);
        ours = fmax(ours, (double)s.state.count * STEPS / (seconds(1) - begin));
        e = measure_energies(&s);
        theirs = fmax(theirs, run_peer(&s, o, &other));
        close_sample(&s);
    }
    if (theirs <= 0) {
        printf("%s: no result\n", o->peer);
        return;
    }
    printf("1000 steps: ours %.2f, %s %.2f million particle-steps per second; ratio %.2f (one core, in turn)\n",
           1e-6 * ours, o->peer, 1e-6 * theirs, ours / theirs);
    printf("energies after them [J]   ours            %s             relative difference\n", o->peer);
    printf("  translation             %.8e  %.8e  %.1e\n", e.translation, other.translation,
           e.translation / other.translation - 1);
    printf("  rotation                %.8e  %.8e  %.1e\n", e.rotation, other.rotation, e.rotation / other.rotation - 1);
    printf("  m g z                   %.8e  %.8e  %.1e\n", e.height, other.height, e.height / other.height - 1);
}

static void bench_bed(const options *o)
{
    sample s = {0};
    open_bed(&s, o, 1);
    for (int k = 0; k < SETTLING_STEPS; k++) step(&s);
    print_line(&s, measure(&s));
    if (o->peer) compare_with_peer(o, &s);
    close_sample(&s);
}

static void bench_large(const options *o)
{
    sample s = {0};
    open_bed(&s, o, COPIES);
    for (int k = 0; k < 10; k++) step(&s);
    print_line(&s, measure(&s));
    close_sample(&s);
}

int main(int argc, char **argv)
{
    options o = {.folder = "."};
    for (int k = 1; k < argc; k++) {
        if (strcmp(argv[k], "--bed") == 0)
            o.bed = true;
        else if (strcmp(argv[k], "--large") == 0)
            o.large = true;
        else if (strcmp(argv[k], "--peer") == 0 && k + 1 < argc)
            o.peer = argv[++k];
        else if (strcmp(argv[k], "--folder") == 0 && k + 1 < argc)
            o.folder = argv[++k];
        else if (strcmp(argv[k], "--skin") == 0 && k + 1 < argc)
            o.skin = strtod(argv[++k], NULL);
        else
            return (void)fprintf(stderr, "bench_spheres: what is '%s'?\n", argv[k]), EXIT_FAILURE;
    }
    printf("kernels: x86-64-v%d\n", scree_processor_level());
    if (o.bed || !o.large) bench_bed(&o);
    if (o.large || !o.bed) bench_large(&o);
    return EXIT_SUCCESS;
}
