/// What the core declares of the schema of a case file. Add a key: a member in config.h, a line here; the rest follows.
/// Keys of modules stand in their own files.
/// Ranges are wide: they keep out slips of the unit and numbers that would overflow, not unusual physics.
#include "case/schema.h"

#include "case/schema_walls.h"
#include "module/key_rows.h"

// ---- choices -----------------------------------------------------------------------------------------------------

static const scree_choice shapes[] = {
    {"disc", SCREE_SHAPE_DISC, "a cylinder whose axis is normal to the plane, in two dimensions"},
    {"sphere", SCREE_SHAPE_SPHERE, "in three dimensions"},
    {0},
};
static const scree_choice distributions[] = {
    {"uniform", SCREE_SIZE_UNIFORM, "every radius between the smallest and the largest is equally likely"},
    {"two_sizes", SCREE_SIZE_TWO_SIZES, "the smallest and the largest radius, in equal numbers"},
    {"equal", SCREE_SIZE_EQUAL, "one radius for all"},
    {0},
};
static const scree_choice periodics[] = {
    {"no", SCREE_PERIODIC_NONE, "not periodic: plates and what `lateral` says"},
    {"x", SCREE_PERIODIC_X, "2D: periodic in x, between plates below and above"},
    {"xy", SCREE_PERIODIC_XY, "periodic in x and y: in 2D without any boundary, in 3D between plates below and above"},
    {"xyz", SCREE_PERIODIC_XYZ, "periodic in all directions of space"},
    {0},
};
static const scree_choice laterals[] = {
    {"pressure", SCREE_BOUNDARY_PRESSURE, "traction on the Delaunay boundary of the assembly"},
    {"plates", SCREE_BOUNDARY_PLATES, "rigid side plates that a servo holds at the pressure"},
    {"membrane", SCREE_BOUNDARY_MEMBRANE, "pressure on a membrane around the assembly"},
    {0},
};
static const scree_choice boundaries[] = {
    {"auto", SCREE_BOUNDARY_AUTO,
     "that of the stage before, at first the `walls` of the case, or as `boundary.lateral` says"},
    {"pressure", SCREE_BOUNDARY_PRESSURE, "plates below and above, pressure on the Delaunay boundary of the sides"},
    {"plates", SCREE_BOUNDARY_PLATES, "rigid plates on all sides, those beside the sample under servo"},
    {"membrane", SCREE_BOUNDARY_MEMBRANE,
     "plates below and above; at the sides a chain of frictionless discs (3D: a sheet of spheres) carries the "
     "pressure"},
    {"minimal", SCREE_BOUNDARY_MINIMAL,
     "no plates: pressure on all sides, and minimal kinematic conditions impose the strain rate"},
    {"affine", SCREE_BOUNDARY_AFFINE, "no plates: every body of the boundary moves with the velocity gradient"},
    {"walls", SCREE_BOUNDARY_WALLS, "no plates: only the `walls` of the case"},
    {0},
};
// Component ij is the derivative of velocity i by coordinate j; its value is its place in a 3 x 3 tensor by rows.
static const scree_choice components[] = {
    {"xx", 0, "d v_x / d x"}, {"xy", 1, "d v_x / d y"},
    {"xz", 2, "d v_x / d z"}, {"yx", 3, "d v_y / d x"},
    {"yy", 4, "d v_y / d y"}, {"yz", 5, "d v_y / d z"},
    {"zx", 6, "d v_z / d x"}, {"zy", 7, "d v_z / d y"},
    {"zz", 8, "d v_z / d z"}, {0},
};
static const scree_choice symmetric_components[] = {
    {"xx", 0, "strain rate along x"},
    {"yy", 4, "strain rate along y"},
    {"zz", 8, "strain rate along z"},
    {"xy", 1, "shear rate, mean of xy and yx"},
    {"xz", 2, "shear rate, mean of xz and zx"},
    {"yz", 5, "shear rate, mean of yz and zy"},
    {0},
};
static const scree_choice symmetric_stresses[] = {
    {"xx", 0, "normal stress on x"},
    {"yy", 4, "normal stress on y"},
    {"zz", 8, "normal stress on z"},
    {"xy", 1, "shear stress xy"},
    {"xz", 2, "shear stress xz"},
    {"yz", 5, "shear stress yz"},
    {0},
};
static const scree_choice methods[] = {
    {"drop_and_roll", SCREE_PREPARE_DROP_AND_ROLL,
     "each particle falls and rolls on those below until it is stable (Jodrey and Tory 1979)"},
    {"hexagonal", SCREE_PREPARE_HEXAGONAL, "triangular lattice of equal discs that touch"},
    {"square", SCREE_PREPARE_SQUARE, "square lattice of equal discs that touch"},
    {"face_centred", SCREE_PREPARE_FACE_CENTRED,
     "face-centred cubic lattice of equal spheres that touch, square layers horizontal"},
    {"cubic", SCREE_PREPARE_CUBIC, "simple cubic lattice of equal spheres that touch"},
    {"gas", SCREE_PREPARE_GAS, "loose random places without contacts"},
    {"growth", SCREE_PREPARE_GROWTH,
     "particles grow at random places and push each other away: dense and isotropic, without contacts"},
    {"pair", SCREE_PREPARE_PAIR, "two particles on the x axis that approach each other, for the stage collide"},
    {"bodies", SCREE_PREPARE_BODIES, "the particles that `bodies` lists, each where it says and as fast"},
    {0},
};
static const scree_choice outlines[] = {
    {"box", SCREE_SAMPLE_BOX, "the packing fills its box"},
    {"circle", SCREE_SAMPLE_CIRCLE, "in two dimensions: the middle of a larger packing, without plates around it"},
    {"ball", SCREE_SAMPLE_BALL, "in three dimensions: the middle of a larger packing, without plates around it"},
    {0},
};
static const scree_choice stage_kinds[] = {
    {"prepare", SCREE_STAGE_PREPARE, "places the particles"},
    {"confine", SCREE_STAGE_CONFINE, "raises the pressure and waits for equilibrium"},
    {"compress", SCREE_STAGE_COMPRESS, "shortens the sample along its axis to a strain"},
    {"deform", SCREE_STAGE_DEFORM, "imposes any components of the velocity gradient, to a strain"},
    {"rotate_particle", SCREE_STAGE_ROTATE, "turns one particle and watches how rotations spread"},
    {"relax", SCREE_STAGE_RELAX, "lets time pass: gravity, standing plates, walls of the case that stand or move"},
    {"collide", SCREE_STAGE_COLLIDE, "lets two particles meet and part"},
    {0},
};

