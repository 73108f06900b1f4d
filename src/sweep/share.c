/// Members of a sweep that begin with one sample: the first of them runs it, the others go on behind the stage that
/// they share (scree run --after), with the bits that they would have by themselves.
#include "sweep/share.h"

#include "base/memory.h"
#include "case/case.h"

#include <string.h>

/// A case that others may share stages with.
typedef struct first_case {
    size_t member;
    scree_case *c;
} first_case;

/// Number of the stage with that name; -1: there is none.
static int64_t stage_of(const scree_case *c, const char *name)
{
    for (int64_t k = 0; k < c->config.stage_count; k++)
        if (strcmp(c->config.stages[k].name, name) == 0) return k;
    return -1;
}

/// The first of `count` cases that shares the stage with `c`; `count`: none does.
static size_t find_first(const first_case *first, size_t count, const scree_case *c, const char *name)
{
    char where[SCREE_CASE_PATH];
    size_t k = 0;
    const int64_t stage = stage_of(c, name);
    while (k < count && scree_case_common_stages(c, first[k].c, where) <= stage) k++;
    return k;
}

scree_status scree_share_find(const scree_sweep *sweep, size_t *leader, scree_error *error)
{
    first_case *first = NULL;
    size_t count = 0;
    scree_status status = SCREE_OK;
    for (size_t i = 0; i < sweep->member_count; i++) leader[i] = i;
    if (!sweep->config.share[0]) return SCREE_OK;
    status = scree_allocate(&first, sweep->member_count, sizeof *first, error);
    for (size_t i = 0; i < sweep->member_count && !status; i++) {
        scree_case *c;
        if ((status = scree_member_resolve(sweep, i, &c, error))) break;
        const size_t found = find_first(first, count, c, sweep->config.share);
        if (found == count)
            first[count++] = (first_case){i, c};
        else
            scree_case_free(c);
        leader[i] = first[found].member;
    }
    for (size_t k = 0; k < count; k++) scree_case_free(first[k].c);
    scree_release(&first);
    return status;
}

void scree_share_check(scree_reader *reader, const scree_sweep *sweep)
{
    const char *name = sweep->config.share;
    const scree_node *node = scree_node_find(reader->root, "share");
    for (size_t point = 0; point < sweep->point_count && name[0] && node; point++) {
        scree_case *c;
        if (scree_member_case(sweep, point, &c, NULL)) return;
        const int64_t stage = stage_of(c, name), last = c->config.stage_count - 1;
        const char *before = last > 0 ? c->config.stages[last - 1].name : NULL;
        if (stage < 0)
            scree_problem_add(reader, node->place, "share", name, before, "the case has no stage '%s'", name);
        else if (stage == last)
            scree_problem_add(reader, node->place, "share", name, before,
                              "no stage comes behind '%s', so that nothing would be left to run", name);
        scree_case_free(c);
        if (stage < 0 || stage == last) return;
    }
}
