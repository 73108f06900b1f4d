/// Grains from files: formats, units, ids, frames; what a case makes of them; what is refused, and where.
#include "run_fixture.h"

#include "io_scratch.h"

#include "grains/grains.h"
#include "prepare/given.h"

#include <unistd.h>

static const scree_grains_options plain = {.length = 1, .time = 1, .frame = NAN};

static const char *write_file(const char *name, const char *text)
{
    static char path[4][PATH_MAX];
    static int at;
    char *own = path[at++ % 4];
    (void)snprintf(own, PATH_MAX, "%s/%s", scratch, name);
    FILE *file = fopen(own, "w");
    assert_non_null(file);
    (void)fputs(text, file);
    (void)fclose(file);
    return own;
}

static scree_grains read_text(const char *text, const scree_grains_options *options, const char *format)
{
    scree_grains g;
    scree_error error;
    check(scree_grains_read(write_file("grains", text), options, &g, &error), &error);
    assert_string_equal(g.format, format);
    return g;
}

static void expect(const scree_grains *g, int column, double first, double second)
{
    assert_non_null(g->column[column]);
    assert_true(fabs(g->column[column][0] - first) < 1e-14 * (1 + fabs(first)));
    assert_true(fabs(g->column[column][1] - second) < 1e-14 * (1 + fabs(second)));
}

static void tables_have_names_and_units(void **unused)
{
    (void)unused;
    scree_grains g = read_text("# from a scan\nid; x [mm]; y [mm]; diameter [um]; vx; spin [degree/s]; material\n"
                               "7; 2; 3; 500; 0.5; 180; clay\n\n3; 1; 2.5; 300; -1; 0; sand # small\n",
                               &plain, "csv");
    assert_int_equal(g.count, 2);
    expect(&g, SCREE_GRAIN_X, 1e-3, 2e-3); // by id
    expect(&g, SCREE_GRAIN_Y, 2.5e-3, 3e-3);
    expect(&g, SCREE_GRAIN_RADIUS, 150e-6, 250e-6);
    expect(&g, SCREE_GRAIN_VX, -1, 0.5);
    expect(&g, SCREE_GRAIN_WZ, 0, M_PI);
    assert_string_equal(g.kind_name[g.kind[0]], "sand");
    assert_string_equal(g.kind_name[g.kind[1]], "clay");
    scree_grains_destroy(&g);
    const scree_grains_options millimetres = {.length = 1e-3, .time = 1e-6, .frame = NAN};
    g = read_text("x,y,radius,vx,wz\n1,2,0.5,3,4\n2,3,0.25,0,-1\n", &millimetres, "csv");
    expect(&g, SCREE_GRAIN_RADIUS, 0.5e-3, 0.25e-3);
    expect(&g, SCREE_GRAIN_VX, 3e3, 0);
    expect(&g, SCREE_GRAIN_WZ, 4e6, -1e6);
    scree_grains_destroy(&g);
}

static const char dump[] =
    "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS pp pp ff\n-1 3\n0 2\n0 5\n"
    "ITEM: ATOMS id type xs ys z radius fx omegaz\n2 1 0.5 0.5 1 0.1 9 0\n1 2 0.25 0 2 0.2 9 1\n"
    "ITEM: TIMESTEP\n100\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS pp pp ff\n-1 3\n0 2\n0 5\n"
    "ITEM: ATOMS id type xs ys z radius fx omegaz\n2 1 0.75 1 3 0.1 9 2\n1 2 0.5 0.25 4 0.2 9 3\n";

static void dumps_of_lammps(void **unused)
{
    (void)unused;
    scree_grains g = read_text(dump, &plain, "lammps_dump");
    expect(&g, SCREE_GRAIN_X, 1, 2); // of the last frame, by id, unscaled
    expect(&g, SCREE_GRAIN_Z, 4, 3);
    expect(&g, SCREE_GRAIN_RADIUS, 0.2, 0.1);
    expect(&g, SCREE_GRAIN_WZ, 3, 2);
    assert_true(g.bounded && g.bounds[0][0] == -1 && g.bounds[2][1] == 5);
    assert_string_equal(g.left_out, "fx");
    scree_grains_destroy(&g);
    const scree_grains_options first = {.length = 1, .time = 1, .frame = 0};
    g = read_text(dump, &first, "lammps_dump");
    expect(&g, SCREE_GRAIN_X, 0, 1);
    scree_grains_destroy(&g);
}