// ---- sections ----------------------------------------------------------------------------------------------------

typedef scree_config_material material;
static const scree_key material_keys[] = {
    KEY(material, name, SCREE_KEY_WORD, FROM("1"), TO("63"), .meaning = "Name, for particles.material."),
    NUMBER(material, young_modulus, "Pa", FROM("1 Pa"), TO("1e6 GPa"), .meaning = "Young's modulus."),
    NUMBER(material, poisson_ratio, "1", .standard = "0.3", ABOVE("-1"), TO("0.5"), .meaning = "Poisson's ratio."),
    NUMBER(material, density, "kg/m3", FROM("1e-3 kg/m3"), TO("1e12 kg/m3"),
           .meaning = "Density; often scaled up to allow larger steps."),
    NUMBER(material, friction, "1", FROM("0"), TO("10"), .meaning = "Coefficient of friction between particles."),
    NUMBER(material, wall_friction, "1", .standard = "auto", FROM("0"), TO("10"),
           .meaning = "Coefficient of friction on plates; auto: `friction`."),
    KEY(material, wall_material, SCREE_KEY_WORD, .standard = "auto", FROM("1"), TO("63"),
        .meaning = "What plates and walls that it touches are made of: a material, or `rigid`; auto: the same as it."),
};

typedef scree_config_particles particles;
static const scree_key particles_keys[] = {
    CHOICE(particles, shape, shapes, .standard = "disc", .meaning = "Shape of the particles."),
    KEY(particles, material, SCREE_KEY_WORD, FROM("1"), TO("63"), .meaning = "Name of one of the materials."),
    INTEGER(particles, count, FROM("1"), TO("1e8"), .meaning = "Number of particles."),
    CHOICE(particles, distribution, distributions, .standard = "uniform", .meaning = "Distribution of the radii."),
    {.name = "radius",
     .type = SCREE_KEY_NUMBER,
     .unit = "m",
     FROM("1 nm"),
     TO("100 m"),
     .when = "distribution=equal",
     .offset = offsetof(particles, radius_min),
     .meaning = "Radius of all particles."},
    NUMBER(particles, radius_min, "m", FROM("1 nm"), TO("100 m"), .when = "distribution=uniform|two_sizes",
           .meaning = "Smallest radius."),
    NUMBER(particles, radius_max, "m", FROM("1 nm"), TO("100 m"), .when = "distribution=uniform|two_sizes",
           .meaning = "Largest radius."),
    NUMBER(particles, thickness, "m", .standard = "auto", FROM("1 nm"), TO("1 km"), .when = "shape=disc",
           .meaning = "Length of a disc along its axis; auto: twice the mean radius."),
};

