/// Writes a small run directory with known content: two snapshots, a checkpoint, ParaView files; finished when asked.
/// Usage: write_sample_run DIRECTORY [finish]. tests/tools/check_paraview.py says what it must find there.
#include "io/paraview.h"
#include "io/run_file.h"
#include "io/snapshot.h"
#include "io_sample.h"

#include <stdio.h>
#include <sys/stat.h>

static scree_status write_one(const char *directory, int64_t index, scree_error *error)
{
    char name[] = "sample";
    const scree_config config = {.name = name};
    const scree_model model = sample_model(&config);
    scree_state state;
    scree_contact_table table = {0};
    scree_status status = sample_state(&state, 24, (uint64_t)index, error);
    if (!status) status = sample_loop(&state, 10, error);
    if (!status) status = sample_contacts(&state, 20, error);
    if (!status) status = sample_table(&state, &table, error);
    const scree_snapshot_info info = {
        .index = index, .time = 0.5 * (double)index, .axial_strain = 0.25, .stage = "compress"};
    if (!status) status = scree_snapshot_write(directory, &model, &state, &table, &info, error);
    if (!status) status = scree_paraview_write(directory, &model, &state, &table, &info, error);
    if (!status) status = scree_checkpoint_write(directory, &state, 1, error);
    scree_release(&table.contact);
    scree_state_destroy(&state);
    return status;
}

int main(int count, char **arguments)
{
    scree_error error = {0};
    if (count < 2) return SCREE_ERROR_INPUT;
    (void)mkdir(arguments[1], 0777);
    scree_status status = write_one(arguments[1], 0, &error);
    if (!status) status = write_one(arguments[1], 1, &error);
    if (!status && count > 2) status = scree_run_file_finish(arguments[1], NULL, &error);
    if (status) fprintf(stderr, "%s\n", error.message);
    return (int)status;
}
