// A parameter study in memory: the coefficient of restitution of two discs against their damping, without a file.
//     cc study.c $(pkg-config --cflags --libs scree) -lm && ./a.out
#include <math.h>
#include <scree/scree.h>

// Runs the case of the draft as it is now; returns the speed at which the discs part over that at which they met.
static double restitution(const scree_draft *draft, scree_error *error)
{
    scree_case *c = NULL;
    scree_simulation *s = NULL;
    scree_problems *problems = NULL;
    double velocity[2][2], before = NAN, after = NAN; // by id, x and y
    bool done = false;
    if (scree_draft_check(draft, &c, &problems)) *error = *scree_problems_get(problems, 0);
    if (!error->status) scree_simulation_create(c, 1, &s, error);
    // The first stage places the bodies, and gives them their speed; the second one ends when they have parted.
    for (int stage = 0; stage < 2 && !error->status && !scree_simulation_advance_stage(s, &done, error); stage++) {
        scree_simulation_copy(s, NULL, velocity[0], NULL);
        before = after;
        after = velocity[1][0] - velocity[0][0];
    }
    scree_simulation_free(s);
    scree_case_free(c);
    scree_problems_free(problems);
    return -after / before;
}

int main(void)
{
    scree_draft *draft = NULL;
    scree_error error = {0};
    scree_draft_builtin("restitution", &draft, &error);
    scree_draft_set_quick(draft, true);
    printf("damping_time [s]  restitution [1]\n");
    for (double time = 0.25e-3; time < 5e-3 && !error.status; time *= 2) {
        // The last value of a key counts; numbers are SI.
        if (scree_draft_set_number(draft, "contact.damping_time", time, &error)) break;
        double ratio = restitution(draft, &error);
        if (!error.status) printf("%16g  %15.4f\n", time, ratio);
    }
    if (error.status) fprintf(stderr, "%s: %s\n", error.field, error.message);
    scree_draft_free(draft);
    return error.status;
}