typedef scree_config_contact contact;
static const scree_key contact_keys[] = {
    CHOICE(contact, law, NULL, .standard = "hertz_mindlin", .meaning = "Force law of a contact."),
    MODULE_KEYS,
    NUMBER(contact, reference_velocity, "m/s", .standard = "auto", ABOVE("0 m/s"), TO("1000 m/s"),
           .meaning = "v_R, to which slip speeds are referred; auto: 2 x strain rate x mean radius."),
};

typedef scree_config_integrator integrator;
static const scree_key integrator_keys[] = {
    CHOICE(integrator, scheme, NULL, .standard = "velocity_verlet", .meaning = "Integration scheme."),
    NUMBER(integrator, step, "s", .standard = "auto", ABOVE("0 s"), TO("10 s"),
           .meaning =
               "Time step, the small one of two_timescales; auto: the largest is `step_fraction` of the critical "
               "step."),
    NUMBER(integrator, step_fraction, "1", .standard = "0.1", ABOVE("0"), TO("1"), .when = "step=auto",
           .meaning = "Largest step over critical step."),
};

typedef scree_config_boundary boundary;
static const scree_key boundary_keys[] = {
    CHOICE(boundary, periodic, periodics, .standard = "no", .meaning = "Directions in which the sample repeats."),
    CHOICE(boundary, lateral, laterals, .standard = "pressure",
           .meaning = "What holds the sides, beside plates below and above, until a stage chooses its `boundary`. Not "
                      "asked for where the sample is periodic."),
    INTEGER(boundary, every, .standard = "250", FROM("1"), TO("1e9"),
            .meaning =
                "Steps between two updates of the Delaunay boundary; with two_timescales steps of N_S small ones."),
    NUMBER(boundary, gap_limit, "1", .standard = "0.5", FROM("0"), TO("100"),
           .meaning = "Boundary edges with a free gap above this many mean diameters are cut."),
    NUMBER(boundary, gap_hysteresis, "1", .standard = "0.2", FROM("0"), BELOW("1"),
           .meaning =
               "An edge that is on the boundary stays until its gap is above the limit by this share; one that is "
               "not comes back when it is as much below. 0: the boundary has no memory."),
    NUMBER(boundary, servo_gain, "1", .standard = "1", ABOVE("0"), TO("10"),
           .meaning = "Admittance of a plate under servo over that of the sample; 1 absorbs waves."),
    NUMBER(boundary, servo_velocity, "m/s", .standard = "auto", ABOVE("0 m/s"), TO("1000 m/s"),
           .meaning = "Largest velocity of a plate under servo."),
    NUMBER(boundary, penalty, "Pa s", .standard = "auto", ABOVE("0 Pa s"), TO("1e30 Pa s"),
           .meaning = "Minimal conditions: stress over the error of the rate; auto: the pressure answers an error of "
                      "1 %."),
    NUMBER(boundary, membrane_stiffness, "N/m", .standard = "10 N/mm", FROM("0 N/m"), TO("1e12 N/m"),
           .meaning = "Membrane: axial stiffness between two neighbours; 3D: of the sheet, tension per length over "
                      "strain. It bears no compression."),
    NUMBER(boundary, membrane_radius, "m", .standard = "auto", FROM("1 nm"), TO("100 m"),
           .meaning =
               "Membrane: radius of its bodies; auto: 1.25 times the mean radius of the particles; 3D: 0.75 times "
               "it, at least the smallest."),
};

