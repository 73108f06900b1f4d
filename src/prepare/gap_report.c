/// The mean is one of gaps that are chosen by it: repeated from a guess until the choice stays.
#include "prepare/gap_report.h"

#include <math.h>

enum { MOST_PASSES = 100 };

/// Bonds about `mean` (a gap, positive): returns their own mean.
static double gather(const scree_gap_bodies *b, const scree_gap_net *net, double mean, double farthest,
                     scree_gap_report *report)
{
    double sum = 0, square = 0, normal[3] = {0};
    *report = (scree_gap_report){.edges = net->edge_count, .deepest = -INFINITY, .widest = -INFINITY};
    for (size_t e = 0; e < net->edge_count; e++) {
        const double gap = scree_gap_of_edge(b, &net->edge[e], normal);
        if (gap > mean + farthest) continue;
        report->bonds++;
        sum += gap - mean;
        square += (gap - mean) * (gap - mean);
        report->deepest = fmax(report->deepest, mean - gap);
        report->widest = fmax(report->widest, gap - mean);
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++) report->fabric[3 * i + j] += normal[i] * normal[j];
    }
    const double count = (double)report->bonds, off = sum / count;
    report->overlap = -mean;
    report->scatter = sqrt(square / count);
    for (int k = 0; k < 9; k++) report->fabric[k] /= count;
    return mean + off;
}

void scree_gap_report_of_net(const scree_gap_bodies *bodies, const scree_gap_net *net, double start, double tolerance,
                             scree_gap_report *report)
{
    const double farthest = SCREE_GAP_FARTHEST * tolerance;
    double mean = -start;
    size_t bonds = SIZE_MAX;
    for (int pass = 0; pass < MOST_PASSES; pass++) {
        const double next = gather(bodies, net, mean, farthest, report);
        if (report->bonds == 0 || (report->bonds == bonds && fabs(next - mean) < 1e-9 * farthest)) break;
        bonds = report->bonds;
        mean = next;
    }
    for (size_t t = 0; t < net->touch_count; t++)
        report->touches += fabs(scree_gap_of_touch(bodies, &net->touch[t])) <= farthest;
}

bool scree_gap_report_meets(const scree_gap_report *report, double tolerance)
{
    return report->bonds > 0 && report->scatter <= tolerance &&
           fmax(report->deepest, report->widest) <= SCREE_GAP_FARTHEST * tolerance;
}