static void data_files_of_lammps(void **unused)
{
    (void)unused;
    scree_grains g = read_text("a title\n\n2 atoms\n1 atom types\n-1 1 xlo xhi\n0 2 ylo yhi\n0 3 zlo zhi\n\n"
                               "Atoms # sphere\n\n2 1 0.4 2500 1 2 3\n1 1 0.2 2500 -1 0 1 0 0 0\n\n"
                               "Velocities\n\n1 1 2 3 4 5 6\n2 0 0 0 0 0 7\n",
                               &plain, "lammps_data");
    expect(&g, SCREE_GRAIN_X, -1, 1);
    expect(&g, SCREE_GRAIN_RADIUS, 0.1, 0.2);
    expect(&g, SCREE_GRAIN_VY, 2, 0);
    expect(&g, SCREE_GRAIN_WZ, 6, 7);
    assert_true(g.bounded && g.bounds[1][1] == 2);
    scree_grains_destroy(&g);
}

static void exports_of_yade(void **unused)
{
    (void)unused;
    scree_grains g =
        read_text("#format x_y_z_r_matId\n1e-3\t2e-3\t3e-3\t5e-4\t1\n4e-3\t5e-3\t6e-3\t4e-4\t0\n", &plain, "yade");
    expect(&g, SCREE_GRAIN_Z, 3e-3, 6e-3);
    expect(&g, SCREE_GRAIN_RADIUS, 5e-4, 4e-4);
    assert_string_equal(g.kind_name[g.kind[0]], "1");
    scree_grains_destroy(&g);
}

static void what_is_wrong_is_shown(void **unused)
{
    (void)unused;
    static const struct {
        const char *text;
        int line, column;
        const char *message;
    } wrong[] = {
        {"x, y, radios\n1, 2, 3\n", 1, 7, "did you mean 'radius'"},
        {"x [mm], y [mm], radios [mm]\n1, 2, 3\n", 1, 17, "'radios'; did you mean 'radius'"},
        {"x, y, radius\n1, 2, 3\n1, nan, 3\n", 3, 4, "'nan' is not a finite number"},
        {"x, y, radius\n1, 2\n", 2, 1, "this row has 2 values; 3 columns are named"},
        {"x, radius\n1, 2\n", 2, 1, "the column y is missing"},
        {"id, x, y\n4, 2, 1\n4, 3, 1\n", 3, 1, "two grains have the id 4"},
        {"x [s], y\n4, 2\n", 1, 1, "unit of the column x"},
        {"x, y, x\n4, 2, 1\n", 1, 7, "this column is there twice"},
        {"x, y\n", 1, 1, "the file has no grains"},
        {"id, x, y\n", 1, 1, "the file has no grains"},
        {"ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n3\nITEM: ATOMS id x y z\n1 0 0 0\n", 6, 1, "after 1 of 3 grains"},
    };
    for (size_t k = 0; k < sizeof wrong / sizeof *wrong; k++) {
        scree_grains g;
        scree_error error;
        const char *path = write_file("grains", wrong[k].text);
        assert_int_equal(scree_grains_read(path, &plain, &g, &error), SCREE_ERROR_INPUT);
        if (!strstr(error.message, wrong[k].message) || error.line != wrong[k].line || error.column != wrong[k].column)
            fail_msg("%d:%d: %s", error.line, error.column, error.message);
        assert_string_equal(error.file, path);
        assert_null(g.column[0]);
    }
}

/// Against all pairs.
static void overlaps_are_found(void **unused)
{
    (void)unused;
    enum { N = 400 };
    static double x[N], y[N], z[N], radius[N];
    for (int round = 0; round < 20; round++) {
        for (int i = 0; i < N; i++) {
            x[i] = drand48() * (round % 3 ? 1 : 50);
            y[i] = drand48() - 3;
            z[i] = drand48();
            radius[i] = 0.01 + 0.04 * drand48() * drand48();
        }
        const scree_given_bodies bodies = {.count = N, .place = {x, y, round % 2 ? z : NULL}, .radius = radius};
        scree_given_overlap found;
        scree_error error;
        check(scree_given_find_overlap(&bodies, 0.05, &found, &error), &error);
        size_t count = 0, first = 0, second = 0;
        double worst = 0;
        for (size_t i = 0; i < N; i++)
            for (size_t k = i + 1; k < N; k++) {
                const double apart =
                    sqrt(pow(x[i] - x[k], 2) + pow(y[i] - y[k], 2) + (round % 2 ? pow(z[i] - z[k], 2) : 0));
                const double share = (radius[i] + radius[k] - apart) / fmin(radius[i], radius[k]);
                count += share > 0.05;
                if (share > worst) worst = share, first = i, second = k;
            }
        assert_int_equal(found.count, count);
        if (count > 0) assert_true(found.first == first && found.second == second);
    }
}