typedef scree_config_stage stage;
#define STAGE_HEAD                                                                                                     \
    {.name = "stage",                                                                                                  \
     .type = SCREE_KEY_CHOICE,                                                                                         \
     .choices = stage_kinds,                                                                                           \
     .offset = offsetof(stage, kind),                                                                                  \
     .meaning = "Kind of the stage."},                                                                                 \
        KEY(stage, name, SCREE_KEY_WORD, .standard = "auto", FROM("1"), TO("63"),                                      \
            .meaning = "Name in the log and for --set; auto: the kind, numbered from 1 if there are several.")
#define STAGE_FRICTION                                                                                                 \
    NUMBER(stage, friction, "1", .standard = "auto", FROM("0"), TO("10"),                                              \
           .meaning = "Friction in this stage, e.g. less while confining for a denser sample; auto: the material's.")
#define STAGE_BOUNDARY                                                                                                 \
    CHOICE(stage, boundary, boundaries, .standard = "auto", .meaning = "What holds the sample in this stage.")
typedef scree_config_body body;
static const scree_key body_keys[] = {
    KEY(body, position, SCREE_KEY_VECTOR, .unit = "m", FROM("-1e6 m"), TO("1e6 m"), .meaning = "Of its centre."),
    KEY(body, velocity, SCREE_KEY_VECTOR, .unit = "m/s", .standard = "[0, 0]", FROM("-1e5 m/s"), TO("1e5 m/s"),
        .meaning = "At the begin."),
    KEY(body, spin, SCREE_KEY_VECTOR, .unit = "rad/s", .standard = "[0, 0]", FROM("-1e6 rad/s"), TO("1e6 rad/s"),
        .meaning = "Angular velocity at the begin; in two dimensions [0, 0, about z]."),
    NUMBER(body, radius, "m", .standard = "auto", FROM("1 nm"), TO("100 m"),
           .meaning = "Radius, within the limits of `particles`; auto: the one that all particles have."),
    KEY(body, material, SCREE_KEY_WORD, .standard = "auto", FROM("1"), TO("63"),
        .meaning = "Name of one of the materials; auto: particles.material."),
};
static const scree_section body_table[] = {TABLE("bodies", "A particle at a given position.", body_keys)};
static const scree_key prepare_keys[] = {
    STAGE_HEAD,
    CHOICE(stage, method, methods, .standard = "drop_and_roll", .meaning = "How the particles are placed."),
    NUMBER(stage, aspect_ratio, "1", .standard = "2", FROM("0.01"), TO("100"),
           .when = "width=auto&method=drop_and_roll|hexagonal|square|face_centred|cubic|gas|growth|pair",
           .meaning = "Height over width of the sample."),
    CHOICE(stage, outline, outlines, .standard = "box", .meaning = "Outline of the sample."),
    NUMBER(stage, width, "m", .standard = "auto", FROM("1 nm"), TO("100 km"), .when = "outline=box",
           .meaning = "Width of the sample; auto: from `aspect_ratio`, and number and sizes of the particles; with "
                      "`bodies` as far as they reach."),
    NUMBER(stage, depth, "m", .standard = "auto", FROM("1 nm"), TO("100 km"), .when = "particles.shape=sphere",
           .meaning = "Depth of the sample, along y in three dimensions; auto: its width; with `bodies` as far as they "
                      "reach."),
    NUMBER(stage, solid_fraction, "1", .standard = "auto", ABOVE("0"), TO("90 %"), .when = "method=gas|growth",
           .meaning = "Area (volume) of the particles over that of the box; auto: 30 % of discs and 15 % of spheres in "
                      "a gas; with growth 80 % and 60 %, less what the walls take."),
    NUMBER(stage, velocity, "m/s", .standard = "0 m/s", FROM("0 m/s"), TO("1000 m/s"), .when = "method=gas",
           .meaning = "Root-mean-square velocity component."),
    NUMBER(stage, gap, "m", .standard = "auto", FROM("0 m"), TO("1 km"), .when = "method=pair",
           .meaning = "Between the surfaces of the two; auto: about their indentation in the impact."),
    NUMBER(stage, speed, "m/s", .standard = "auto", ABOVE("0 m/s"), TO("1e5 m/s"), .when = "method=pair",
           .meaning = "Relative speed at which they approach; auto: contact.reference_velocity."),
    NUMBER(stage, height, "m", .standard = "auto", FROM("1 nm"), TO("100 km"), .when = "method=bodies",
           .meaning = "Height of the box, which begins at the origin; auto: as far as the bodies reach."),
    KEY(stage, bodies, SCREE_KEY_LIST, FROM("1"), TO("1000"), .sections = body_table, .section_count = 1,
        .count_offset = offsetof(stage, body_count), .element_size = sizeof(body), .when = "method=bodies",
        .meaning = "The particles, numbered from 0; as many as particles.count says."),
};
static const scree_key confine_keys[] = {
    STAGE_HEAD,
    NUMBER(stage, pressure, "Pa", FROM("1e-3 Pa"), TO("1000 GPa"), .meaning = "Confining pressure."),
    NUMBER(stage, ramp_time, "s", .standard = "auto", FROM("0 s"), TO("1e9 s"),
           .meaning = "Time in which the pressure is raised."),
    NUMBER(stage, unbalanced_limit, "1", .standard = "1e-3", FROM("1e-9"), BELOW("1"),
           .meaning = "The stage ends when the unbalanced force ratio stays below this."),
    NUMBER(stage, stress_tolerance, "1", .standard = "auto", FROM("1e-9"), BELOW("1"),
           .meaning =
               "And when the normal stresses of a periodic cell (means since the last sample), or the stress of the "
               "top plate, are this near to the pressure, relative to it; auto: 0.2 % in a periodic cell, 5 % "
               "with plates."),
    NUMBER(stage, time_limit, "s", .standard = "auto", .guard = true, ABOVE("0 s"), TO("1e9 s"),
           .meaning = "The run stops with a message if equilibrium takes longer."),
    STAGE_BOUNDARY,
    STAGE_FRICTION,
};
static const scree_key compress_keys[] = {
    STAGE_HEAD,
    NUMBER(stage, strain, "1", ABOVE("0 %"), TO("90 %"), .meaning = "Axial strain at which the stage ends."),
    NUMBER(stage, rate, "1/s", ABOVE("0 1/s"), TO("1e6 1/s"), .meaning = "Axial strain rate."),
    NUMBER(stage, rise_time, "s", .standard = "auto", FROM("0 s"), TO("1e9 s"),
           .meaning = "Time in which the rate is reached; auto: four wave times of the sample."),
    STAGE_BOUNDARY,
    STAGE_FRICTION,
};
static const scree_key deform_keys[] = {
    STAGE_HEAD,
    TENSOR(stage, velocity_gradient, components, "1/s", FROM("-1e6 1/s"), TO("1e6 1/s"),
           .meaning = "Prescribed components of the velocity gradient, e.g. {xy: 5e-3 1/s, yx: 0}; extension positive; "
                      "the others are free, in a periodic cell zero."),
    TENSOR(stage, strain_rate, symmetric_components, "1/s", FROM("-1e6 1/s"), TO("1e6 1/s"),
           .meaning = "Prescribed components of its symmetric part, e.g. {xy: 5e-3 1/s}; rotations stay free."),
    TENSOR(stage, stress, symmetric_stresses, "Pa", FROM("-1000 GPa"), TO("1000 GPa"),
           .meaning =
               "Stresses that a periodic cell holds by the same component of its velocity gradient, e.g. {yy: 100 "
               "kPa}; compression positive, shear stress in the sense of the rate."),
    NUMBER(stage, strain, "1", ABOVE("0 %"), TO("1000000 %"),
           .meaning = "The stage ends when the largest prescribed component has reached this, measured on the boundary "
                      "or the cell."),
    NUMBER(stage, rise_time, "s", .standard = "auto", FROM("0 s"), TO("1e9 s"),
           .meaning = "Time in which the rates are reached; auto: four wave times of the sample."),
    STAGE_BOUNDARY,
    STAGE_FRICTION,
};

