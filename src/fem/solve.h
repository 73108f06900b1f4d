/// Running ccx on a deck, and reading what it prints. Private to src/fem/.
#ifndef SCREE_FEM_SOLVE_H
#define SCREE_FEM_SOLVE_H

#include "base/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/// Numbers of a deck are written with %.12e: ccx reads twenty characters of each, and drops the rest without a word.
///
/// Opens DIRECTORY/fem.inp for the deck, and lists all files that a solve leaves. Errors: SCREE_ERROR_IO.
scree_status scree_fem_deck_open(const char *directory, FILE **deck, scree_error *error) SCREE_MUST_USE;

/// Closes the deck and runs ccx on it. Errors: SCREE_ERROR_IO, with the line in which ccx says what is wrong.
scree_status scree_fem_deck_solve(const char *directory, FILE *deck, scree_error *error) SCREE_MUST_USE;

/// A set of nodes by their numbers, each with `shift` added: `*NSET, NSET=NAME` and its lines.
void scree_fem_deck_set(FILE *deck, const char *name, const int64_t *node, size_t count, int64_t shift);

/// A row of a table of fem.dat.
typedef struct scree_fem_row {
    const char *set; ///< name of the set of nodes
    double time;
    bool total;      ///< the force on all nodes of the set [N]; else the displacement of one [m]
    int64_t node;    ///< 0 for a total
    double value[3]; ///< components
} scree_fem_row;

/// Calls `visit` for each row of DIRECTORY/fem.dat, in its order. Errors: SCREE_ERROR_IO.
scree_status scree_fem_read(const char *directory, void (*visit)(void *user, const scree_fem_row *row), void *user,
                            scree_error *error) SCREE_MUST_USE;

#endif