// ---- cases ---------------------------------------------------------------------------------------------------------

#define HEAD                                                                                                           \
    "scree: 1\nname: own\nmaterials:\n"                                                                                \
    "- {name: sand, young_modulus: 10 MPa, density: 2000 kg/m3, friction: 0.3}\n"                                      \
    "- {name: clay, young_modulus: 10 MPa, density: 1000 kg/m3, friction: 0.3}\n"
#define SIZES                                                                                                          \
    "particles: {shape: disc, material: sand, count: 3, distribution: uniform, radius_min: 0.5 mm, radius_max: 1 "     \
    "mm}\n"
#define OUT "output: {figures: no, paraview: no}\nintegrator: {step: 1 ns}\n"

static void a_case_starts_from_a_file(void **unused)
{
    (void)unused;
    char text[4000];
    const char *path =
        write_file("grains.csv", "x [mm],y [mm],radius [mm],vx,vy,spin,angle,material\n"
                                 "1.5,1,1,0.1,0,3,0.5,sand\n4,1,0.5,0,0,0,0,clay\n6,2,0.75,-0.2,0.1,0,1,2\n");
    (void)snprintf(text, sizeof text,
                   HEAD SIZES OUT "stages:\n- {stage: prepare, method: file, file: %s, width: 8 mm, height: 4 mm}\n"
                                  "- {stage: relax, duration: 1 us, boundary: plates}\n",
                   path);
    scree_case *c = case_read(text, NULL, 0);
    scree_simulation s;
    simulation_open(c, 1, &s);
    simulation_step(&s); // prepares; then 1 ns
    const scree_state *state = &s.state;
    assert_int_equal(state->count, 3);
    for (size_t id = 0; id < 3; id++) {
        static const double x[] = {1.5e-3, 4e-3, 6e-3}, r[] = {1e-3, 0.5e-3, 0.75e-3}, vx[] = {0.1, 0, -0.2},
                            density[] = {2000, 1000, 1000}, angle[] = {0.5, 0, 1};
        const size_t row = state->row_of_id[id];
        assert_true(fabs(state->row[row].x - x[id]) < 1e-9 && fabs(state->row[row].radius - r[id]) < 1e-15);
        assert_true(fabs(state->row[row].vx - vx[id]) < 1e-6 && fabs(state->angle[row] - angle[id]) < 1e-6);
        assert_true(fabs(state->row[row].mass / (density[id] * M_PI * r[id] * r[id] * s.model.thickness) - 1) < 1e-12);
        assert_int_equal(s.model.listed[scree_body_material(state, row)], density[id] == 1000);
    }
    scree_simulation_close(&s);
    scree_case_free(c);
}

/// Runs a case of three grains into a folder; path of its run.h5.
static const char *run_three(const char *name)
{
    static char path[PATH_MAX];
    char text[4000];
    const char *grains =
        write_file("three.csv", "x [mm],y [mm],radius [mm],vx,vy,spin,angle,material\n"
                                "1.5,1.1,1,0.1,0,3,0.5,sand\n4,1,0.5,0,0.25,0,0,clay\n6,2,0.75,-0.2,0.1,0,1,2\n");
    (void)snprintf(text, sizeof text,
                   HEAD SIZES OUT "stages:\n- {stage: prepare, method: file, file: %s, width: 8 mm, height: 4 mm}\n"
                                  "- {stage: relax, duration: 1 us, boundary: plates}\n",
                   grains);
    scree_case *c = case_read(text, NULL, 0);
    (void)snprintf(path, sizeof path, "%s/%s", scratch, name);
    const scree_run_options options = {.output = path, .threads = 1};
    scree_error error;
    check(scree_run(c, &options, &error), &error);
    scree_case_free(c);
    (void)snprintf(path, sizeof path, "%s/%s/run.h5", scratch, name);
    return path;
}