static const scree_choice axes[] = {
    {"x", SCREE_AXIS_X, "only in 3D"},
    {"y", SCREE_AXIS_Y, "only in 3D"},
    {"z", SCREE_AXIS_Z, "out of the plane in 2D"},
    {0},
};
static const scree_key rotate_keys[] = {
    STAGE_HEAD,
    NUMBER(stage, spin, "rad/s", ABOVE("0 rad/s"), TO("1e6 rad/s"),
           .meaning = "Angular velocity of the forced particle."),
    CHOICE(stage, axis, axes, .standard = "z", .meaning = "Axis that it turns about."),
    NUMBER(stage, particle, "1", .standard = "auto", FROM("0"), TO("1e9"),
           .meaning = "Number of the forced particle, from 0; auto: of those near the centre the one that bears most."),
    NUMBER(stage, rest_time, "s", .standard = "0 s", FROM("0 s"), TO("1e9 s"),
           .meaning = "Time before, in which it is held still and the spins that there are anyway are measured."),
    NUMBER(stage, ramp_time, "s", .standard = "auto", ABOVE("0 s"), TO("1e9 s"),
           .meaning = "Time in which the spin is reached, linearly; auto: four wave times of the sample."),
    NUMBER(stage, hold_time, "s", ABOVE("0 s"), TO("1e9 s"),
           .meaning = "Time for which it is held, in which the spins of the others are measured."),
    NUMBER(stage, cutoff, "1", .standard = "10", ABOVE("0"), TO("1e4"),
           .meaning = "Radius around the particle, in mean diameters, of the force network that is measured."),
    STAGE_BOUNDARY,
    STAGE_FRICTION,
};

