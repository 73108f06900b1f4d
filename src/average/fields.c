/// Sums over elements, and the columns that are made of them.
#include "average/fields.h"

#include "average/tensor.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

const char *const scree_average_field_names[SCREE_AVERAGE_FIELDS + 1] = {
    "density", "coordination", "stress", "fabric", "inertia", "velocity", "elastic", "kinetic", NULL};

// ---- sums --------------------------------------------------------------------------------------------------------

static void add_grain(const scree_average_sample *sample, uint32_t p, double weight, scree_average_sums *sums)
{
    const scree_average_grain *grain = &sample->grain[p];
    const scree_average_own *own = &sample->own[p];
    const double solid = weight * grain->volume;
    sums->grains += weight;
    sums->solid += solid;
    sums->contacts += weight * own->contacts;
    sums->mass += weight * grain->mass;
    scree_along(sums->momentum, weight * grain->mass, grain->velocity, sums->momentum);
    scree_tensor_add(sums->motion, weight * grain->mass, grain->velocity, grain->velocity);
    scree_tensor_add_scaled(sums->moment, weight, own->moment);
    scree_tensor_add_scaled(sums->branches, solid, own->branches);
    scree_tensor_add_scaled(sums->normals, solid, own->normals);
    scree_tensor_add_scaled(sums->inertia, solid, own->inertia);
    scree_tensor_add_scaled(sums->axis, weight, own->axis);
    if (sample->earlier && grain->moved)
        for (int k = 0; k < 9; k++) sums->change[k] += weight * (own->moment[k] - sample->earlier[grain->body][k]);
    sums->axes += weight * (own->axis[0] + own->axis[4] + own->axis[8]);
}

typedef struct measuring {
    const scree_average_sample *sample;
    const scree_average_element *element;
    scree_average_value *value;
} measuring;

static void visit(void *user, uint32_t p)
{
    const measuring *m = user;
    const scree_average_grain *grain = &m->sample->grain[p];
    const double part = scree_average_part(m->sample, grain, m->element);
    if (scree_average_element_holds(m->element, m->sample->dimension, grain->position))
        add_grain(m->sample, p, 1, &m->value->centres);
    if (part > 0) add_grain(m->sample, p, part, &m->value->parts);
}

void scree_average_measure(const scree_average_sample *sample, const scree_average_bins *bins,
                           const scree_average_surface *surface, const scree_average_element *element,
                           scree_average_value *value)
{
    measuring m = {sample, element, value};
    *value = (scree_average_value){.volume = scree_average_element_volume(element, sample->dimension),
                                   .inside = scree_average_surface_part(surface, element)};
    scree_average_bins_visit(bins, element, visit, &m);
}

// ---- columns -----------------------------------------------------------------------------------------------------

typedef struct telling {
    const scree_average_sample *sample;
    const scree_average_value *value;
    scree_average_sink *sink;
    void *user;
} telling;

static void tell(const telling *t, const char *name, const char *suffix, const char *unit, double value)
{
    char whole[64];
    (void)snprintf(whole, sizeof whole, "%s%s", name, suffix);
    t->sink(t->user, whole, unit, value);
}

/// The components of a tensor that the dimension has.
static void tell_tensor(const telling *t, const char *name, const char *suffix, const char *unit, const double sum[9],
                        double factor)
{
    const int d = t->sample->dimension;
    char component[48];
    for (int i = 0; i < d; i++)
        for (int j = 0; j < d; j++) {
            (void)snprintf(component, sizeof component, "%s_%c%c", name, "xyz"[i], "xyz"[j]);
            tell(t, component, suffix, unit, factor * sum[3 * i + j]);
        }
}

static void tell_form(const telling *t, const char *name, const char *unit, const double sum[9], double factor)
{
    const scree_tensor_form form = scree_tensor_form_of(sum, t->sample->dimension);
    tell(t, name, "_trace", unit, factor * form.trace);
    tell(t, name, "_deviator", unit, factor * form.deviator);
    tell(t, name, "_angle", "degree", form.deviator > 0 ? form.angle * 180 / M_PI : NAN);
}

static void tell_density(const telling *t)
{
    const scree_average_value *v = t->value;
    tell(t, "volume_fraction", "", "1", v->centres.solid / v->volume);
    tell(t, "volume_fraction", "_inside", "1", v->centres.solid / v->volume / v->inside);
    tell(t, "volume_fraction", "_parts", "1", v->parts.solid / v->volume);
    tell(t, "volume_fraction", "_parts_inside", "1", v->parts.solid / v->volume / v->inside);
}

