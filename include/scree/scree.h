/// Scree: a discrete-element laboratory for granular matter. The public C interface: opaque handles, errors as values,
/// read-only views. The command line uses nothing else; the functions here are all that the shared library exports. All
/// values are SI. The contract (handles, threads, how long a view is valid, what counts as work from outside) is in
/// docs/library.md, programs to begin with in examples/c/.
///
///     #include <scree/scree.h>
///
///     scree_case *c; scree_problems *problems; scree_simulation *s; scree_error error; bool done;
///     if (scree_case_read("biaxial.yaml", NULL, &c, &problems)) { ... scree_problems_get(problems, 0) ... }
///     if (scree_simulation_create(c, 1, &s, &error)) ...
///     do scree_simulation_advance(s, 1000, &done, &error) ... while (!done);
#ifndef SCREE_H
#define SCREE_H

#include <scree/case.h>
#include <scree/error.h>
#include <scree/keeper.h>
#include <scree/measure.h>
#include <scree/run.h>
#include <scree/simulation.h>
#include <scree/specimen.h>
#include <scree/sweep.h>
#include <scree/theory.h>

#ifdef __cplusplus
extern "C" {
#endif

#define SCREE_VERSION "0.1.0"

/// Version text, with the compiler and the instruction set that the kernels use on this machine.
SCREE_API const char *scree_version(void);

/// The commit that was built, with a "+" where tracked files differed from it; "" when the sources were no checkout.
SCREE_API const char *scree_commit(void);

/// Chooses the instruction set of the kernels, "v2", "v3" or "v4" (x86-64-v2 and so on), for everything that this
/// process computes from now on; NULL or "auto": the best that this processor has, as without a call. Results have the
/// same bits with each. The library reads no environment variable; the program `scree` calls this with SCREE_ISA.
/// Errors: SCREE_ERROR_INPUT: no such word, or this processor does not have it; nothing is changed then.
SCREE_API scree_status scree_instruction_set_choose(const char *name, scree_error *error);

/// Nearest of `names` to `text` (Damerau-Levenshtein, at most a third of the letters wrong), or NULL.
SCREE_API const char *scree_nearest(const char *text, const char *const *names, size_t count);

#ifdef __cplusplus
}
#endif
#endif
