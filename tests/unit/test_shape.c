/// STL files and meshes: forms, errors, random bytes, topology, closest points against brute force.
#include "wall_fixture.h"

#include "base/file_bytes.h"

/// A tetrahedron whose coordinates are no short decimals.
static const triangle_corners tetrahedron[4] = {
    {{0.1, 0.2, 0.3}, {1.1, 0.25, 0.35}, {0.15, 1.3, 0.3}},
    {{0.1, 0.2, 0.3}, {0.15, 1.3, 0.3}, {0.2, 0.3, 1.7}},
    {{1.1, 0.25, 0.35}, {0.2, 0.3, 1.7}, {0.15, 1.3, 0.3}},
    {{0.1, 0.2, 0.3}, {0.2, 0.3, 1.7}, {1.1, 0.25, 0.35}},
};

static void file_name(char name[80], const char *kind)
{
    (void)snprintf(name, 80, "/tmp/scree_shape_%d_%s.stl", (int)getpid(), kind);
}

static void load(const char *name, char **bytes, size_t *length)
{
    scree_error error = {0};
    if (scree_file_load(name, bytes, length, &error)) fail_msg("%s", error.message);
    (void)unlink(name);
}

static void test_binary_is_ascii(void **state)
{
    (void)state;
    char name[80], *bytes[2];
    double(*corner[2])[3];
    size_t count[2], length[2];
    scree_error error = {0};
    for (int binary = 0; binary < 2; binary++) {
        file_name(name, binary ? "binary" : "text");
        write_stl(name, tetrahedron, 4, binary);
        load(name, &bytes[binary], &length[binary]);
        assert_int_equal(scree_stl_parse(bytes[binary], length[binary], &corner[binary], &count[binary], &error), 0);
        assert_int_equal(count[binary], 4);
    }
    assert_memory_equal(corner[0], corner[1], 12 * sizeof *corner[0]);
    for (int k = 0; k < 2; k++) {
        scree_release(&corner[k]);
        scree_release(&bytes[k]);
    }
}

/// Errors say where and what was expected.
static void expect_error(const char *bytes, size_t length, const char *place, const char *expected)
{
    double(*corner)[3];
    size_t count;
    scree_error error = {0};
    assert_int_equal(scree_stl_parse(bytes, length, &corner, &count, &error), SCREE_ERROR_INPUT);
    assert_null(corner);
    if (!strstr(error.message, place) || !strstr(error.message, expected))
        fail_msg("'%s' does not say '%s' and '%s'", error.message, place, expected);
}

static void test_errors(void **state)
{
    (void)state;
    const char text[] = "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 x 0\n";
    expect_error(text, strlen(text), "line 5", "a number");
    const char word[] = "solid a\nfacet normal 0 0 1\nouter lop\n";
    expect_error(word, strlen(word), "line 3", "'loop'");
    const char end[] = "solid a\nfacet normal 0 0 1\n";
    expect_error(end, strlen(end), "line 3", "the file ends");
    const char infinite[] = "solid\nfacet normal 0 0 1 outer loop vertex 0 inf 0";
    expect_error(infinite, strlen(infinite), "line 2", "finite");
    const char none[] = "solid\nendsolid\n";
    expect_error(none, strlen(none), "no triangle", "no triangle");
    expect_error("something else", 14, "byte 14", "84 bytes");
    char header[100] = {0};
    header[80] = 3;
    expect_error(header, sizeof header, "byte 100", "234 bytes for the 3 triangles");
}

/// Cut and disturbed files are refused or read, and nothing else happens (run under the sanitizers, too).
static void test_random_bytes(void **state)
{
    (void)state;
    uint64_t draw = 0;
    for (int binary = 0; binary < 2; binary++) {
        char name[80], *bytes;
        size_t length;
        file_name(name, "fuzz");
        write_stl(name, tetrahedron, 4, binary);
        load(name, &bytes, &length);
        for (int trial = 0; trial < 3000; trial++) {
            char *copy;
            scree_error error = {0};
            size_t size = (size_t)(fixture_random(draw++) * (double)(length + 1)), count;
            if (trial % 2) size = length;
            assert_int_equal(scree_allocate(&copy, size + 1, 1, &error), SCREE_OK);
            memcpy(copy, bytes, size);
            for (int k = 0; k < trial % 5 && size > 0; k++) {
                size_t at = (size_t)(fixture_random(draw++) * (double)size) % size;
                copy[at] = (char)(256 * fixture_random(draw++));
            }
            double(*corner)[3];
            scree_mesh mesh;
            if (!scree_stl_parse(copy, size, &corner, &count, &error)) {
                assert_true(count > 0);
                for (size_t c = 0; c < 9 * count; c++) assert_true(isfinite(corner[c / 3][c % 3]));
                if (!scree_mesh_build(&mesh, count, (const double(*)[3])corner, &error)) scree_mesh_destroy(&mesh);
            } else {
                assert_true(strlen(error.message) > 10);
            }
            scree_release(&corner);
            scree_release(&copy);
        }
        scree_release(&bytes);
    }
}