static const scree_choice wall_motions[] = {
    {"move", SCREE_WALLS_MOVE, "with the velocities and spins that the case gives them"},
    {"stand", SCREE_WALLS_STAND, "all of them stand where they have come to"},
    {0},
};
static const scree_key relax_keys[] = {
    STAGE_HEAD,
    NUMBER(stage, duration, "s", ABOVE("0 s"), TO("1e9 s"), .meaning = "Time after which the stage ends."),
    NUMBER(stage, unbalanced_limit, "1", .standard = "auto", FROM("1e-9"), BELOW("1"),
           .meaning = "It ends before when the unbalanced force ratio stays below this; auto: never."),
    CHOICE(stage, walls, wall_motions, .standard = "move", .meaning = "What the walls of the case do."),
    STAGE_BOUNDARY,
    STAGE_FRICTION,
};

static const scree_key collide_keys[] = {
    STAGE_HEAD,
    NUMBER(stage, duration, "s", .standard = "auto", ABOVE("0 s"), TO("1e9 s"),
           .meaning = "The stage ends when the two have parted, or after this; auto: twice as long as it should take."),
};

typedef scree_config_measure measure;
static const scree_key measure_keys[] = {
    INTEGER(measure, samples, .standard = "200", FROM("1"), TO("1e6"),
            .meaning = "Rows of series.csv for each loading stage."),
    KEY(measure, windows, SCREE_KEY_PAIRS, .unit = "1", .standard = "[]", FROM("0 %"), TO("1000 %"),
        .count_offset = offsetof(measure, window_count), .element_size = sizeof(scree_config_window),
        .meaning = "Windows [from, to] of axial strain over which displacement fluctuations are taken."),
    FLAG(measure, cells, .standard = "yes",
         .meaning = "Fields of the Delaunay cells in snapshots; shear bands between them. Not in periodic samples."),
    NUMBER(measure, band_window, "1", .standard = "1 %", ABOVE("0 %"), TO("90 %"), .when = "cells=yes",
           .meaning = "Shear bands are looked for between snapshots at least this far apart in axial strain."),
};

