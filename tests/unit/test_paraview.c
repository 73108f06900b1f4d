/// ParaView files without VTK: every array that the head announces begins where it says and is as long as it says, and
/// the collections name the right files. tests/tools/check_paraview.py reads the same files with VTK itself.
#include "testing.h"

#include "io/paraview.h"
#include "io/vtk_data.h"
#include "io_sample.h"
#include "io_scratch.h"

#include <lz4.h>
#include <math.h>

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

/// Bytes of a component, from the name of its type: none has more than four.
static uint64_t size_of_type(const char *element)
{
    if (has_value(element, "type=\"", "UInt8\"")) return 1;
    const bool known = has_value(element, "type=\"", "UInt32\"") || has_value(element, "type=\"", "Int32\"") ||
                       has_value(element, "type=\"", "Float32\"");
    assert_true(known);
    return 4;
}

/// Where the bytes of the arrays begin.
static const char *find_raw(const char *text)
{
    const char *mark = "<AppendedData encoding=\"raw\">\n_", *found = strstr(text, mark);
    assert_non_null(found);
    return found + strlen(mark);
}

/// Unpacks an array of `length` bytes; `unpacked` has room for them. What it takes in the file.
static uint64_t unpack(const char *packed, uint64_t length, char *unpacked)
{
    uint64_t head[3], size;
    memcpy(head, packed, sizeof head);
    const uint64_t blocks = head[0];
    const char *at = packed + (3 + blocks) * sizeof size;
    assert_int_equal(blocks ? (blocks - (head[2] > 0)) * head[1] + head[2] : 0, length);
    for (uint64_t k = 0; k < blocks; k++) {
        const uint64_t left = length - k * head[1], whole = left < head[1] ? left : head[1];
        memcpy(&size, packed + (3 + k) * sizeof size, sizeof size);
        assert_int_equal(LZ4_decompress_safe(at, unpacked + k * head[1], (int)size, (int)whole), whole);
        at += size;
    }
    return (uint64_t)(at - packed);
}

/// Follows the head of a file through all its arrays. Points and cells have the numbers given.
static void check_file(const char *name, long points, long verts, long lines)
{
    size_t size;
    char *text = read_file(name, &size);
    const char *raw = find_raw(text);
    assert_int_equal(number_after(text, "NumberOfPoints=\""), points);
    assert_int_equal(number_after(text, "NumberOfVerts=\""), verts);
    assert_int_equal(number_after(text, "NumberOfLines=\""), lines);
    const char *data_of_points = strstr(text, "<PointData>"), *data_of_cells = strstr(text, "<CellData>");
    uint64_t next = 0;
    for (const char *at = strstr(text, "<DataArray"); at && at < raw; at = strstr(at + 1, "<DataArray")) {
        static char room[1 << 20];
        if (has_value(at, "format=\"", "ascii\"")) continue;
        uint64_t components = (uint64_t)number_after(at, "NumberOfComponents=\"");
        assert_int_equal(number_after(at, "offset=\""), next);
        uint64_t cells = (uint64_t)(verts + lines), rows = (uint64_t)(verts + 2 * lines);
        if (at > data_of_cells || has_value(at, "Name=\"", "offsets\""))
            rows = cells;
        else if (at > data_of_points || has_value(at, "Name=\"", "Points\""))
            rows = (uint64_t)points;
        next += unpack(raw + next, rows * components * size_of_type(at), room);
    }
    assert_string_equal(raw + next, "\n  </AppendedData>\n</VTKFile>\n");
    assert_int_equal((size_t)(raw - text) + next + strlen(raw + next), size);
    free(text);
}

/// The last point that a cell of a file joins, of `count` numbers.
static int32_t last_joined(const char *name, size_t count)
{
    size_t size;
    int32_t point[4 * BODIES];
    char *text = read_file(name, &size);
    const char *connectivity = strstr(text, "Name=\"connectivity\"");
    assert_non_null(connectivity);
    assert_true(count <= sizeof point / sizeof *point);
    (void)unpack(find_raw(text) + number_after(connectivity, "offset=\""), count * sizeof *point, (char *)point);
    free(text);
    return point[count - 1];
}

/// An array of several blocks comes back, in single precision.
static void arrays_are_packed_in_blocks(void **unused)
{
    (void)unused;
    enum { ROWS = 100001 };
    static float back[3 * ROWS];
    scree_array array = {.name = "velocity", .type = SCREE_FIELD_DOUBLE, .rows = ROWS, .components = 3};
    scree_vtk_data data = {0};
    assert_int_equal(scree_array_allocate(&array, NULL), SCREE_OK);
    double *value = array.data;
    for (size_t k = 0; k < 3 * ROWS; k++) value[k] = k % 3 == 2 ? 0 : sin(0.1 * (double)k * (double)k);
    assert_int_equal(scree_vtk_pack(&data, &array, NULL), SCREE_OK);
    assert_int_equal(unpack((const char *)data.byte, sizeof back, (char *)back), data.count);
    assert_true(100 * data.count < 85 * sizeof back);
    for (size_t k = 0; k < 3 * ROWS; k++) assert_true(back[k] == (float)value[k]);
    scree_vtk_data_destroy(&data);
    scree_array_destroy(&array);
}

/// Whole numbers stay whole: in 32 bits where all fit, else in 64.
static void whole_numbers_are_as_wide_as_they_need(void **unused)
{
    (void)unused;
    int64_t value[2] = {-7, INT32_MAX}, back[2];
    int32_t narrow[2];
    const scree_array array = {.name = "step", .type = SCREE_FIELD_INT64, .rows = 2, .components = 1, .data = value};
    scree_vtk_data data = {0};
    assert_string_equal(scree_vtk_type(&array), "Int32");
    assert_int_equal(scree_vtk_pack(&data, &array, NULL), SCREE_OK);
    (void)unpack((const char *)data.byte, sizeof narrow, (char *)narrow);
    assert_int_equal(narrow[0], -7);
    scree_vtk_data_destroy(&data);
    value[1]++;
    assert_string_equal(scree_vtk_type(&array), "Int64");
    assert_int_equal(scree_vtk_pack(&data, &array, NULL), SCREE_OK);
    (void)unpack((const char *)data.byte, sizeof back, (char *)back);
    assert_memory_equal(back, value, sizeof back);
    scree_vtk_data_destroy(&data);
}

static void every_array_lies_where_the_head_says(void **unused)
{
    (void)unused;
    write_files(0, BODIES);
    check_file("discs-000000.vtp", BODIES, BODIES, 0);
    check_file("contacts-000000.vtp", 2 * BODIES, 0, BODIES);
    check_file("boundary-000000.vtp", LOOP, 0, LOOP);
    check_file("plates-000000.vtp", 2 * 3, 0, 3);
    assert_int_equal(last_joined("discs-000000.vtp", BODIES), BODIES - 1);
    assert_int_equal(last_joined("contacts-000000.vtp", 2 * BODIES), 2 * BODIES - 1);
    // The boundary is closed.
    assert_int_equal(last_joined("boundary-000000.vtp", 2 * LOOP), 0);
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
        cmocka_unit_test(arrays_are_packed_in_blocks),
        cmocka_unit_test(whole_numbers_are_as_wide_as_they_need),
        WITH_SCRATCH(empty_scenes_are_files_too),
        WITH_SCRATCH(collections_follow_the_snapshots),
        WITH_SCRATCH(a_full_disk_keeps_the_old_files),
        WITH_SCRATCH(failed_allocations),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
