/// The table of verbs: what is asked of a run that is there.
#include "cli/verbs.h"

const scree_verb scree_results_verbs[] = {
    {
        .name = "get",
        .meaning = "print results of a run",
        .text =
            "With one name prints the bare value, for use in a shell; with several names, or none for all, prints "
            "lines "
            "of name and value. Numbers are SI and have as many digits as are needed to read back the same double; a "
            "value that does not exist is `nan`.",
        .argument = {{"DIR", "folder of a run", SCREE_VALUE_FOLDER, false, false},
                     {"NAME", "a result; all when none is given", SCREE_VALUE_RESULT, true, true}},
        .example = {{"scree get out", "all names and values"},
                    {"peak=$(scree get out peak_stress_ratio)", "one value into a shell variable"},
                    {"scree get out phi psi", "two lines of name and value"}},
        .status = {SCREE_ERROR_INPUT, SCREE_ERROR_IO},
        .function = scree_verb_get,
    },
    {
        .name = "measure",
        .meaning = "continuum averages of runs: stress, fabric, density, forces, the dip of a pile",
        .text =
            "Reads a snapshot of a finished run of discs, spheres or polygons and averages over elements (squares, in "
            "3D cubes) along horizontal cuts, on a grid with `--grid`, and with a smooth kernel with `--kernel`; "
            "beside these distributions of forces and friction, force chains, and roses of contacts. Grains count by "
            "their centres, and beside it by their exact parts in the element; elements that reach out of the sample "
            "also over their part inside it. With `--from` displacements and strains between two snapshots, with "
            "`elastic` "
            "also changes of stress and elastic constants.\n\n"
            "Several runs are an ensemble: means over them with 95 % bands (bootstrap over runs), and under piles the "
            "dip of the vertical pressure, 1 - its value on the axis over its largest, with its interval and p, a pile "
            "and its mirror image being one sample.\n\n"
            "A RUN may also be a file of grains: a LAMMPS or LIGGGHTS dump or data file, YADE's export, a table "
            "(as `prepare: {method: file}` reads them; tilted boxes, too). It needs `--case`, whose materials and law "
            "are theirs. Contacts are those of `--contacts`, with ids of grains and forces on the first (a second "
            "below 0: a wall), else those of overlaps under the law, without history: springs along contacts bear "
            "nothing then, and walls are not there. `--at #STEP` is a frame.\n\n"
            "Writes `values.csv`, `cuts.csv`, `map.csv`, `kernel.csv`, `forces.csv`, `friction.csv`, `rose.csv`, "
            "`sizes.csv`, `scatter.csv`, `dips.csv`, `summary.json` (for `scree get`) and figures; docs/output.md "
            "lists the columns, "
            "docs/theory/averages.md has the definitions. Stresses are tension positive, pressures the opposite.",
        .argument = {{"RUN", "folder of a finished run, or file of grains; several are an ensemble", SCREE_VALUE_FOLDER,
                      false, true}},
        .option = {{.name = "fields",
                    .value = "NAME,...",
                    .meaning = "density, coordination, stress, fabric, inertia, velocity, kinetic (stress of the "
                               "motion), elastic (with --from)",
                    .preset = "density,coordination,stress,fabric"},
                   {.name = "cuts",
                    .value = "N|HEIGHTS",
                    .meaning = "number of cuts, or their relative heights with commas, 0 lowest",
                    .preset = "5"},
                   {.name = "element",
                    .value = "GRAINS|PART|LENGTH",
                    .meaning = "grains in an element at the mean density, a part of all (10 %), or its side",
                    .preset = "150, a tenth of a sample below 1500"},
                   {.name = "points", .value = "N", .meaning = "places along a cut, odd", .preset = "41"},
                   {.name = "fit",
                    .value = "NAMES",
                    .meaning = "theories fitted to the mean stresses of three piles or more, with commas: ife, bcc, "
                               "fpa, osl, oriented, wedge; or to the response of layers to a load: flamant, "
                               "layer_smooth, layer_bonded, or layer for all three"},
                   {.name = "axis",
                    .value = "mass|apex|X",
                    .meaning = "about which cuts are symmetric: centre of mass, highest grain, or a position",
                    .preset = "mass"},
                   {.name = "grid",
                    .value = "NXxNY[xNZ]",
                    .meaning = "a map of so many elements, which may overlap; in 3D of two numbers the second is along "
                               "z, in the middle of y"},
                   {.name = "sizes",
                    .value = "N,...",
                    .meaning = "elements of so many grains about one position on the axis near the bottom, such as "
                               "5,10,20,50,100,200,400,800: how many grains make an average"},
                   {.name = "two-slopes",
                    .meaning = "--fit takes piles with a slope of their own on each side, all built alike, and wedges"},
                   {.name = "mirror", .meaning = "cuts of each run are means of it and of its mirror image"},
                   {.name = "kernel",
                    .value = "WIDTH",
                    .meaning = "smooth fields, at the points of --grid or 100x50 (50x50x50): radius of the support of "
                               "the kernel in mean diameters, or a length"},
                   {.name = "at",
                    .value = "WHEN",
                    .meaning = "start, end, #N (snapshot N), a STAGE (its last one), an axial strain, a time with its "
                               "unit; mean:STAGE or mean:N, the mean over its snapshots, or over the last N",
                    .preset = "end"},
                   {.name = "from", .value = "WHEN", .meaning = "displacements and strains from there to --at"},
                   {.name = "threads",
                    .letter = 't',
                    .value = "N",
                    .meaning = "that find elements and smooth fields",
                    .preset = "1"},
                   {.name = "output",
                    .letter = 'o',
                    .value = "DIR",
                    .meaning = "folder of tables and figures",
                    .preset = "RUN/measure, of several runs measure",
                    .kind = SCREE_VALUE_FOLDER},
                   {.name = "case",
                    .value = "CASE",
                    .meaning = "of files of grains: their materials and the law of their contacts"},
                   {.name = "set",
                    .value = "KEY=VALUE",
                    .meaning = "change one value of that case; may be repeated",
                    .repeatable = true},
                   {.name = "contacts",
                    .value = "FILE",
                    .meaning = "their contacts, a table or a local dump",
                    .preset = "those of overlaps"},
                   {.name = "contact-columns",
                    .value = "NAMES",
                    .meaning = "columns of that file: first,second,fx,fy,fz,x,y,z, - what is left out; "
                               "forces of one name are added",
                    .preset = "those that it names"},
                   {.name = "length-unit", .value = "UNIT", .meaning = "of those files, such as mm", .preset = "m"},
                   {.name = "time-unit", .value = "UNIT", .meaning = "the same", .preset = "s"},
                   {.name = "force-unit", .value = "UNIT", .meaning = "the same", .preset = "N"},
                   {.name = "no-figures", .meaning = "leave all figures out"}},
        .example = {{"scree measure out --fields stress,fabric,density --cuts 5 --element 150", "cuts through a pile"},
                    {"scree measure out --grid 100x50 --kernel 3", "maps of elements and of smooth fields"},
                    {"scree measure piles/* -o ensemble", "several piles, with bands and the dip"},
                    {"scree measure out --fields stress,fabric,elastic --from settle --at end",
                     "strains, changes of stress, elastic constants"},
                    {"scree measure drum --at mean:10 --fields density,velocity", "a mean over time"},
                    {"scree measure dump.lammpstrj --case periodic-shear --kernel 3", "grains of LAMMPS"}},
        .status = {SCREE_ERROR_INPUT, SCREE_ERROR_IO},
        .function = scree_verb_measure,
    },
    {
        .name = "export",
        .meaning = "write the snapshots of a run as a LAMMPS dump, for OVITO, or keep a run in little",
        .text =
            "A frame a snapshot, with id, type (the material, from 1), position, radius, velocity, spin and mark (0: a "
            "grain) of each body, and in the plane its angle; the time step is the number of the snapshot. A "
            "periodic cell is the box, tilted where it is sheared, and velocities are relative to its affine field. "
            "Polygons are written as discs of their radius. "
            "`prepare: {method: file}` reads such a file back.",
        .argument = {{"DIR", "folder of a run", SCREE_VALUE_FOLDER, false, false}},
        .option = {{.name = "stage",
                    .value = "STAGE",
                    .meaning = "only snapshots of this stage: name or kind",
                    .preset = "all"},
                   {.name = "output",
                    .letter = 'o',
                    .value = "FILE",
                    .meaning = "the dump",
                    .preset = "DIR/snapshots.lammpstrj"},
                   {.name = "contacts",
                    .value = "FILE",
                    .meaning = "their contacts, too, as a local dump: first, second (-1: a wall), force on the first, "
                               "point"},
                   {.name = "archive",
                    .value = "FOLDER",
                    .meaning = "in place of a dump a new folder with case, results, series and the last snapshot (and "
                               "that of --stage), in 24 bits, without what a run would go on from: averages and "
                               "ensembles read it as they read the run"}},
        .example = {{"scree export out", "all snapshots"},
                    {"scree export out --stage compress -o compress.lammpstrj", "those of one stage"},
                    {"scree export pile --archive kept/pile", "what averages need, some hundred times smaller"}},
        .status = {SCREE_ERROR_INPUT, SCREE_ERROR_IO},
        .function = scree_verb_export,
    },
    {
        .name = "plot",
        .meaning = "draw the figures of a run again",
        .text = "Draws charts and scenes as SVG and PNG into DIR/figures and prints the path of each. The gnuplot "
                "script and "
                "the data of a chart are kept beside it. A figure for which the run lacks a column, a snapshot or "
                "another result is left out, with the reason; when it was asked for with `--only`, that is an error.",
        .argument = {{"DIR", "folder of a run", SCREE_VALUE_FOLDER, false, false}},
        .option =
            {{.name = "list",
              .letter = 'l',
              .meaning = "list the figures of the run, one line each, the usual ones with a *, draw nothing"},
             {.name = "all", .meaning = "draw all figures that `--list` names"},
             {.name = "only",
              .value = "NAME,...",
              .meaning = "draw the figures of these names",
              .preset = "the usual ones, at most some ten",
              .kind = SCREE_VALUE_FIGURE},
             {.name = "y",
              .value = "COLUMN,...",
              .meaning = "draw these columns of series.csv, all of one unit, in one chart"},
             {.name = "x", .value = "COLUMN", .meaning = "over this column", .preset = "time"},
             {.name = "stage",
              .value = "STAGE,...",
              .meaning = "only rows of these stages: name, kind or number",
              .preset = "all rows"},
             {.name = "scene",
              .value = "FIELD",
              .meaning = "draw the bodies of one snapshot, coloured by speed, velocity_x, displacement, rotation, "
                         "spin, radius, coordination, force, birth, ...; forces: the force network"},
             {.name = "at",
              .value = "WHEN",
              .meaning = "of the scene: start, end, #N for snapshot N, an axial strain, a time with its unit, a "
                         "stage for its end",
              .preset = "end"},
             {.name = "movie",
              .value = "FIELD",
              .meaning =
                  "draw the scenes of all snapshots in one frame, as PNG files and, where ffmpeg is installed, as "
                  "one mp4"},
             {.name = "section", .meaning = "cut spheres through their mean centre in place of the view from outside"}},
        .example = {{"scree plot out", "after a run with --no-figures"},
                    {"scree plot out --list", "what there is to draw"},
                    {"scree plot out --only stress-ratio,packing-end", "two figures"},
                    {"scree plot out --x axial_strain --y kinetic,elastic_normal --stage compress",
                     "a chart of one's own"},
                    {"scree plot out --scene speed --at '1 %'", "a scene of one's own"},
                    {"scree plot out --movie displacement", "all snapshots one after the other"}},
        .status = {SCREE_ERROR_INPUT, SCREE_ERROR_IO},
        .function = scree_verb_plot,
    },
};
const size_t scree_results_verbs_count = sizeof scree_results_verbs / sizeof scree_results_verbs[0];