typedef scree_config_output output;
static const scree_key output_keys[] = {
    INTEGER(output, snapshots, .standard = "10", FROM("0"), TO("1e5"),
            .meaning = "Snapshots of each loading stage, evenly in strain."),
    NUMBER(output, checkpoint_interval, "s", .standard = "60 s", FROM("0.1 s"), TO("1e7 s"),
           .meaning = "Wall time between two checkpoints."),
    INTEGER(output, checkpoint_steps, .standard = "0", FROM("0"), TO("1e15"),
            .meaning = "Steps between two checkpoints, besides the wall time; 0: wall time only."),
    FLAG(output, figures, .standard = "yes", .meaning = "Draw charts and scenes at the end."),
    FLAG(output, paraview, .standard = "yes", .meaning = "Write files for ParaView."),
};

typedef scree_config_guard guard;
static const scree_key guard_keys[] = {
    NUMBER(guard, overlap, "1", .standard = "20 %", .guard = true, ABOVE("0 %"), TO("100 %"),
           .meaning = "Largest indentation over the smaller radius."),
    NUMBER(guard, energy_growth, "1", .standard = "5 %", .guard = true, ABOVE("0 %"), TO("10000 %"),
           .meaning =
               "Largest residual of the energy ledger over all energy that there is and was: at the begin, turned "
               "over, stored now. Energy that grows without end tends to 100 %."),
};

static const scree_section material_table[] = {
    OPEN_TABLE("materials", "What particles and plates are made of.", material_keys, scree_config_material)};
static const scree_section particles_table[] = {TABLE("particles", "Shape, number and sizes.", particles_keys)};
static const scree_section contact_table[] = {
    OPEN_TABLE("contact", "Forces between touching particles.", contact_keys, contact)};
static const scree_section integrator_table[] = {
    OPEN_TABLE("integrator", "Motion in time.", integrator_keys, integrator)};
static const scree_section boundary_table[] = {TABLE("boundary", "What surrounds the sample.", boundary_keys)};
static const scree_section stage_tables[] = {
    TABLE("prepare", "Places the particles; the first stage of every case.", prepare_keys),
    TABLE("confine", "Raises the pressure on all sides and waits for equilibrium.", confine_keys),
    TABLE(
        "compress",
        "Shortens the sample along its axis at a constant rate under the pressure reached before: plates approach each "
        "other, or minimal conditions or a periodic cell impose the rate.",
        compress_keys),
    TABLE("deform",
          "Imposes components of the velocity gradient on the boundary; needs `minimal`, `affine` or a "
          "periodic cell.",
          deform_keys),
    TABLE("rotate_particle",
          "Turns one particle at a prescribed spin under the pressure reached before; with `minimal` the sample as a "
          "whole is "
          "kept from turning.",
          rotate_keys),
    TABLE("relax",
          "Lets time pass under gravity, between plates that stand or the `walls` of the case, which move or stand.",
          relax_keys),
    TABLE("collide", "Two particles, prepared as a `pair` or as `bodies`, meet and part; nothing else acts on them.",
          collide_keys),
};
static const scree_section measure_table[] = {TABLE("measure", "What is recorded.", measure_keys)};
static const scree_section output_table[] = {TABLE("output", "What is written, and how often.", output_keys)};
static const scree_section guard_table[] = {TABLE("guard", "Limits that stop a run that went wrong.", guard_keys)};

