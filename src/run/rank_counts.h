/// What a run on several processes has sent, and where its processes have waited: counts of all of them, joined when
/// the run ends, for log.txt and summary.json. All are of the steps since this start of the program.
#ifndef SCREE_RUN_RANK_COUNTS_H
#define SCREE_RUN_RANK_COUNTS_H

#include "base/log.h"
#include "comm/traffic.h"
#include "io/summary.h"
#include "run/simulation_data.h"

typedef struct scree_rank_counts {
    int processes; ///< 0: there was one, or no step
    double steps;
    double ghosts[2];         ///< of a process in a step: mean, of the process with most
    double looked;            ///< parts that a body and its images were held against when a list was made, mean
    double messages[2];       ///< in a step, of all processes: those of steps; those of lists, spread over the steps
    double bytes[2];          ///< of these
    double needed;            ///< bytes that the declared fields of the ghosts need in a step, of all processes
    double reductions;        ///< of a process in a step
    double reduced;           ///< bytes of their numbers
    double imbalance;         ///< bodies of the fullest part over their mean, in the mean of the steps
    double worst;             ///< cost of the part that costs most over the mean when a list was made, the largest
    double cuts;              ///< of space
    double gathers, gathered; ///< bytes that a process has sent for whole states: mean
    double files, from_parts; ///< snapshots and checkpoints that all have written; those of them from parts
    double filed;             ///< bytes that a process has sent for them: mean
    double in_parts;          ///< samples for which there was no whole state
    double placed;            ///< bytes of places of its grains, when boundaries were found anew: mean
    double wait[SCREE_TRAFFIC_PURPOSES];    ///< s in calls for each purpose, mean of the processes
    double longest[SCREE_TRAFFIC_PURPOSES]; ///< s, of the process with most
    double stepping;                        ///< s, wall time, mean
} scree_rank_counts;

/// Joins the counts of all processes. All of them call it; `stepping`: s of the own steps and of what is beside them.
void scree_rank_counts_join(const scree_simulation *s, double stepping, scree_rank_counts *counts);

/// All bytes of steps, lists and reductions over those that are needed; NAN: none are.
double scree_rank_counts_ratio(const scree_rank_counts *counts);

void scree_rank_counts_log(const scree_rank_counts *counts, scree_log *log);
void scree_rank_counts_results(const scree_rank_counts *counts, scree_summary *summary);

#endif
