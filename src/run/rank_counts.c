/// Each process has counted by itself (comm/traffic.h, comm/parts.h); here the counts meet, as sums of integers and
/// maxima. Times are wall times: they hold the waiting for other programs, too.
#include "run/rank_counts.h"

#include "comm/comm.h"
#include "comm/parts.h"
#include "comm/ranges.h"

#include <math.h>

#define NANOSECOND 1e-9

enum { TAKEN_BODIES, TAKEN_GHOSTS, NEEDED, OFFERED, LOOKED, STEPPING, FIRST_TRAFFIC };
enum { MESSAGES, BYTES, CALLS, TIME, EACH };
enum { NUMBERS = FIRST_TRAFFIC + EACH * SCREE_TRAFFIC_PURPOSES };

static int place_of(scree_traffic_purpose purpose, int what)
{
    return FIRST_TRAFFIC + EACH * (int)purpose + what;
}

/// The own counts, as integers that can be added.
static void take_own(const scree_parts *parts, double stepping, int64_t own[NUMBERS])
{
    own[TAKEN_BODIES] = (int64_t)parts->taken_bodies;
    own[TAKEN_GHOSTS] = (int64_t)parts->taken_ghosts;
    own[NEEDED] = (int64_t)parts->needed;
    own[OFFERED] = (int64_t)parts->offered;
    own[LOOKED] = (int64_t)parts->looked;
    own[STEPPING] = (int64_t)(stepping / NANOSECOND);
    for (scree_traffic_purpose p = 0; p < SCREE_TRAFFIC_PURPOSES; p++) {
        const scree_traffic traffic = scree_traffic_of(p);
        own[place_of(p, MESSAGES)] = (int64_t)traffic.messages;
        own[place_of(p, BYTES)] = (int64_t)traffic.bytes;
        own[place_of(p, CALLS)] = (int64_t)traffic.calls;
        own[place_of(p, TIME)] = (int64_t)(traffic.seconds / NANOSECOND);
    }
}

void scree_rank_counts_join(const scree_simulation *s, double stepping, scree_rank_counts *counts)
{
    const scree_parts *parts = s->work.parts;
    int64_t sum[NUMBERS];
    double most[NUMBERS];
    *counts = (scree_rank_counts){0};
    if (!parts || parts->taken == 0) return;
    take_own(parts, stepping, sum);
    for (int k = 0; k < NUMBERS; k++) most[k] = (double)sum[k];
    scree_comm_add(NULL, sum, NUMBERS);
    scree_comm_maximum(NULL, most, NUMBERS);
    const double steps = (double)parts->taken, processes = scree_comm_size(), each = 1 / (steps * processes);
    counts->processes = scree_comm_size();
    counts->steps = steps;
    counts->ghosts[0] = (double)sum[TAKEN_GHOSTS] * each;
    counts->ghosts[1] = most[TAKEN_GHOSTS] / steps;
    counts->needed = (double)sum[NEEDED] / steps;
    counts->looked = (double)sum[LOOKED] / fmax(1, (double)sum[OFFERED]);
    for (int k = 0; k < 2; k++) {
        const scree_traffic_purpose purpose = k == 0 ? SCREE_TRAFFIC_STEPS : SCREE_TRAFFIC_LISTS;
        counts->messages[k] = (double)sum[place_of(purpose, MESSAGES)] / steps;
        counts->bytes[k] = (double)sum[place_of(purpose, BYTES)] / steps;
    }
    counts->reductions = (double)sum[place_of(SCREE_TRAFFIC_REDUCTIONS, CALLS)] * each;
    counts->reduced = (double)sum[place_of(SCREE_TRAFFIC_REDUCTIONS, BYTES)] * each;
    counts->imbalance = most[TAKEN_BODIES] * processes / fmax(1, (double)sum[TAKEN_BODIES]);
    counts->worst = parts->worst;
    counts->cuts = (double)parts->cuts;
    counts->gathers = (double)parts->gathers;
    counts->gathered = (double)sum[place_of(SCREE_TRAFFIC_GATHERS, BYTES)] / processes;
    counts->files = (double)scree_ranges_files(false);
    counts->from_parts = (double)scree_ranges_files(true);
    counts->filed = (double)sum[place_of(SCREE_TRAFFIC_FILES, BYTES)] / processes;
    counts->in_parts = (double)s->samples_in_parts;
    counts->placed = (double)sum[place_of(SCREE_TRAFFIC_PLACES, BYTES)] / processes;
    counts->stepping = NANOSECOND * (double)sum[STEPPING] / processes;
    for (scree_traffic_purpose p = 0; p < SCREE_TRAFFIC_PURPOSES; p++) {
        counts->wait[p] = NANOSECOND * (double)sum[place_of(p, TIME)] / processes;
        counts->longest[p] = NANOSECOND * most[place_of(p, TIME)];
    }
}