#define SECTION(member, table, ...)                                                                                    \
    KEY(scree_config, member, SCREE_KEY_SECTION, .sections = table, .section_count = 1, __VA_ARGS__)
static const scree_key root_keys[] = {
    {.name = "scree",
     .type = SCREE_KEY_INTEGER,
     .standard = "1",
     FROM("1"),
     TO("1"),
     .offset = offsetof(scree_config, language),
     .meaning = "Version of the case language."},
    KEY(scree_config, name, SCREE_KEY_WORD, .standard = "case", FROM("1"), TO("63"),
        .meaning = "Short name, for file names and tables."),
    KEY(scree_config, title, SCREE_KEY_TEXT, .standard = "", FROM("0"), TO("200"), .meaning = "Title of the figures."),
    INTEGER(scree_config, dimension, .standard = "2", FROM("2"), TO("3"),
            .meaning = "Dimensions of space: 2 for discs, 3 for spheres."),
    INTEGER(scree_config, seed, .standard = "1", FROM("0"), TO("9007199254740992"),
            .meaning = "Seed of the random numbers: the same seed gives the same sample on any machine."),
    {.name = "gravity",
     .type = SCREE_KEY_VECTOR,
     .unit = "m/s2",
     .standard = "[0, 0]",
     FROM("-1e6 m/s2"),
     TO("1e6 m/s2"),
     .offset = offsetof(scree_config, gravity),
     .meaning = "Acceleration [x, y] or [x, y, z]; the last axis is upwards."},
    KEY(scree_config, materials, SCREE_KEY_LIST, FROM("1"), TO("16"), .sections = material_table, .section_count = 1,
        .count_offset = offsetof(scree_config, material_count), .element_size = sizeof(material),
        .meaning = "What particles and plates are made of."),
    SECTION(particles, particles_table, .meaning = "Shape, number and sizes of the particles."),
    SECTION(contact, contact_table, .meaning = "Force law."),
    SECTION(integrator, integrator_table, .meaning = "Integration in time."),
    SECTION(boundary, boundary_table, .meaning = "What holds the sample."),
    KEY(scree_config, walls, SCREE_KEY_LIST, .standard = "[]", FROM("0"), TO("16"), .sections = scree_wall_sections,
        .section_count = SCREE_WALL_SECTIONS, .count_offset = offsetof(scree_config, wall_count),
        .element_size = sizeof(scree_config_wall),
        .meaning = "Rigid walls beside the plates, fixed or moving; for `relax`."),
    KEY(scree_config, stages, SCREE_KEY_LIST, FROM("1"), TO("100"), .sections = stage_tables,
        .section_count = COUNT(stage_tables), .count_offset = offsetof(scree_config, stage_count),
        .element_size = sizeof(stage), .meaning = "What happens, one stage after the other."),
    SECTION(measure, measure_table, .meaning = "What is recorded."),
    SECTION(output, output_table, .meaning = "What is written."),
    SECTION(guard, guard_table, .meaning = "When a run is stopped."),
    {.name = "quick",
     .type = SCREE_KEY_PATHS,
     .standard = "{}",
     .meaning = "Key path and value of everything that --quick changes."},
};

const scree_section scree_schema_core = TABLE("case", "A case file.", root_keys);
