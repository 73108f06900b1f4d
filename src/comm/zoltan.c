/// Parts of space by recursive coordinate bisection (Berger and Bokhari 1987), made by Zoltan, which keeps the cuts and
/// finds the part of any place by them. Weights: comm/balance.h.
#include "comm/comm.h"
#include "comm/mpi_own.h"
#include "comm/traffic.h"

#include <zoltan.h>

typedef struct places {
    const scree_vector *place;
    const float *weight; ///< NULL: alike
    size_t count;
    int dimension;
} places;

static struct Zoltan_Struct *cuts;

static int count_places(void *data, int *code)
{
    *code = ZOLTAN_OK;
    return (int)((const places *)data)->count;
}

static void list_places(void *data, int globals, int locals, ZOLTAN_ID_PTR global, ZOLTAN_ID_PTR local, int weights,
                        float *weight, int *code)
{
    const places *all = data;
    (void)globals, (void)locals, (void)weights;
    for (size_t k = 0; k < all->count; k++) {
        global[k] = local[k] = (ZOLTAN_ID_TYPE)k;
        weight[k] = all->weight ? all->weight[k] : 1;
    }
    *code = ZOLTAN_OK;
}

static int count_coordinates(void *data, int *code)
{
    *code = ZOLTAN_OK;
    return ((const places *)data)->dimension;
}

static void tell_place(void *data, int globals, int locals, ZOLTAN_ID_PTR global, ZOLTAN_ID_PTR local, double *place,
                       int *code)
{
    const places *all = data;
    (void)globals, (void)locals, (void)global;
    for (int k = 0; k < all->dimension; k++) place[k] = all->place[*local][k];
    *code = ZOLTAN_OK;
}

static bool open_cuts(void)
{
    static const char *const parameters[][2] = {{"DEBUG_LEVEL", "0"},
                                                {"LB_METHOD", "RCB"},
                                                {"KEEP_CUTS", "1"},
                                                {"RETURN_LISTS", "NONE"},
                                                {"OBJ_WEIGHT_DIM", "1"}};
    float version;
    if (cuts) return true;
    if (Zoltan_Initialize(0, NULL, &version) != ZOLTAN_OK || !(cuts = Zoltan_Create(scree_comm_world()))) return false;
    for (size_t k = 0; k < sizeof parameters / sizeof *parameters; k++)
        (void)Zoltan_Set_Param(cuts, parameters[k][0], parameters[k][1]);
    return true;
}

void scree_comm_forget_cuts(void)
{
    if (cuts) Zoltan_Destroy(&cuts);
}

scree_status scree_comm_cut(const scree_vector *place, const float *weight, size_t count, int dimension,
                            scree_error *error)
{
    places all = {place, weight, count, dimension};
    int changes, globals, locals, imports, exports, *import_process, *import_part, *export_process, *export_part;
    ZOLTAN_ID_PTR import_global, import_local, export_global, export_local;
    const double began = MPI_Wtime();
    bool made = open_cuts();
    if (made) {
        (void)Zoltan_Set_Num_Obj_Fn(cuts, count_places, &all);
        (void)Zoltan_Set_Obj_List_Fn(cuts, list_places, &all);
        (void)Zoltan_Set_Num_Geom_Fn(cuts, count_coordinates, &all);
        (void)Zoltan_Set_Geom_Fn(cuts, tell_place, &all);
        made = Zoltan_LB_Partition(cuts, &changes, &globals, &locals, &imports, &import_global, &import_local,
                                   &import_process, &import_part, &exports, &export_global, &export_local,
                                   &export_process, &export_part) == ZOLTAN_OK;
    }
    scree_traffic_count(0, 0, MPI_Wtime() - began);
    return made ? SCREE_OK : scree_error_set(error, SCREE_ERROR_IO, "Zoltan cannot cut space into parts");
}

int scree_comm_part_of(const scree_vector place)
{
    double point[3] = {place[0], place[1], place[2]};
    int process = 0;
    for (int k = 0; k < 3; k++)
        if (!(point[k] == point[k])) return 0;
    (void)Zoltan_LB_Point_Assign(cuts, point, &process);
    return process;
}
