/// With b = sqrt(a): d = b^4 / R - B b, a polynomial that grows from the break at b^3 = B R / 4 on, so bisection finds
/// every root; this is independent of how contact/adhesive.h finds it.
#include "theory/adhesion.h"

#include <math.h>
#include <stdint.h>

double scree_adhesion_root(double stiffness, double work)
{
    return sqrt(8 * M_PI * work / (3 * stiffness));
}

double scree_adhesion_work(double stiffness, double root)
{
    return 3 * stiffness * root * root / (8 * M_PI);
}

double scree_adhesion_tabor(const scree_adhesion *of)
{
    const double range = 3e-10, ratio = scree_adhesion_work(of->stiffness, of->root) / (0.75 * of->stiffness);
    return cbrt(of->radius * ratio * ratio) / range;
}

double scree_adhesion_pull_off(const scree_adhesion *of)
{
    return (of->jkr ? 9.0 / 16 : 3.0 / 4) * of->root * of->root * of->stiffness * of->radius;
}

/// a where the contact ends.
static double last_area(const scree_adhesion *of)
{
    double root = cbrt(0.25 * of->root * of->radius);
    return of->jkr ? root * root : 0;
}

double scree_adhesion_neck(const scree_adhesion *of)
{
    return of->jkr ? 0.75 * of->root * sqrt(last_area(of)) : 0;
}

double scree_adhesion_overlap(const scree_adhesion *of, double a)
{
    return a * a / of->radius - (of->jkr ? of->root * sqrt(a) : 0);
}

double scree_adhesion_force(const scree_adhesion *of, double a)
{
    const double hertz = of->stiffness * a * a * a / of->radius;
    return hertz - (of->jkr ? 1.5 * of->root * of->stiffness * a * sqrt(a) : scree_adhesion_pull_off(of));
}

double scree_adhesion_energy(const scree_adhesion *of, double a)
{
    const double s = a * sqrt(a) / of->radius, root = of->root, square = of->stiffness * a * a;
    if (of->jkr) return square * (0.4 * s * s - root * s + 0.375 * root * root);
    return 0.4 * square * s * s - scree_adhesion_pull_off(of) * a * a / of->radius;
}

double scree_adhesion_stiffness(const scree_adhesion *of, double a)
{
    const double cube = 4 * a * sqrt(a), pulled = of->jkr ? of->root * of->radius : 0;
    return 1.5 * of->stiffness * a * (cube - 3 * pulled) / (cube - pulled);
}

double scree_adhesion_area_of_overlap(const scree_adhesion *of, double overlap)
{
    if (overlap <= -scree_adhesion_neck(of)) return 0;
    double low = last_area(of), high = low + sqrt(of->radius * fmax(0, overlap)) + pow(of->root * of->radius, 2.0 / 3);
    while (scree_adhesion_overlap(of, high) < overlap) high *= 2;
    for (;;) {
        double middle = 0.5 * (low + high);
        if (middle <= low || middle >= high) return middle;
        if (scree_adhesion_overlap(of, middle) < overlap)
            low = middle;
        else
            high = middle;
    }
}

double scree_adhesion_area_of_force(const scree_adhesion *of, double force)
{
    const double pull = scree_adhesion_pull_off(of), above = fmax(0, force + pull);
    const double load = of->jkr ? above + pull + 2 * sqrt(pull * above) : above;
    return cbrt(of->radius * load / of->stiffness);
}

/// U at the first touch.
static double first_energy(const scree_adhesion *of)
{
    const double root = cbrt(of->root * of->radius);
    return of->jkr ? scree_adhesion_energy(of, root * root) : 0;
}

double scree_adhesion_loss(const scree_adhesion *of)
{
    return of->jkr ? scree_adhesion_energy(of, last_area(of)) - first_energy(of) : 0;
}

double scree_adhesion_sticking_speed(const scree_adhesion *of, double mass)
{
    return sqrt(2 * scree_adhesion_loss(of) / mass);
}

double scree_adhesion_deepest(const scree_adhesion *of, double mass, double speed)
{
    const double energy = 0.5 * mass * speed * speed + first_energy(of), root = cbrt(of->root * of->radius);
    // From the radius of no force on, U grows.
    double low = scree_adhesion_area_of_force(of, 0), high = low + root * root;
    if (!(high > 0)) high = of->radius * 1e-9;
    while (scree_adhesion_energy(of, high) < energy) high *= 2;
    for (;;) {
        double middle = 0.5 * (low + high);
        if (middle <= low || middle >= high) return middle;
        if (scree_adhesion_energy(of, middle) < energy)
            low = middle;
        else
            high = middle;
    }
}

/// Of one impact: what accelerates the relative motion.
typedef struct motion {
    const scree_adhesion *of;
    double damping, mass;
} motion;

static double deceleration(const motion *m, double overlap, double rate)
{
    const double a = scree_adhesion_area_of_overlap(m->of, overlap);
    if (!(a > 0)) return 0;
    const double eta = m->damping * sqrt(m->mass * m->of->stiffness * a);
    return fmax(scree_adhesion_force(m->of, a) + eta * rate, -scree_adhesion_pull_off(m->of)) / m->mass;
}

/// One step of Runge and Kutta.
static void advance(const motion *m, double step, double *overlap, double *rate)
{
    const double d = *overlap, v = *rate;
    const double k1 = -deceleration(m, d, v);
    const double v2 = v + 0.5 * step * k1, k2 = -deceleration(m, d + 0.5 * step * v, v2);
    const double v3 = v + 0.5 * step * k2, k3 = -deceleration(m, d + 0.5 * step * v2, v3);
    const double v4 = v + step * k3, k4 = -deceleration(m, d + step * v3, v4);
    *overlap = d + step / 6 * (v + 2 * v2 + 2 * v3 + v4);
    *rate = v + step / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
}

enum { STEPS = 2000, MOST_TIMES = 100 };

scree_status scree_impact_adhesive(const scree_adhesion *of, double damping, double mass, double speed,
                                   scree_impact *impact, scree_error *error)
{
    if (!(speed > 0) || !(mass > 0) || !(damping >= 0))
        return scree_error_set(error, SCREE_ERROR_INPUT,
                               "an impact needs a speed and a mass above zero and damping of zero or more");
    const motion m = {of, damping, mass};
    const double neck = scree_adhesion_neck(of), held = of->jkr ? scree_adhesion_energy(of, last_area(of)) : 0;
    const double stiffest = 1.5 * of->stiffness * scree_adhesion_deepest(of, mass, speed);
    const double step = sqrt(mass / stiffest) / (STEPS * fmax(1, damping));
    double overlap = 0, rate = speed;
    *impact = (scree_impact){.restitution = 0};
    for (int64_t k = 0; k < (int64_t)STEPS * MOST_TIMES; k++) {
        const double before = overlap;
        advance(&m, step, &overlap, &rate);
        impact->duration += step;
        if (rate < 0 && overlap <= -neck) {
            impact->duration -= step * (-neck - overlap) / (before - overlap);
            impact->restitution = -rate / speed;
            break;
        }
        const double a = scree_adhesion_area_of_overlap(of, overlap);
        if (rate < 0 && 0.5 * mass * rate * rate + scree_adhesion_energy(of, a) < held) break;
    }
    const double sticking = scree_adhesion_sticking_speed(of, mass) / speed;
    if (damping == 0) impact->restitution = sticking < 1 ? sqrt((1 - sticking) * (1 + sticking)) : 0;
    return SCREE_OK;
}