static void snapshots_of_runs(void **unused)
{
    (void)unused;
    scree_grains g;
    scree_error error;
    const char *path = run_three("three");
    check(scree_grains_read(path, &plain, &g, &error), &error);
    assert_string_equal(g.format, "run");
    assert_int_equal(g.count, 3);
    assert_int_equal(g.kinds, 2);
    assert_string_equal(g.kind_name[g.kind[0]], "sand");
    assert_string_equal(g.kind_name[g.kind[1]], "clay");
    for (size_t i = 0; i < 3; i++) { // 1 us later
        static const double at[3][2] = {{1.5e-3, 1.1e-3}, {4e-3, 1e-3}, {6e-3, 2e-3}},
                            v[3][2] = {{0.1, 0}, {0, 0.25}, {-0.2, 0.1}}, r[] = {1e-3, 0.5e-3, 0.75e-3},
                            angle[] = {0.5, 0, 1};
        for (int k = 0; k < 2; k++) {
            assert_true(fabs(g.column[SCREE_GRAIN_X + k][i] - at[i][k] - 1e-6 * v[i][k]) < 1e-12);
            assert_true(fabs(g.column[SCREE_GRAIN_VX + k][i] - v[i][k]) < 1e-12);
        }
        assert_true(fabs(g.column[SCREE_GRAIN_RADIUS][i] - r[i]) < 1e-18);
        assert_true(fabs(g.column[SCREE_GRAIN_ANGLE][i] - angle[i]) < 1e-5);
    }
    assert_true(fabs(g.column[SCREE_GRAIN_WZ][0] - 3) < 1e-12 && !g.column[SCREE_GRAIN_Z] && !g.bounded);
    scree_grains_destroy(&g);
    scree_grains_options first = plain;
    first.frame = 0; // as it was prepared
    check(scree_grains_read(path, &first, &g, &error), &error);
    assert_true(g.column[SCREE_GRAIN_X][0] == 1.5e-3);
    scree_grains_destroy(&g);
    first.frame = 99;
    assert_int_equal(scree_grains_read(path, &first, &g, &error), SCREE_ERROR_INPUT);
    assert_non_null(strstr(error.message, "there is no snapshot 99"));
    first.format = "run";
    assert_int_equal(scree_grains_read(write_file("text", "x,y\n1,2\n"), &first, &g, &error), SCREE_ERROR_IO);
}

/// The message for a table of grains in a case; overrides behind it.
static void expect_refused(const char *table, const char *const *overrides, size_t count, const char *message)
{
    char text[4000];
    const char *path = write_file("wrong.csv", table);
    (void)snprintf(text, sizeof text,
                   HEAD SIZES OUT "stages:\n- {stage: prepare, method: file, file: %s, width: 8 mm, height: 4 mm}\n"
                                  "- {stage: relax, duration: 1 us, boundary: plates}\n",
                   path);
    case_refused(text, overrides, count, message);
}

static void cases_are_checked(void **unused)
{
    (void)unused;
    static const char fine[] = "x [mm],y [mm],radius [mm]\n1.5,1,1\n4,1,0.5\n6,2,0.75\n";
    const char *const four[] = {"particles.count=4"}, *const narrow[] = {"particles.radius_max=0.8 mm"},
                      *const space[] = {"dimension=3", "particles.shape=sphere"},
                      *const checksum[] = {"stages.0.checksum=x12"};
    expect_refused(fine, four, 1, "stages.0 gives 3 bodies");
    expect_refused(fine, narrow, 1, "radii of the file go from 0.0005 to 0.001 m");
    expect_refused(fine, space, 2, "no column z");
    expect_refused(fine, checksum, 1, "the file has changed");
    expect_refused("x [mm],y [mm],radius [mm]\n1.5,1,1\n4,1,0.5\n9,2,0.75\n", NULL, 0, "1 of 3 grains lie outside");
    expect_refused("x [mm],y [mm],radius [mm]\n1.5,1,1\n2,1,0.5\n6,2,0.75\n", NULL, 0,
                   "most of all grains 0 and 1 (from 0), by 2 of it");
    expect_refused("x [mm],y [mm],radius [mm]\n1.5,1,1\n4,x,0.5\n", NULL, 0, "'x' is not a finite number");
    expect_refused("x [mm],y [mm],z [mm],radius [mm]\n1.5,1,1,1\n4,1,2,0.5\n6,2,2,0.75\n", NULL, 0,
                   "they lie in space");
    expect_refused("x [mm],y [mm],radius [mm],material\n1.5,1,1,silt\n4,1,0.5,sand\n6,2,0.75,sand\n", NULL, 0,
                   "no material 'silt'");
    expect_refused("x [mm],y [mm]\n1.5,1\n4,1\n6,2\n", NULL, 0, "the file has no radii");
}

