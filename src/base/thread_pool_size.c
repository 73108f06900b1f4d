/// One decision at the end of a window.
#include "base/thread_pool_size.h"

#include "base/clock.h"

#include <math.h>

enum { LEAST_STEPS = 8, COMPARED_WINDOWS = 2 };
static const double window_seconds = 0.03, least_rest = 0.5, most_rest = 5, lost_share = 0.1;

static void start(scree_thread_pool_size *size, int most)
{
    *size = (scree_thread_pool_size){
        .most = most, .now = most, .kept = most, .rest_more = least_rest, .rest_less = least_rest};
}

/// After the last window of a comparison: the faster number stays.
static void decide(scree_thread_pool_size *size, double now)
{
    bool more = size->tried > size->kept, pays = size->gain > 0;
    double *rest = more ? &size->rest_more : &size->rest_less;
    *rest = pays ? least_rest : fmin(2 * *rest, most_rest);
    if (pays) size->kept = size->tried;
    size->now = size->kept;
    size->tried = 0;
    // What has just paid is tried again at once; the way back is not.
    size->until_more = more && pays ? now : now + size->rest_more;
    size->until_less = !more && pays ? now : now + size->rest_less;
}

/// After a window of a comparison.
static void compare(scree_thread_pool_size *size, double rate, double now)
{
    bool trying = size->now == size->tried;
    size->gain += trying ? rate : -rate;
    size->windows += trying;
    size->now = trying ? size->kept : size->tried;
    if (size->windows == COMPARED_WINDOWS) decide(size, now);
}

/// After a window with the number that is kept: maybe another one is tried, and this was the first window of that.
static void consider(scree_thread_pool_size *size, double rate, double lost, double now)
{
    if (size->now > 1 && lost > lost_share && now >= size->until_less)
        size->tried = size->now - 1;
    else if (size->now < size->most && now >= size->until_more)
        size->tried = size->now + 1;
    if (!size->tried) return;
    size->gain = -rate;
    size->windows = 0;
    size->now = size->tried;
}

int scree_thread_pool_size_choose(scree_thread_pool_size *size, int most, double now, double (*lost)(const void *user),
                                  const void *user)
{
    if (size->now == 0 || size->most != most) start(size, most);
    if (most <= 1) return 1;
    double passed = now - size->begin;
    if (size->begin > 0 && (++size->steps < LEAST_STEPS || passed < window_seconds)) return size->now;
    double whole = lost(user);
    if (size->begin > 0) {
        double rate = (double)size->steps / passed;
        if (size->tried)
            compare(size, rate, now);
        else
            consider(size, rate, (whole - size->lost) / passed, now);
    }
    size->begin = now;
    size->lost = whole;
    size->steps = 0;
    return size->now;
}

/// s, in which the caller waited for others or had no processor. Waits in which it slept count twice, which does no
/// harm: a decision compares rates, this only asks for one.
static double lost_time(const void *user)
{
    const scree_thread_pool *pool = user;
    double away = scree_clock() - scree_clock_read(CLOCK_THREAD_CPUTIME_ID);
    return away + scree_thread_pool_stalled(pool);
}

int scree_thread_pool_size_follow(scree_thread_pool_size *size, const scree_thread_pool *pool, int most)
{
    return scree_thread_pool_size_choose(size, most, most > 1 ? scree_clock() : 0, lost_time, pool);
}
