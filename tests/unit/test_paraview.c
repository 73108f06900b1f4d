/// ParaView files without VTK: every array that the head announces begins where it says and is as long as it says, and
/// the collections name the right files. tests/tools/check_paraview.py reads the same files with VTK itself.
#include "testing.h"

#include "io/paraview.h"
#include "io_sample.h"
#include "io_scratch.h"

enum { BODIES = 24, LOOP = 10 };

static scree_status try_write(int64_t index, size_t bodies, scree_error *error)
{
    const scree_config config = {0};
    const scree_model model = sample_model(&config);
    scree_state state;
    scree_contact_table table = {0};
    scree_status status = sample_state(&state, bodies, 1, error);
    if (!status && bodies >= LOOP) status = sample_loop(&state, LOOP, error);
    if (!status && bodies > 0) status = sample_table(&state, &table, error);
    const scree_snapshot_info info = {.index = index, .time = 0.5 * (double)index, .stage = "compress"};
    if (!status) status = scree_paraview_write(scratch, &model, &state, &table, &info, error);
    scree_release(&table.contact);
    scree_state_destroy(&state);
    return status;
}

static void write_files(int64_t index, size_t bodies)
{
    scree_error error;
    if (try_write(index, bodies, &error)) fail_msg("%s", error.message);
}

/// A whole file, with a NUL behind it; the caller frees it.
static char *read_file(const char *name, size_t *size)
{
    char path[256];
    (void)snprintf(path, sizeof path, "%s/paraview/%s", scratch, name);
    FILE *file = fopen(path, "rb");
    if (!file) fail_msg("'%s' is not there", path);
    *size = (size_t)file_size(path);
    char *text = malloc(*size + 1);
    assert_non_null(text);
    assert_int_equal(fread(text, 1, *size, file), *size);
    text[*size] = 0;
    (void)fclose(file);
    return text;
}

static long number_after(const char *text, const char *key)
{
    const char *found = strstr(text, key);
    if (!found) fail_msg("'%s' is missing", key);
    return strtol(found + strlen(key), NULL, 10);
}

/// The first `key` of an element is followed by `value`.
static bool has_value(const char *element, const char *key, const char *value)
{
    const char *found = strstr(element, key);
    return found && strncmp(found + strlen(key), value, strlen(value)) == 0;
}

/// Bytes of a component, from the name of its type.
static uint64_t size_of_type(const char *element)
{
    if (has_value(element, "type=\"", "UInt8\"")) return 1;
    return has_value(element, "type=\"", "UInt32\"") || has_value(element, "type=\"", "Int32\"") ? 4 : 8;
}

/// Follows the head of a file through all its arrays. Points and cells have the numbers given.
static void check_file(const char *name, long points, long verts, long lines)
{
    size_t size;
    char *text = read_file(name, &size);
    char *raw = strstr(text, "<AppendedData encoding=\"raw\">\n_");
    assert_non_null(raw);
    raw += strlen("<AppendedData encoding=\"raw\">\n_");
    assert_int_equal(number_after(text, "NumberOfPoints=\""), points);
    assert_int_equal(number_after(text, "NumberOfVerts=\""), verts);
    assert_int_equal(number_after(text, "NumberOfLines=\""), lines);
    const char *data_of_points = strstr(text, "<PointData>"), *data_of_cells = strstr(text, "<CellData>");
    uint64_t next = 0;
    for (const char *at = strstr(text, "<DataArray"); at && at < raw; at = strstr(at + 1, "<DataArray")) {
        if (has_value(at, "format=\"", "ascii\"")) continue;
        uint64_t components = (uint64_t)number_after(at, "NumberOfComponents=\"");
        uint64_t offset = (uint64_t)number_after(at, "offset=\""), length;
        assert_int_equal(offset, next);
        memcpy(&length, raw + offset, sizeof length);
        uint64_t cells = (uint64_t)(verts + lines), rows = (uint64_t)(verts + 2 * lines);
        if (at > data_of_cells || has_value(at, "Name=\"", "offsets\""))
            rows = cells;
        else if (at > data_of_points || has_value(at, "Name=\"", "Points\""))
            rows = (uint64_t)points;
        assert_int_equal(length, rows * components * size_of_type(at));
        next = offset + sizeof length + length;
    }
    assert_string_equal(raw + next, "\n  </AppendedData>\n</VTKFile>\n");
    assert_int_equal((size_t)(raw - text) + next + strlen(raw + next), size);
    free(text);
}

