/// Names of what a run directory holds.
#ifndef SCREE_IO_FILE_NAMES_H
#define SCREE_IO_FILE_NAMES_H

#define SCREE_FILE_CASE              "case.yaml"
#define SCREE_FILE_SUMMARY           "summary.json"
#define SCREE_FILE_SERIES            "series.csv"
#define SCREE_FILE_CELLS             "cells.csv"
#define SCREE_FILE_BANDS             "bands.csv"
#define SCREE_FILE_BREAKS            "breaks.csv"
#define SCREE_FILE_RECEIVERS         "receivers.csv"
#define SCREE_FILE_PLACES            "receiver-places.csv"
#define SCREE_FILE_ARRIVALS          "arrivals.csv"
#define SCREE_FILE_DISPERSION        "dispersion.csv"
#define SCREE_FILE_OUTLINE           "outline.csv"
#define SCREE_FILE_RESPONSE          "response.csv"
#define SCREE_FILE_RESPONSE_DEPTHS   "response-depths.csv"
#define SCREE_FILE_RESPONSE_CONTACTS "response-contacts.csv"
#define SCREE_FILE_FEM_STRAIN        "fem-strain.csv"
#define SCREE_FILE_FEM_FORCE         "fem-force.csv"
#define SCREE_FILE_FEM_AXIS          "fem-axis.csv"
#define SCREE_FILE_RUN               "run.h5"
#define SCREE_FILE_RUN_WHOLE         "run.h5.whole" ///< run.h5 while it is gathered
#define SCREE_FILE_LOG               "log.txt"
#define SCREE_FOLDER_FIGURES         "figures"
#define SCREE_FOLDER_PARAVIEW        "paraview"
#define SCREE_FOLDER_PARTS           "parts" ///< snapshots and checkpoints of a run that has not ended, linked from run.h5

#endif
