/// Boundaries that impose a velocity gradient on the Delaunay boundary: the pressure acts on all sides, what is not
/// prescribed is free. In compression the axial component is imposed, - rate / (1 - strain) at the strain that the rate
/// has led to.
#include "boundary/imposed_gradient.h"
#include "boundary/minimal.h"
#include "boundary/plates.h"
#include "state/pressure.h"

#include <math.h>
#include <string.h>

double scree_imposed_wave_time(const scree_context *c, double pressure)
{
    return scree_sample_wave_time(c->model, c->state, pressure);
}

void scree_imposed_fit(const scree_context *c, double pressure)
{
    scree_imposed_gradient *imposed = scree_imposed(c->state);
    (void)pressure;
    memset(imposed->target, 0, sizeof imposed->target);
    memset(imposed->prescribed, 0, sizeof imposed->prescribed);
}

void scree_imposed_compress(const scree_context *c, const scree_compression *compression)
{
    scree_imposed_gradient *imposed = scree_imposed(c->state);
    int axial = c->state->dimension == 3 ? 8 : 4;
    imposed->prescribed[axial] = SCREE_FULL;
    imposed->viscosity = scree_minimal_viscosity_at(c->model, scree_pressure_now(c->state), compression->rate);
    imposed->target[axial] = -(compression->rate * compression->rise) / (1 - compression->strain);
}

void scree_imposed_deform(const scree_context *c, const scree_demand *demand, double rise)
{
    scree_imposed_gradient *imposed = scree_imposed(c->state);
    double largest = demand->scale;
    memcpy(imposed->prescribed, demand->how, sizeof imposed->prescribed);
    for (int k = 0; k < 9; k++) {
        largest = fmax(largest, fabs(demand->rate[k]));
        imposed->target[k] = demand->rate[k] * rise;
    }
    imposed->viscosity = scree_minimal_viscosity_at(c->model, scree_pressure_now(c->state), largest);
}
