/// What the core declares of the schema of a case file. Add a key: a member in config.h, a line here; the rest follows.
/// Keys of modules stand in their own files.
/// Ranges are wide: they keep out slips of the unit and numbers that would overflow, not unusual physics.
#include "case/schema.h"

#include "case/schema_sources.h"
#include "case/schema_walls.h"
#include "module/key_rows.h"

#include <math.h>

// ---- choices -----------------------------------------------------------------------------------------------------

static const scree_choice share_kinds[] = {
    {"number", SCREE_SHARE_BY_NUMBER, "`share` is of the number of particles"},
    {"mass", SCREE_SHARE_BY_MASS, "`share` is of the mass of the particles"},
    {"count", SCREE_SHARE_BY_COUNT, "each species has its `count`"},
    {0},
};
static const scree_choice listed[] = {{"given", 1, "the list has elements"}, {0}};
static const scree_choice periodics[] = {
    {"no", SCREE_PERIODIC_NONE, "in no direction"},
    {"x", SCREE_PERIODIC_X, "along the x axis"},
    {"y", SCREE_PERIODIC_Y, "along the y axis"},
    {"z", SCREE_PERIODIC_Z, "along the z axis, 3D"},
    {"xy", SCREE_PERIODIC_XY, "along x and y: in 2D a cell without any boundary, which can be deformed"},
    {"xz", SCREE_PERIODIC_XZ, "along x and z, 3D"},
    {"yz", SCREE_PERIODIC_YZ, "along y and z, 3D"},
    {"xyz", SCREE_PERIODIC_XYZ, "in all directions, 3D: a cell without any boundary, which can be deformed"},
    {0},
};
static const scree_choice boundaries[] = {
    {"auto", SCREE_CHOICE_AUTO,
     "that of the stage before, at first the `walls` of the case, or as `boundary.lateral` says"},
    {0},
};
static const scree_choice shapes[] = {
    {"auto", SCREE_CHOICE_AUTO, "that of all particles, `particles.shape`"},
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

typedef scree_config_species species;
static const scree_key species_keys[] = {
    KEY(species, name, SCREE_KEY_WORD, FROM("1"), TO("63"), .meaning = "Name, unique among the species."),
    KEY(species, material, SCREE_KEY_WORD, FROM("1"), TO("63"), .meaning = "Name of one of the materials."),
    NUMBER(species, share, "1", ABOVE("0"), TO("100 %"), .when = "particles.share_by=number|mass",
           .meaning = "Share of all particles; those of all species add up to 100 %."),
    INTEGER(species, count, FROM("1"), TO("1e8"), .when = "particles.share_by=count",
            .meaning = "Number of particles; those of all species add up to particles.count."),
    CHOICE(species, shape, shapes, .standard = "auto", .meaning = "Shape of these particles."),
    CHOICE(species, distribution, NULL, .standard = "uniform", .meaning = "Distribution of the radii."),
    MODULE_KEYS,
};
static const species unknown_species = {.share = NAN, .shape = SCREE_CHOICE_AUTO, .distribution = SCREE_CHOICE_WRONG};
static const scree_section species_table[] = {
    OPEN_TABLE("species", "Particles of one kind.", species_keys, scree_config_species)};

typedef scree_config_particles particles;
static bool is_flat(const scree_module *module)
{
    return module->shape->dimension == 2;
}

static const scree_key particles_keys[] = {
    CHOICE(particles, shape, NULL, .standard = "disc", .meaning = "Shape of the particles."),
    KEY(particles, material, SCREE_KEY_WORD, FROM("1"), TO("63"), .when = "species=[]",
        .meaning = "Name of one of the materials."),
    INTEGER(particles, count, FROM("1"), TO("1e8"), .meaning = "Number of particles."),
    CHOICE(particles, distribution, NULL, .standard = "uniform", .when = "species=[]",
           .meaning = "Distribution of the radii."),
    MODULE_KEYS,
    NUMBER(particles, thickness, "m", .standard = "auto", FROM("1 nm"), TO("1 km"), .chooser = "shape", .fits = is_flat,
           .meaning = "Length of a disc along its axis, or of a prism; auto: twice the mean radius."),
    CHOICE(particles, share_by, share_kinds, .standard = "number", .when = "species=given",
           .meaning = "What the shares of the species are of."),
    KEY(particles, species, SCREE_KEY_LIST, .standard = "[]", FROM("0"), TO("16"), .sections = species_table,
        .section_count = 1, .count_offset = offsetof(particles, species_count), .element_size = sizeof(species),
        .initial = &unknown_species, .choices = listed,
        .meaning =
            "Particles of several kinds, each with its own shape, material and sizes, at random positions among each "
            "other."),
};

typedef scree_config_pair_law pair_law;
static const scree_key pair_law_keys[] = {
    {.name = "between",
     .type = SCREE_KEY_WORD,
     .offset = offsetof(pair_law, one),
     FROM("1"),
     TO("63"),
     .meaning = "Name of one of the materials, or `rigid`."},
    {.name = "and",
     .type = SCREE_KEY_WORD,
     .offset = offsetof(pair_law, other),
     .standard = "auto",
     FROM("1"),
     TO("63"),
     .meaning = "The material that it touches, or `rigid`, for walls that are; auto: its like."},
    CHOICE(pair_law, law, NULL, .meaning = "Force law of a contact of the two."),
    MODULE_KEYS,
};
static const pair_law unknown_pair_law = {.law = SCREE_CHOICE_WRONG};
static const scree_section pair_law_table[] = {
    OPEN_TABLE("pairs", "The law of contacts of two materials.", pair_law_keys, scree_config_pair_law)};

typedef scree_config_contact contact;
static const scree_key contact_keys[] = {
    CHOICE(contact, law, NULL, .standard = "hertz_mindlin", .meaning = "Force law of a contact."),
    MODULE_KEYS,
    NUMBER(contact, reference_velocity, "m/s", .standard = "auto", ABOVE("0 m/s"), TO("1000 m/s"),
           .meaning = "v_R, to which slip speeds are referred; auto: 2 x strain rate x mean radius."),
    KEY(contact, pairs, SCREE_KEY_LIST, .standard = "[]", FROM("0"), TO("16"), .sections = pair_law_table,
        .section_count = 1, .count_offset = offsetof(contact, pair_count), .element_size = sizeof(pair_law),
        .initial = &unknown_pair_law,
        .meaning = "Pairs of materials whose contacts have another law, or other numbers of it; walls and plates count "
                   "by what they are made of."),
};

typedef scree_config_integrator integrator;
static const scree_key integrator_keys[] = {
    CHOICE(integrator, scheme, NULL, .standard = "velocity_verlet", .meaning = "Integration scheme."),
    NUMBER(
        integrator, step, "s", .standard = "auto", ABOVE("0 s"), TO("10 s"),
        .meaning =
            "Time step, the small one of a scheme that has two; auto: the largest is `step_fraction` of the critical "
            "step."),
    NUMBER(integrator, step_fraction, "1", .standard = "0.1", ABOVE("0"), TO("1"), .when = "step=auto",
           .meaning = "Largest step over critical step."),
};

typedef scree_config_boundary boundary;
static const scree_key boundary_keys[] = {
    CHOICE(boundary, periodic, periodics, .standard = "no",
           .meaning =
               "Directions in which the sample repeats itself. In the others there is what the boundary of a stage "
               "says: plates, unless it is chosen, or the `walls` of the case, or nothing (none)."),
    CHOICE(boundary, lateral, NULL, .standard = "pressure",
           .meaning = "What holds the sides, beside plates below and above, until a stage chooses its `boundary`. Not "
                      "asked for where the sample repeats itself."),
    INTEGER(boundary, every, .standard = "250", FROM("1"), TO("1e9"),
            .meaning = "Steps between two updates of the Delaunay boundary; the largest ones of a scheme with steps of "
                       "two sizes."),
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
};

typedef scree_config_stage stage;
static bool is_held(const scree_module *module)
{
    return module->numbers->held;
}

static const scree_key stage_keys[] = {
    {.name = "stage", .type = SCREE_KEY_CHOICE, .offset = offsetof(stage, kind), .meaning = "Kind of the stage."},
    KEY(stage, name, SCREE_KEY_WORD, .standard = "auto", FROM("1"), TO("63"),
        .meaning = "Name in the log and for --set; auto: the kind, numbered from 1 if there are several."),
    MODULE_KEYS,
    CHOICE(stage, boundary, boundaries, .standard = "auto", .fits = is_held,
           .meaning = "What holds the sample in this stage."),
    NUMBER(stage, friction, "1", .standard = "auto", FROM("0"), TO("10"), .fits = is_held,
           .meaning = "Friction in this stage, e.g. less while confining for a denser sample; auto: the material's."),
    SCHEDULE(
        stage, gravity, "m/s2", .standard = "auto", .components = 3, FROM("-1e6 m/s2"), TO("1e6 m/s2"), .fits = is_held,
        .meaning = "Gravity in this stage, or a table of it over the time since the stage began; auto: `gravity`."),
};

/// Some stages are not held, and have no key of it.
static const stage stage_before_reading = {.boundary = SCREE_CHOICE_AUTO, .gravity = {{.value = NAN}}};

typedef scree_config_selection selection;
static const scree_key selection_keys[] = {
    {.name = "select", .type = SCREE_KEY_CHOICE, .offset = offsetof(selection, kind), .meaning = "How they are found."},
    KEY(selection, name, SCREE_KEY_WORD, FROM("1"), TO("63"), .meaning = "Name, unique among the selections."),
    MODULE_KEYS,
};

typedef scree_config_load load;
static const scree_key load_keys[] = {
    {.name = "load", .type = SCREE_KEY_CHOICE, .offset = offsetof(load, kind), .meaning = "Kind of the load."},
    MODULE_KEYS,
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
    MODULE_KEYS,
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
static const scree_choice stability_choices[] = {
    {"stop", SCREE_STABILITY_STOPS, "a case with such a step is refused, a run stops with a checkpoint"},
    {"warn", SCREE_STABILITY_WARNS, "it goes on with a warning, as searches for a limit by runs need it"},
    {0},
};
static const scree_key guard_keys[] = {
    NUMBER(guard, overlap, "1", .standard = "20 %", .guard = true, ABOVE("0 %"), TO("100 %"),
           .meaning = "Largest overlap over the smaller radius."),
    NUMBER(guard, energy_growth, "1", .standard = "5 %", .guard = true, ABOVE("0 %"), TO("10000 %"),
           .meaning =
               "Largest residual of the energy ledger over all energy that there is and was: at the begin, turned "
               "over, stored now. Energy that grows without end tends to 100 %."),
    CHOICE(guard, stability, stability_choices, .standard = "stop", .guard = true,
           .meaning = "What a step or k_n/E above the limit of stability does: the estimated limit of the case, and of "
                      "bonds and particles that deform that of the specimen."),
};

static const scree_section material_table[] = {
    OPEN_TABLE("materials", "What particles and plates are made of.", material_keys, scree_config_material)};
static const scree_section particles_table[] = {
    OPEN_TABLE("particles", "Shape, number and sizes.", particles_keys, particles)};
static const scree_section contact_table[] = {
    OPEN_TABLE("contact", "Forces between touching particles.", contact_keys, contact)};
static const scree_section integrator_table[] = {
    OPEN_TABLE("integrator", "Motion in time.", integrator_keys, integrator)};
static const scree_section boundary_table[] = {
    OPEN_TABLE("boundary", "What surrounds the sample.", boundary_keys, boundary)};
static const scree_section stage_table[] = {OPEN_TABLE("stages", "What happens.", stage_keys, stage)};
static const scree_section selection_table[] = {
    OPEN_TABLE("selections", "Some of the particles.", selection_keys, selection)};
static const scree_section load_table[] = {OPEN_TABLE("loads", "What acts on the bodies.", load_keys, load)};
static const scree_section measure_table[] = {OPEN_TABLE("measure", "What is recorded.", measure_keys, measure)};
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
     .type = SCREE_KEY_SCHEDULE,
     .components = 3,
     .unit = "m/s2",
     .standard = "[0, 0]",
     FROM("-1e6 m/s2"),
     TO("1e6 m/s2"),
     .offset = offsetof(scree_config, gravity),
     .meaning =
         "Acceleration [x, y] or [x, y, z], or a table of it over the time of the run; the last axis is upwards."},
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
    KEY(scree_config, sources, SCREE_KEY_LIST, .standard = "[]", FROM("0"), TO("16"), .sections = scree_source_sections,
        .section_count = SCREE_SOURCE_SECTIONS, .count_offset = offsetof(scree_config, source_count),
        .element_size = sizeof(scree_config_source), .initial = &scree_source_before_reading,
        .meaning = "Where particles come from while a stage pours."),
    KEY(scree_config, selections, SCREE_KEY_LIST, .standard = "[]", FROM("0"), TO("32"), .sections = selection_table,
        .section_count = 1, .count_offset = offsetof(scree_config, selection_count), .element_size = sizeof(selection),
        .meaning = "Particles under a name, for what acts on some of them; found when a stage begins that needs them."),
    KEY(scree_config, loads, SCREE_KEY_LIST, .standard = "[]", FROM("0"), TO("16"), .sections = load_table,
        .section_count = 1, .count_offset = offsetof(scree_config, load_count), .element_size = sizeof(load),
        .meaning = "What acts on the bodies in all stages, beside contacts, boundary and gravity."),
    KEY(scree_config, stages, SCREE_KEY_LIST, FROM("1"), TO("100"), .sections = stage_table, .section_count = 1,
        .count_offset = offsetof(scree_config, stage_count), .element_size = sizeof(stage),
        .initial = &stage_before_reading, .meaning = "What happens, one stage after the other."),
    SECTION(measure, measure_table, .meaning = "What is recorded."),
    SECTION(output, output_table, .meaning = "What is written."),
    SECTION(guard, guard_table, .meaning = "When a run is stopped."),
    {.name = "quick",
     .type = SCREE_KEY_PATHS,
     .standard = "{}",
     .meaning = "Key path and value of everything that --quick changes."},
};

const scree_section scree_schema_core = TABLE("case", "A case file.", root_keys);
