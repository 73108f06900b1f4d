/// Continuum averages of finished runs: fields over elements along cuts and on a grid, smooth fields, statistics of
/// forces, the dip under a pile; of one run or of an ensemble of them.
#ifndef SCREE_MEASURE_H
#define SCREE_MEASURE_H

#include <scree/api.h>
#include <scree/case.h>
#include <scree/error.h>

#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/// What is measured, as on the command line (`scree measure --help`); NULL or 0: as there without the option.
typedef struct scree_measure_options {
    const char *fields;  ///< "density,coordination,stress,fabric,inertia,velocity,elastic,kinetic", or some of them;
                         ///< elastic needs `from`
    const char *cuts;    ///< "5", a number of cuts, or "0,0.25,0.5", their relative heights
    const char *element; ///< "150", grains in an element, "10 %", a part of all, or "30 mm", its side
    const char *grid;    ///< "100x50", points of a map; in 3D x and z in the middle of y, or "20x20x20"
    const char *kernel;  ///< "15 mm", radius of the support of smooth fields, or "3", in mean diameters
    const char *sizes;   ///< "5,10,20,50,100,200,400,800", grains of elements about one place: how many make an average
    const char *at; ///< "start", "end", "#12", a snapshot, the name of a stage, "10 %" of axial strain; "mean:STAGE" or
                    ///< "mean:10", mean over its snapshots, or over the last ones
    const char *from;   ///< the same but for means: displacements and strains from there on
    const char *fit;    ///< theories of piles that are fitted to the mean stresses, "ife,bcc,fpa,osl,wedge", or of
                        ///< layers to the mean response to a load, "flamant,layer_smooth,layer_bonded", "layer"
    const char *axis;   ///< "mass", "apex", or a place, "0 mm"
    long points;        ///< places along a cut
    int threads;        ///< that find elements and smooth fields
    bool two_slopes;    ///< fits do not fold piles about their axis: left and right slopes of their own
    bool mirror;        ///< cuts are means of each run and its mirror image about the axis
    const char *output; ///< folder; "measure" in that of the run, or where it is called with several runs
    bool no_figures;
    // of files of grains
    const scree_case *sample_case; ///< its materials and law are those of the grains
    const char *contacts;          ///< file of their contacts; NULL: overlaps make them
    const char *contact_columns;   ///< "first,second,fx,fy,fz,x,y,z": names of its columns, - what is left out
    const char *length_unit, *time_unit, *force_unit; ///< "1 mm", of one unit of the files; SI
    void (*message)(void *user, const char *line);    ///< what was found, line by line; may be NULL
    void *user;
} scree_measure_options;

/// Whether `scree_measure` could read these options. Errors: SCREE_ERROR_INPUT with the option as field.
SCREE_API scree_status scree_measure_check(const scree_measure_options *options, scree_error *error);

/// Measures the runs in these folders, or the grains in these files (of Scree, LAMMPS, LIGGGHTS, YADE, or tables),
/// which need a `sample_case`, and writes tables, values and figures (docs/output.md, "Measured averages"). Several
/// runs are an ensemble: means with bootstrap bands over them. Errors: SCREE_ERROR_INPUT with the option as field;
/// SCREE_ERROR_IO; memory.
SCREE_API scree_status scree_measure(const char *const *runs, size_t count, const scree_measure_options *options,
                                     scree_error *error);

#ifdef __cplusplus
}
#endif
#endif