double scree_rank_counts_ratio(const scree_rank_counts *counts)
{
    const double all = counts->bytes[0] + counts->bytes[1] + counts->processes * counts->reduced;
    return counts->needed > 0 ? all / counts->needed : NAN;
}

static void log_files(const scree_rank_counts *counts, scree_log *log)
{
    scree_log_write(log, SCREE_LOG_INFO,
                    "%.0f snapshots and checkpoints were written by all processes together, %.0f of them from parts; "
                    "rows sent for them by a process: %.3g MB, %.3g s (at most %.3g s)",
                    counts->files, counts->from_parts, 1e-6 * counts->filed, counts->wait[SCREE_TRAFFIC_FILES],
                    counts->longest[SCREE_TRAFFIC_FILES]);
}

void scree_rank_counts_log(const scree_rank_counts *counts, scree_log *log)
{
    if (counts->processes == 0) return;
    scree_log_write(log, SCREE_LOG_INFO,
                    "%d processes, a step of all of them (mean of %.0f): %.1f messages, %.0f bytes; for lists %.1f "
                    "messages, %.0f bytes more; fields of ghosts need %.0f bytes: %.3f times as many are sent, with "
                    "lists and reductions %.3f times",
                    counts->processes, counts->steps, counts->messages[0], counts->bytes[0], counts->messages[1],
                    counts->bytes[1], counts->needed, counts->needed > 0 ? counts->bytes[0] / counts->needed : NAN,
                    scree_rank_counts_ratio(counts));
    scree_log_write(
        log, SCREE_LOG_INFO,
        "a process: %.1f bodies of others near its own (at most %.1f), %.2f reductions a step of %.0f bytes "
        "in all; the fullest part has %.3f times the mean of the bodies, the one that costs most at a list at most "
        "%.3f times the mean cost, space was cut %.0f times; %.3g MB sent for whole states (%.0f of them), %.3g MB for "
        "boundaries of the sample that were found anew; at a list a body was held against %.2f parts",
        counts->ghosts[0], counts->ghosts[1], counts->reductions, counts->reduced, counts->imbalance, counts->worst,
        counts->cuts, 1e-6 * counts->gathered, counts->gathers, 1e-6 * counts->placed, counts->looked);
    double rest = counts->stepping;
    for (int p = 0; p < SCREE_TRAFFIC_PURPOSES; p++) rest -= counts->wait[p];
    scree_log_write(
        log, SCREE_LOG_INFO,
        "time of a process, mean (most): reductions %.3g s (%.3g), messages of steps %.3g s (%.3g), lists "
        "%.3g s (%.3g), whole states %.3g s (%.3g), samples in parts %.3g s (%.3g), boundaries %.3g s (%.3g); "
        "all else %.3g of %.3g s",
        counts->wait[SCREE_TRAFFIC_REDUCTIONS], counts->longest[SCREE_TRAFFIC_REDUCTIONS],
        counts->wait[SCREE_TRAFFIC_STEPS], counts->longest[SCREE_TRAFFIC_STEPS], counts->wait[SCREE_TRAFFIC_LISTS],
        counts->longest[SCREE_TRAFFIC_LISTS], counts->wait[SCREE_TRAFFIC_GATHERS],
        counts->longest[SCREE_TRAFFIC_GATHERS], counts->wait[SCREE_TRAFFIC_SAMPLES],
        counts->longest[SCREE_TRAFFIC_SAMPLES], counts->wait[SCREE_TRAFFIC_PLACES],
        counts->longest[SCREE_TRAFFIC_PLACES], rest, counts->stepping);
    log_files(counts, log);
}

void scree_rank_counts_results(const scree_rank_counts *counts, scree_summary *summary)
{
    if (counts->processes == 0) return;
    double wait = 0;
    for (int p = 0; p < SCREE_TRAFFIC_PURPOSES; p++) wait += counts->wait[p];
    scree_summary_set_integer(summary, "processes", counts->processes);
    scree_summary_set_number(summary, "processes_ghosts", counts->ghosts[0]);
    scree_summary_set_number(summary, "processes_imbalance", counts->imbalance);
    scree_summary_set_number(summary, "processes_messages", counts->messages[0] + counts->messages[1]);
    scree_summary_set_number(summary, "processes_bytes", counts->bytes[0] + counts->bytes[1]);
    scree_summary_set_number(summary, "processes_bytes_ratio", scree_rank_counts_ratio(counts));
    scree_summary_set_number(summary, "processes_reductions", counts->reductions);
    scree_summary_set_number(summary, "processes_waiting", wait / counts->stepping);
    scree_summary_set_integer(summary, "processes_files", (int64_t)counts->files);
    scree_summary_set_integer(summary, "processes_files_from_parts", (int64_t)counts->from_parts);
    scree_summary_set_integer(summary, "processes_gathers", (int64_t)counts->gathers);
    scree_summary_set_integer(summary, "processes_samples_in_parts", (int64_t)counts->in_parts);
}