static void tell_coordination(const telling *t)
{
    const scree_average_value *v = t->value;
    tell(t, "coordination", "", "1", v->centres.contacts / v->centres.grains);
    tell(t, "coordination", "_parts", "1", v->parts.contacts / v->parts.grains);
}

static void tell_stress(const telling *t)
{
    const scree_average_value *v = t->value;
    const double factor = 1 / (v->volume * t->sample->thickness);
    double pressure[9];
    tell_tensor(t, "stress", "", "Pa", v->centres.moment, factor);
    tell_tensor(t, "stress", "_inside", "Pa", v->centres.moment, factor / v->inside);
    tell_tensor(t, "stress", "_parts", "Pa", v->parts.moment, factor);
    tell_tensor(t, "stress", "_parts_inside", "Pa", v->parts.moment, factor / v->inside);
    // The axis of the largest pressure.
    for (int k = 0; k < 9; k++) pressure[k] = -v->centres.moment[k];
    tell_form(t, "pressure", "Pa", pressure, factor);
}

static void tell_fabric(const telling *t)
{
    const scree_average_value *v = t->value;
    tell_tensor(t, "fabric", "", "1", v->centres.branches, 1 / v->volume);
    tell_form(t, "fabric", "1", v->centres.branches, 1 / v->volume);
    tell(t, "fabric_trace", "_inside", "1",
         (v->centres.branches[0] + v->centres.branches[4] + v->centres.branches[8]) / v->volume / v->inside);
    const scree_tensor_form fabric = scree_tensor_form_of(v->centres.branches, t->sample->dimension);
    tell(t, "fabric_anisotropy", "", "1", fabric.deviator / fabric.trace);
    tell(t, "fabric_factor", "", "1",
         (v->centres.branches[0] + v->centres.branches[4] + v->centres.branches[8]) * v->centres.grains /
             (v->centres.solid * v->centres.contacts));
    tell_tensor(t, "normals", "", "1", v->centres.normals, 1 / v->volume);
    tell_form(t, "normals", "1", v->centres.normals, 1 / v->volume);
}

static void tell_inertia(const telling *t)
{
    const scree_average_value *v = t->value;
    const char *unit = t->sample->dimension == 2 ? "m4" : "m5";
    double minor[9];
    tell_tensor(t, "inertia", "", unit, v->centres.inertia, 1 / v->volume);
    // The largest principal value of the opposite tensor is the smallest of this one.
    for (int k = 0; k < 9; k++) minor[k] = -v->centres.inertia[k];
    const scree_tensor_form form = scree_tensor_form_of(minor, t->sample->dimension);
    const double round = 1e-9 * fabs(form.trace);
    tell(t, "long_axis_angle", "", "degree", form.deviator > round ? form.angle * 180 / M_PI : NAN);
    const scree_tensor_form axes = scree_tensor_form_of(v->centres.axis, t->sample->dimension);
    tell(t, "axes_angle", "", "degree", v->centres.axes > 0 ? axes.angle * 180 / M_PI : NAN);
    tell(t, "axes_order", "", "1", axes.deviator / v->centres.axes);
}

static void tell_velocity(const telling *t)
{
    const char *const name[3] = {"velocity_x", "velocity_y", "velocity_z"};
    for (int k = 0; k < t->sample->dimension; k++)
        tell(t, name[k], "", "m/s", t->value->centres.momentum[k] / t->value->centres.mass);
}

static void tell_kinetic(const telling *t)
{
    const scree_average_sums *c = &t->value->centres;
    double fluctuating[9];
    memcpy(fluctuating, c->motion, sizeof fluctuating);
    if (c->mass > 0) scree_tensor_add(fluctuating, -1 / c->mass, c->momentum, c->momentum);
    tell_tensor(t, "kinetic", "", "Pa", fluctuating, -1 / (t->value->volume * t->sample->thickness));
}

void scree_average_tell(const scree_average_sample *sample, const scree_average_value *value, unsigned fields,
                        scree_average_sink *sink, void *user)
{
    static void (*const tellers[SCREE_AVERAGE_FIELDS])(const telling *) = {
        tell_density, tell_coordination, tell_stress, tell_fabric, tell_inertia, tell_velocity, NULL, tell_kinetic};
    const telling t = {sample, value, sink, user};
    tell(&t, "grains", "", "1", value->centres.grains);
    tell(&t, "inside", "", "1", value->inside);
    for (int k = 0; k < SCREE_AVERAGE_FIELDS; k++)
        if (tellers[k] && fields >> k & 1) tellers[k](&t);
}