/// Bricks of 2 mm x 1 mm of a file are judged by their outlines: the disc of equal area has 1.6 mm.
static void polygons_of_a_file_are_judged_by_their_outlines(void **unused)
{
    (void)unused;
    static const char form[] =
        "scree: 1\nname: bricks\n"
        "materials: [{name: stone, young_modulus: 1e7 Pa, density: 5000 kg/m3, friction: 0.5}]\n"
        "particles: {shape: polygon, outline: given, corners: [[0, 0], [2, 0], [2, 1], [0, 1]], material: stone, "
        "thickness: 1 m, distribution: equal, radius: 0.7978845608028654 mm}\n"
        "contact: {law: polygon_overlap}\n"
        "output: {figures: no, paraview: no}\n"
        "stages:\n- {stage: prepare, method: file, file: %s, width: 10 mm, height: 10 mm}\n"
        "- {stage: relax, duration: 1 us, boundary: plates}\n";
    static const struct {
        const char *rows, *message; ///< NULL: it is taken
    } tables[] = {
        {"3,0.5,0\n3,1.5,0\n", NULL},
        {"3,1,1.5707963267948966\n4,1,1.5707963267948966\n", NULL},
        {"3,0.5,0\n3,1.3,0\n", "most of all grains 0 and 1 (from 0), by 1.79 of it"}, // A / l = 2 mm, reach 1.118 mm
        {"3,0.5,0\n4.8,0.5,0\n", "1 pair overlaps"}, // discs of equal area would leave 0.2 mm between them
        {"3,0.5,0\n3,0.5,0\n", "grains 0 and 1 (from 0) so deep that no law has a force"},
        {"3,0.5,0\n9.5,2,0\n", "1 of 2 grains lie outside of the box"},
        {"3,0.5,1.5707963267948966\n7,5,0\n", "1 of 2 grains lie outside of the box"},
    };
    for (size_t k = 0; k < sizeof tables / sizeof *tables; k++) {
        char table[200], text[4000];
        (void)snprintf(table, sizeof table, "x [mm],y [mm],angle\n%s", tables[k].rows);
        (void)snprintf(text, sizeof text, form, write_file("bricks.csv", table));
        if (tables[k].message)
            case_refused(text, NULL, 0, tables[k].message);
        else
            scree_case_free(case_read(text, NULL, 0));
    }
}

