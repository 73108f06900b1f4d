// A measure of our own over the contacts of a sample: in which directions they lie, and which of them carry the load.
//     cc own_measure.c $(pkg-config --cflags --libs scree) -lm && ./a.out
#include <math.h>
#include <scree/scree.h>

// Anisotropy a and direction of the contacts' normals, whose density goes like 1 + a cos 2 (angle - direction); and the
// share of the contacts whose force is above the mean.
static void measure(const scree_contact_point *contact, size_t count)
{
    double cosine = 0, sine = 0, mean = 0;
    size_t strong = 0;
    for (size_t k = 0; k < count; k++) mean += contact[k].normal_force / (double)count;
    for (size_t k = 0; k < count; k++) {
        double angle = atan2(contact[k].normal[1], contact[k].normal[0]);
        cosine += 2 * cos(2 * angle) / (double)count;
        sine += 2 * sin(2 * angle) / (double)count;
        strong += contact[k].normal_force > mean;
    }
    printf("%zu contacts, anisotropy %.2f towards %.0f degrees, %.0f %% strong\n", count, hypot(cosine, sine),
           fmod(180 + 90 * atan2(sine, cosine) / acos(-1), 180), 100.0 * (double)strong / (double)count);
}

int main(void)
{
    scree_draft *draft = NULL;
    scree_case *c = NULL;
    scree_simulation *s = NULL;
    scree_problems *problems = NULL;
    scree_error error = {0};
    bool done = false;
    // A built-in case in its quick form, with keys of our own; everything is checked together.
    scree_draft_builtin("biaxial", &draft, &error);
    scree_draft_set_quick(draft, true);
    if (!error.status) scree_draft_set(draft, "particles.count", "150", &error);
    if (!error.status && scree_draft_check(draft, &c, &problems)) error = *scree_problems_get(problems, 0);
    if (!error.status) scree_simulation_create(c, 0, &s, &error);
    // From the end of one stage to that of the next: prepare, confine, compress.
    while (!error.status && !done && !scree_simulation_advance_stage(s, &done, &error)) {
        const scree_contact_point *contact;
        const char *stage;
        size_t count;
        scree_simulation_stage(s, &stage);
        if (scree_simulation_contacts(s, &contact, &count, &error)) break;
        printf("%-8s ", stage);
        measure(contact, count);
    }
    if (error.status) fprintf(stderr, "%s: %s\n", error.field, error.message);
    scree_simulation_free(s);
    scree_case_free(c);
    scree_problems_free(problems);
    scree_draft_free(draft);
    return error.status;
}
