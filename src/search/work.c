/// Life of `work`.
///
/// The skin. Let a step move the fastest body by u mean radii. A list with a skin of s mean radii lasts s / (2 u)
/// steps, so rebuilds cost 2 u r / s a body and step, r being the cost of a rebuild a body; the skin makes the list
/// longer by n s pairs a body, each tested in every step at a cost of t. The sum is least at s = sqrt(2 u r / (n t)).
/// In a dense packing of discs (bench/bench_neighbours: 2.09, 2.18, 2.25, 2.31, 2.42 pairs a disc for s = 0.05, 0.1,
/// 0.15, 0.2, 0.3, of which 1.96 touch) n = 1.3; with r = 95 ns and t = 2.5 ns, s = 0.24 for u = 1e-3, a rapid flow,
/// and 0.08 for u = 1e-4, as in a slow one. At 0.15 either costs below 0.5 ns a body and step more than at its best.
#include "comm/parts.h"
#include "search/neighbours.h"
#include "search/search.h"
#include "shape/wall_set.h"

#include <string.h>

/// Mean radii.
static const double default_skin = 0.15;

scree_status scree_work_create(scree_work *work, const scree_model *model, int threads, scree_error *error)
{
    memset(work, 0, sizeof *work);
    work->threads = threads > 1 ? threads : 1;
    if (work->threads > SCREE_THREAD_POOL_MOST) work->threads = SCREE_THREAD_POOL_MOST;
    work->skin = default_skin * model->mean_radius;
    work->virial_bound = work->motion_quantum = 1; // of no cell, but the same in all processes
    scree_status status = scree_allocate(&work->search, 1, sizeof *work->search, error);
    if (!status)
        status = scree_allocate(&work->search->chunk, (size_t)work->threads, sizeof *work->search->chunk, error);
    if (status)
        scree_work_destroy(work);
    else
        work->search->chunks = work->threads;
    return status;
}

void scree_neighbours_release(scree_work *work)
{
    scree_search *search = work->search;
    scree_pairs_clear(&work->pairs);
    work->wall_pairs.count = work->primitive_pairs.count = 0;
    scree_pair_lists_destroy(work);
    for (int c = 0; c < search->chunks; c++) scree_pair_chunk_destroy(&search->chunk[c]);
    scree_pair_chunk_destroy(&search->ghosts);
    scree_release(&search->held.pair);
    search->held = (scree_held_buffer){0};
    scree_cell_grid_destroy(&search->grid);
    scree_release(&search->entry_begin);
    scree_release(&search->entry);
    scree_release(&search->part);
    search->entry_begin_capacity = search->entry_capacity = search->part_capacity = 0;
    scree_release(&work->ghosts.ghost);
    work->ghosts = (scree_ghost_list){0};
    scree_release(&work->relative);
    work->relative_capacity = 0;
    search->listed = work->valid = false;
}

void scree_work_destroy(scree_work *work)
{
    scree_thread_pool_destroy(&work->pool);
    scree_search *search = work->search;
    if (search) {
        for (int c = 0; c < search->chunks; c++) scree_pair_chunk_destroy(&search->chunk[c]);
        scree_release(&search->chunk);
        scree_pair_chunk_destroy(&search->ghosts);
        scree_release(&search->held.pair);
        scree_cell_grid_destroy(&search->grid);
        scree_release(&search->entry_begin);
        scree_release(&search->entry);
        scree_release(&search->part);
    }
    scree_release(&work->search);
    scree_release(&work->ghosts.ghost);
    scree_parts_destroy(work);
    scree_release(&work->relative);
    scree_pair_lists_destroy(work);
    scree_wall_set_destroy(&work->wall_set);
    memset(work, 0, sizeof *work);
}
