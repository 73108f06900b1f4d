/// compare_states ONE OTHER: whether two run folders hold the same snapshots and checkpoints, and each state in them
/// the same values, bit for bit: bodies by their ids, contacts and pairs by both of theirs, in which order they may lie
/// in the files. Prints how many states are the same; each difference is a line, and status 1.
#include "case/case.h"
#include "io/array.h"
#include "io/snapshot.h"
#include "run/restart.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

static int failures;

static void fail(const char *what, const char *name, const scree_restart_point *point)
{
    printf("%s %" PRId64 ": %s %s\n", point->snapshot ? "snapshot" : "checkpoint", point->index, what, name);
    failures++;
}

static bool read_case(const char *directory, int *dimension, uint64_t *checksum, scree_error *error)
{
    scree_case *c = NULL;
    scree_status status = scree_restart_case(directory, &c, error);
    if (!status) status = scree_case_checksum(c, checksum, error);
    if (!status) *dimension = (int)c->config.dimension;
    scree_case_free(c);
    return status == SCREE_OK;
}

static void compare_fields(const scree_state *one, const scree_state *other, const scree_restart_point *point)
{
    for (size_t k = 0; k < scree_field_total(); k++) {
        const scree_field *field = scree_field_at(k);
        scree_array a, b;
        if (!scree_field_is_stored(one, field)) continue;
        if (scree_array_from_field(one, field, true, &a, NULL) || scree_array_from_field(other, field, true, &b, NULL))
            fail("no memory for", field->name, point);
        else if (a.rows != b.rows)
            fail("another length of", field->name, point);
        else if (a.rows > 0 && memcmp(a.data, b.data, a.rows * scree_array_row_size(&a)) != 0)
            fail("other values of", field->name, point);
        scree_array_destroy(&a);
        scree_array_destroy(&b);
    }
}

static void compare(char **folder, const scree_restart_point *point, const scree_restart_wanted *wanted)
{
    scree_state state[2];
    scree_error error;
    bool another;
    for (int k = 0; k < 2; k++)
        if (scree_restart_point_read(folder[k], point, wanted, &state[k], &another, &error))
            fail("cannot be read:", error.message, point);
    if (failures == 0) compare_fields(&state[0], &state[1], point);
    for (int k = 0; k < 2; k++) scree_state_destroy(&state[k]);
}

int main(int argc, char **argv)
{
    scree_restart_points points[2] = {{0}, {0}};
    scree_restart_wanted wanted = {0};
    scree_error error = {0};
    if (argc != 3 || !read_case(argv[1], &wanted.dimension, &wanted.case_checksum, &error) ||
        scree_restart_points_list(argv[1], &points[0], &error) ||
        scree_restart_points_list(argv[2], &points[1], &error)) {
        printf("compare_states ONE OTHER: %s\n", error.message);
        return 1;
    }
    const size_t count = points[0].count;
    if (count != points[1].count) fail("another number of", "points", &points[0].point[0]);
    for (size_t k = 0; k < count && failures == 0; k++) {
        const scree_restart_point *one = &points[0].point[k], *other = &points[1].point[k];
        if (one->snapshot != other->snapshot || one->index != other->index || one->part != other->part)
            fail("is not among those of", argv[2], one);
        else
            compare(argv + 1, one, &wanted);
    }
    if (failures == 0) printf("%zu states are the same\n", count);
    for (int k = 0; k < 2; k++) scree_restart_points_destroy(&points[k]);
    return failures > 0;
}