/// What particles leave out, the file says: number, limits of the radii, and the material where there is but one.
static void a_case_leaves_out_what_the_file_says(void **unused)
{
    (void)unused;
    char text[4000];
    const char *path = write_file("grains.csv", "x [mm],y [mm],radius [mm]\n1.5,1,1\n4,1,0.5\n6,2,0.75\n");
    const char *const begin =
        "scree: 1\nname: own\nmaterials: [{name: sand, young_modulus: 10 MPa, density: 2000 kg/m3, friction: 0.3}]\n";
    const char *const particles[] = {"", "particles: {material: sand}\n", "particles: {count: 3}\n",
                                     "particles: {radius_min: 0.4 mm, radius_max: 2 mm}\n"};
    for (int k = 0; k < 4; k++) {
        (void)snprintf(text, sizeof text,
                       "%s%s" OUT "stages:\n- {stage: prepare, method: file, file: %s, width: 8 mm, height: 4 mm, "
                       "radius_factor: 0.9}\n- {stage: relax, duration: 1 us, boundary: plates}\n",
                       begin, particles[k], path);
        scree_case *c = case_read(text, NULL, 0);
        const scree_config *config = &c->config;
        const scree_size_moments sizes = scree_listed_sizes(config);
        assert_int_equal(config->particles.count, 3);
        assert_string_equal(config->particles.material, "sand");
        assert_true(k == 3 ? sizes.least == 0.4e-3 : fabs(sizes.least - 0.45e-3) < 1e-18);
        assert_true(k == 3 ? sizes.most == 2e-3 : fabs(sizes.most - 0.9e-3) < 1e-18);
        scree_case_free(c);
    }
    const char *const missing[] = {"stages.0.file=/nowhere.csv"};
    (void)snprintf(text, sizeof text, "%s" OUT "stages: [{stage: prepare, method: file, file: %s}]\n", begin, path);
    case_refused_alone(text, missing, 1, "stages.0.file: ");
    // A file without radii: they are what is missing, and not keys that it should have made needless.
    (void)snprintf(text, sizeof text, "%s" OUT "stages: [{stage: prepare, method: file, file: %s}]\n", begin,
                   write_file("bare.csv", "x [mm],y [mm]\n1.5,1\n4,1\n6,2\n"));
    case_refused_alone(text, NULL, 0, "stages.0.file: the file has no radii: give it a column radius");
    // Of another dimension: flattened, its grains would overlap.
    (void)snprintf(text, sizeof text, "%s" OUT "stages: [{stage: prepare, method: file, file: %s}]\n", begin,
                   write_file("space.csv", "x [mm],y [mm],z [mm],radius [mm]\n2,2,1,1\n2,2,4,1\n"));
    case_refused_alone(text, NULL, 0, "stages.0.file: z of the grains goes from");
    // Two materials: which one is not known.
    (void)snprintf(text, sizeof text, HEAD OUT "stages: [{stage: prepare, method: file, file: %s}]\n", path);
    case_refused(text, NULL, 0, "particles.material: required");
}

/// A list may stand in a table, too: its columns are the keys of each element.
static void gradings_stand_in_files(void **unused)
{
    (void)unused;
    static const struct {
        const char *table, *message;
    } wrong[] = {
        {"0.5, 0\n2, 100\n", "the first row does not name the columns"},
        {"sieve [mm], pasing [%]\n0.5, 0\n2, 100\n", "did you mean 'passing'"},
        {"size [mm], passing [%]\n0.5, 0\n2, 100\n", "grading.csv:1:1: particles.grading.size: unknown key"},
        {"sieve [mm], passing [%]\n0.5, 0\n2, 100, 3\n", "more values than the first has names"},
        {"sieve [mm], passing [%]\n0.5, 0\n1, 60\n2, 50\n3, 100\n", "the curve falls: 60 % pass the sieve of 1 mm"},
        {"sieve [mm], passing [%]\n0.5, 0\n", "1 element is too few"},
    };
    char text[4000];
    const char *path = write_file("grading.csv", "sieve [mm]; passing [%]\n0.5; 0\n2; 100\n");
    static const char form[] =
        HEAD OUT "particles: {shape: disc, material: sand, count: 3, distribution: grading, grading: %s}\n"
                 "stages:\n- {stage: prepare, method: gas}\n- {stage: relax, duration: 1 us, boundary: plates}\n";
    (void)snprintf(text, sizeof text, form, path);
    scree_case *c = case_read(text, NULL, 0);
    scree_simulation s;
    simulation_open(c, 1, &s);
    assert_true(s.model.radius_min == 0.25e-3 && s.model.radius_max == 1e-3);
    scree_simulation_close(&s);
    scree_case_free(c);
    for (size_t k = 0; k < sizeof wrong / sizeof *wrong; k++) {
        (void)snprintf(text, sizeof text, form, write_file("grading.csv", wrong[k].table));
        case_refused_alone(text, NULL, 0, wrong[k].message);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tables_have_names_and_units),
        cmocka_unit_test(dumps_of_lammps),
        cmocka_unit_test(data_files_of_lammps),
        cmocka_unit_test(exports_of_yade),
        cmocka_unit_test(what_is_wrong_is_shown),
        cmocka_unit_test(overlaps_are_found),
        cmocka_unit_test(a_case_starts_from_a_file),
        cmocka_unit_test(a_case_leaves_out_what_the_file_says),
        cmocka_unit_test(cases_are_checked),
        cmocka_unit_test(polygons_of_a_file_are_judged_by_their_outlines),
        cmocka_unit_test(gradings_stand_in_files),
        cmocka_unit_test(snapshots_of_runs),
    };
    return cmocka_run_group_tests(tests, make_scratch, remove_scratch);
}