/// The last point that a cell of a file joins.
static int64_t last_joined(const char *name)
{
    size_t size;
    int64_t point;
    uint64_t length;
    char *text = read_file(name, &size);
    const char *raw = strstr(text, "<AppendedData encoding=\"raw\">\n_") + strlen("<AppendedData encoding=\"raw\">\n_");
    const char *connectivity = strstr(text, "Name=\"connectivity\"");
    assert_non_null(connectivity);
    const char *block = raw + number_after(connectivity, "offset=\"");
    memcpy(&length, block, sizeof length);
    memcpy(&point, block + length, sizeof point);
    free(text);
    return point;
}

static void every_array_lies_where_the_head_says(void **unused)
{
    (void)unused;
    write_files(0, BODIES);
    check_file("discs-000000.vtp", BODIES, BODIES, 0);
    check_file("contacts-000000.vtp", 2 * BODIES, 0, BODIES);
    check_file("boundary-000000.vtp", LOOP, 0, LOOP);
    check_file("plates-000000.vtp", 2 * 3, 0, 3);
    assert_int_equal(last_joined("discs-000000.vtp"), BODIES - 1);
    assert_int_equal(last_joined("contacts-000000.vtp"), 2 * BODIES - 1);
    // The boundary is closed.
    assert_int_equal(last_joined("boundary-000000.vtp"), 0);
}

static void empty_scenes_are_files_too(void **unused)
{
    (void)unused;
    write_files(0, 0);
    check_file("discs-000000.vtp", 0, 0, 0);
    check_file("contacts-000000.vtp", 0, 0, 0);
    check_file("boundary-000000.vtp", 0, 0, 0);
}

static void assert_collection(const char *expected)
{
    size_t size;
    char *text = read_file("discs.pvd", &size);
    const char *begin = strstr(text, "<Collection>\n"), *end = strstr(text, "  </Collection>");
    assert_non_null(begin);
    assert_non_null(end);
    begin += strlen("<Collection>\n");
    assert_int_equal((size_t)(end - begin), strlen(expected));
    assert_memory_equal(begin, expected, strlen(expected));
    free(text);
}

static void collections_follow_the_snapshots(void **unused)
{
    (void)unused;
#define ENTRY(time, number) "    <DataSet timestep=\"" time "\" part=\"0\" file=\"discs-" number ".vtp\"/>\n"
    for (int64_t k = 0; k < 3; k++) write_files(k, BODIES);
    assert_collection(ENTRY("0", "000000") ENTRY("0.5", "000001") ENTRY("1", "000002"));
    // A restart from before snapshot 1 writes it again.
    write_files(1, BODIES);
    assert_collection(ENTRY("0", "000000") ENTRY("0.5", "000001"));
}

static void a_full_disk_keeps_the_old_files(void **unused)
{
    (void)unused;
    scree_error error;
    write_files(0, BODIES);
    assert_true(disk_limit(1000));
    assert_int_equal(try_write(0, BODIES, &error), SCREE_ERROR_IO);
    assert_true(disk_limit(RLIM_INFINITY));
    assert_non_null(strstr(error.message, "discs-000000.vtp': File too large"));
    check_file("discs-000000.vtp", BODIES, BODIES, 0);
}

static void failed_allocations(void **unused)
{
    (void)unused;
    uint64_t n = 1;
    for (bool reached = true; reached; n++) {
        size_t before, after;
        scree_error error = {0};
        scree_allocation_statistics(&before, NULL);
        (void)scree_allocation_fail_after(n);
        scree_status status = try_write(0, BODIES, &error);
        reached = scree_allocation_fail_after(0) >= n;
        scree_allocation_statistics(&after, NULL);
        assert_int_equal(before, after);
        assert_int_equal(status, reached ? SCREE_ERROR_IO : SCREE_OK);
        if (reached) assert_non_null(strstr(error.message, "out of memory"));
    }
    assert_true(n > 50);
}

#define WITH_SCRATCH(test) cmocka_unit_test_setup_teardown(test, make_scratch, remove_scratch)
int main(void)
{
    const struct CMUnitTest tests[] = {
        WITH_SCRATCH(every_array_lies_where_the_head_says),
        WITH_SCRATCH(empty_scenes_are_files_too),
        WITH_SCRATCH(collections_follow_the_snapshots),
        WITH_SCRATCH(a_full_disk_keeps_the_old_files),
        WITH_SCRATCH(failed_allocations),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