static void test_topology(void **state)
{
    (void)state;
    double corner[15][3];
    scree_mesh mesh;
    scree_error error = {0};
    memcpy(corner, tetrahedron, sizeof tetrahedron);
    // A corner beside the others by less than the tolerance, and a triangle without area.
    corner[5][0] += 1e-8;
    memcpy(corner[12], corner[0], sizeof corner[0]);
    memcpy(corner[13], corner[1], sizeof corner[0]);
    for (int k = 0; k < 3; k++) corner[14][k] = 0.5 * (corner[0][k] + corner[1][k]);
    assert_int_equal(scree_mesh_build(&mesh, 5, (const double(*)[3])corner, &error), SCREE_OK);
    assert_int_equal(mesh.triangle_count, 4);
    assert_int_equal(mesh.degenerate, 1);
    assert_int_equal(mesh.edge_count, 6);
    assert_int_equal(mesh.vertex_count, 5); // the middle of the flat triangle stays, alone
    for (size_t e = 0; e < mesh.edge_count; e++) assert_int_equal(mesh.edge_begin[e + 1] - mesh.edge_begin[e], 2);
    for (size_t v = 0; v < 4; v++) assert_int_equal(mesh.vertex_begin[v + 1] - mesh.vertex_begin[v], 3);
    scree_mesh_destroy(&mesh);
}

typedef struct found_primitives {
    size_t count;
    bool has[4096];
} found_primitives;

static scree_status note(void *context, size_t primitive)
{
    found_primitives *f = context;
    assert_false(f->has[primitive]);
    f->has[primitive] = true;
    f->count++;
    return SCREE_OK;
}

/// A rough closed surface: a sphere of many triangles, each vertex moved at random.
static void make_rough(scree_mesh *mesh, int rows)
{
    static double corner[6000][3];
    size_t count = 0;
    for (int i = 0; i < rows; i++)
        for (int j = 0; j < 2 * rows; j++)
            for (int t = 0; t < 2; t++)
                for (int c = 0; c < 3; c++, count++) {
                    static const int square[2][3][2] = {{{0, 0}, {1, 0}, {1, 1}}, {{0, 0}, {1, 1}, {0, 1}}};
                    int a = i + square[t][c][0], b = (j + square[t][c][1]) % (2 * rows);
                    uint64_t key = a == 0 || a == rows ? (uint64_t)a : (uint64_t)(1000 + 100 * a + b);
                    double r = 1 + 0.2 * fixture_random(key), p = M_PI * a / rows, q = M_PI * b / rows;
                    corner[count][0] = r * sin(p) * cos(q);
                    corner[count][1] = r * sin(p) * sin(q);
                    corner[count][2] = r * cos(p);
                }
    scree_error error = {0};
    assert_int_equal(scree_mesh_build(mesh, count / 3, (const double(*)[3])corner, &error), SCREE_OK);
}

/// The tree finds what brute force finds; and the closest of the minima is the closest point of the mesh, from
/// anywhere.
static void test_search_and_minima(void **state)
{
    (void)state;
    scree_mesh mesh;
    make_rough(&mesh, 12);
    const size_t primitives = scree_mesh_primitives(&mesh);
    assert_true(primitives < 4096);
    assert_int_equal(mesh.vertex_count + mesh.triangle_count, mesh.edge_count + 2); // Euler
    for (uint64_t k = 0; k < 300; k++) {
        static found_primitives found;
        found = (found_primitives){0};
        double place[3], reach = 0.3 * fixture_random(900000 + k), closest = INFINITY, minimum = INFINITY;
        for (uint64_t i = 0; i < 3; i++) place[i] = 3 * fixture_random(800000 + 3 * k + i) - 1.5;
        assert_int_equal(scree_mesh_near(&mesh, place, reach, note, &found), SCREE_OK);
        for (size_t e = 0; e < primitives; e++) {
            double distance = scree_mesh_distance(&mesh, e, place);
            assert_int_equal(found.has[e], distance < reach);
            closest = fmin(closest, distance);
            scree_closest_point met;
            scree_mesh_closest_point(&mesh, e, place, &met);
            if (!met.minimum) continue;
            minimum = fmin(minimum, met.distance);
            assert_near(met.distance, distance, 1e-14);
            // Along the normal lies the surface.
            double foot[3];
            for (int i = 0; i < 3; i++) foot[i] = place[i] - met.distance * met.normal[i];
            assert_near(scree_mesh_distance(&mesh, e, foot), 0, 1e-13);
        }
        assert_near(minimum, closest, 1e-14);
    }
    scree_mesh_destroy(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_binary_is_ascii),   cmocka_unit_test(test_errors),
        cmocka_unit_test(test_random_bytes),      cmocka_unit_test(test_topology),
        cmocka_unit_test(test_search_and_minima),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
