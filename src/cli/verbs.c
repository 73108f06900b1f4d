/// The table of verbs.
#include "cli/verbs.h"

#include <string.h>

const char scree_purpose[] =
    "A discrete-element laboratory for granular matter: prepares an assembly of grains, loads it through a choice of "
    "boundaries, and turns its contacts into stress, strain and figures.";

const scree_exit_status scree_exit_statuses[] = {
    {SCREE_OK, "done"},
    {SCREE_ERROR_INPUT, "the input is wrong: the case, an option, a name, or a folder that is in use"},
    {SCREE_ERROR_GUARD, "a physics guard stopped the run; members of a sweep failed"},
    {SCREE_ERROR_IO, "reading or writing failed, or memory ran out"},
    {SCREE_INTERRUPTED, "interrupted by a signal, after a checkpoint"},
    {0, NULL},
};

const scree_verb_example scree_environment[] = {
    {"NO_COLOR", "not empty: no colours, and no line that is rewritten"},
    {"SCREE_ISA", "v2, v3 or v4: compute with the instructions of x86-64-v2, -v3 or -v4 in place of the best that this "
                  "processor has; the results do not depend on it"},
    {"SCREE_PIXELS", "long side of PNG figures in pixels, 200 to 20000 (2000, of charts 2160, where it is not set)"},
    {NULL, NULL},
};

const scree_verb_option scree_common_options[] = {
    {.name = "help", .letter = 'h', .meaning = "print this help and stop"},
    {0},
};

#define OPTION_SET                                                                                                     \
    {                                                                                                                  \
        .name = "set", .value = "KEY=VALUE",                                                                           \
        .meaning = "change one value of the case, such as `--set materials.0.friction=0.3`; may be repeated",          \
        .repeatable = true, .kind = SCREE_VALUE_KEY                                                                    \
    }
#define OPTION_QUICK                                                                                                   \
    {                                                                                                                  \
        .name = "quick", .meaning = "apply the `quick` section of the case: the same physics, smaller"                 \
    }

#define OPTION_AT                                                                                                      \
    {                                                                                                                  \
        .name = "at", .value = "STAGE", .meaning = "run the case until STAGE begins",                                  \
        .preset = "the first stage that takes steps"                                                                   \
    }
#define OPTION_YOUNG                                                                                                   \
    {                                                                                                                  \
        .name = "young-modulus", .value = "PA",                                                                        \
        .meaning = "as if particles were elastic with this modulus; discs in plane strain"                             \
    }
#define OPTION_POISSON                                                                                                 \
    {                                                                                                                  \
        .name = "poisson-ratio", .value = "NU", .meaning = "and this Poisson's ratio", .preset = "0"                   \
    }

#define OPTION_QUIET                                                                                                   \
    {                                                                                                                  \
        .name = "quiet", .letter = 'q', .meaning = "no progress, warnings and errors only"                             \
    }
#define OPTION_REALISATIONS                                                                                            \
    {                                                                                                                  \
        .name = "realisations", .value = "N", .meaning = "samples at each point, which differ in their seed",          \
        .preset = "as the sweep says"                                                                                  \
    }
#define OPTION_JOBS                                                                                                    \
    {                                                                                                                  \
        .name = "jobs", .letter = 'j', .value = "N", .meaning = "members at the same time", .preset = "one a core"     \
    }
#define OPTION_MEMBER_THREADS                                                                                          \
    {                                                                                                                  \
        .name = "threads", .letter = 't', .value = "N", .meaning = "threads of each member", .preset = "1"             \
    }
#define OPTION_MEMBER_RANKS                                                                                            \
    {                                                                                                                  \
        .name = "ranks", .value = "N",                                                                                 \
        .meaning = "processes of each member, each with its threads, started by `mpirun`; needs a program that is "    \
                   "built with MPI",                                                                                   \
        .preset = "1"                                                                                                  \
    }
#define OPTION_RETRY                                                                                                   \
    {                                                                                                                  \
        .name = "retry", .meaning = "run failed members again"                                                         \
    }
#define OPTION_FORCE_MEMBERS                                                                                           \
    {                                                                                                                  \
        .name = "force", .letter = 'f', .meaning = "run members anew whose folder holds another case"                  \
    }
#define OPTION_NO_FIGURES                                                                                              \
    {                                                                                                                  \
        .name = "no-figures", .meaning = "leave all figures out"                                                       \
    }

static const scree_verb case_verbs[] = {
    {
        .name = "list",
        .meaning = "list the built-in cases, one line each",
        .text = "Prints the name and the meaning of every case that is built in. `scree new` turns one into a file to "
                "edit, "
                "`scree run` takes its name in place of a file.",
        .option = {{.name = "sweeps", .meaning = "list the built-in sweeps, which repeat published experiments"}},
        .example = {{"scree list", "what there is"}},
        .status = {SCREE_ERROR_IO},
        .function = scree_verb_list,
    },
    {
        .name = "new",
        .meaning = "print a built-in case as a commented file to edit",
        .text = "Prints the case file to standard output, or writes it to a file that does not exist yet.",
        .argument = {{"NAME", "a built-in case; `scree list` names them", SCREE_VALUE_BUILTIN, false, false}},
        .option = {{.name = "output",
                    .letter = 'o',
                    .value = "FILE",
                    .meaning = "write to FILE",
                    .preset = "standard output",
                    .kind = SCREE_VALUE_FILE},
                   {.name = "force", .letter = 'f', .meaning = "replace FILE when it exists"}},
        .example = {{"scree new biaxial > my.yaml", "a biaxial compression test to edit"}},
        .status = {SCREE_ERROR_INPUT, SCREE_ERROR_IO},
        .function = scree_verb_new,
    },
    {
        .name = "check",
        .meaning = "check a case, or the folder of a run",
        .text =
            "Prints the resolved case, every default written out, and below it as comments: the numbers of particles "
            "and steps, the quasistatic and size coefficients phi and psi, the critical time step, and an estimate of "
            "time (processor time of one thread: stepping, output, figures) and peak memory, for which the case is set "
            "going for a moment. Of bonds and of particles that deform also the limits of their specimen, if it stands "
            "before the first step, for which the sample is prepared. The output is a case file again.\n\n"
            "`--ranks` adds what one of N processes takes (`mpirun -n N scree run`): its particles and those of others "
            "near them, time, memory, what it sends; a case that cannot be spread over processes is refused.\n\n"
            "Everything that is wrong with a case is reported at once, as `file:line:column: key: what is wrong "
            "(accepted: what would be right)`.\n\n"
            "Given the folder of a run, says of each file in it, and of each checkpoint and snapshot, whether it is "
            "whole, and from which the run can go on (`scree run --restart`). Nothing is changed. The exit status is 4 "
            "when something is damaged.",
        .argument = {{"CASE", "a case file, the name of a built-in case, or the folder of a run", SCREE_VALUE_CASE,
                      false, false}},
        .option = {OPTION_SET,
                   OPTION_QUICK,
                   {.name = "ranks", .value = "N", .meaning = "also time and memory of one of N processes"}},
        .example = {{"scree check my.yaml", "before a long run"},
                    {"scree check big.yaml --ranks 64", "before one on several machines"},
                    {"scree check biaxial --set stages.compress.rate=1e-3", "how much slower, and how quasistatic"},
                    {"scree check out", "what is whole in a folder, and from where it can go on"}},
        .status = {SCREE_ERROR_INPUT, SCREE_ERROR_IO},
        .function = scree_verb_check,
    },
    {
        .name = "stability",
        .meaning = "print the steps and stiffnesses that a specimen bears",
        .text =
            "Takes the specimen of a case as it stands when its first stage that takes steps begins, or as the newest "
            "checkpoint in the folder of a run has it, and prints what explicit schemes bear: the critical step from "
            "the eigenvalues of all its contacts, dashpots counted, and estimates from single bodies beside it. "
            "`--output` "
            "draws the fastest mode: movements as arrows, turning as colours, of spheres a cut.\n\n"
            "For elastic particles also: the spectral radius of the iteration of forces, the largest k_n / E_p, those "
            "of regular lattices, and the critical steps with the strain of the last forces (explicit), relaxed, and "
            "solved for in every step (implicit). Lines are name, value, unit, meaning; docs/theory/ddem.md has the "
            "derivations. Contacts that slide count as if they stuck; forces that turn with a contact do not count.",
        .argument = {{"CASE", "a case file, the name of a built-in case, or the folder of a run", SCREE_VALUE_CASE,
                      false, false}},
        .option = {OPTION_SET,
                   OPTION_QUICK,
                   OPTION_AT,
                   OPTION_YOUNG,
                   OPTION_POISSON,
                   {.name = "output",
                    .letter = 'o',
                    .value = "FILE",
                    .meaning = "draw the fastest mode, as FILE.svg and FILE.png",
                    .kind = SCREE_VALUE_FILE}},
        .example = {{"scree stability my.yaml", "before a run"},
                    {"scree stability out --young-modulus 2e11 --poisson-ratio 0.35",
                     "a finished run, as if its particles were elastic"}},
        .status = {SCREE_ERROR_INPUT, SCREE_ERROR_GUARD, SCREE_ERROR_IO},
        .function = scree_verb_stability,
    },
    {
        .name = "moduli",
        .meaning = "print the elastic moduli of a specimen",
        .text =
            "Takes a specimen as `scree stability` does, periodic in all directions or filling a box, imposes each "
            "component of a mean strain (on a box by its outermost particles, whose spins are free), lets particles "
            "find their places, and prints the elasticity tensor: its components C_ijkl, the "
            "nearest isotropic moduli, how far from isotropic and from symmetric it is, the fabric of the contacts, "
            "and for comparison the moduli if all particles followed the mean strain (Voigt). Nothing is run but what "
            "leads to the specimen. Contacts stay as they are: none opens, closes or slides. Of a box also E and nu of "
            "a uniaxial test along each axis, between smooth plates, the sides free, and K between smooth plates all "
            "around, over the areas between the outermost surfaces.\n\n"
            "In 2D the moduli are those of the plane: K of areas, K = E / (2 (1 - nu)). Lines are name, value, unit, "
            "meaning.",
        .argument = {{"CASE", "a case file, the name of a built-in case, or the folder of a run", SCREE_VALUE_CASE,
                      false, false}},
        .option = {OPTION_SET, OPTION_QUICK, OPTION_AT, OPTION_YOUNG, OPTION_POISSON},
        .example = {{"scree moduli out", "of a run as it stands"},
                    {"scree moduli periodic-shear --at deform", "before it is sheared"}},
        .status = {SCREE_ERROR_INPUT, SCREE_ERROR_GUARD, SCREE_ERROR_IO},
        .function = scree_verb_moduli,
    },
};

static const scree_verb run_verbs[] = {
    {
        .name = "run",
        .meaning = "run a case into a folder of results, or continue a run",
        .text =
            "Runs a case file; where there is no file of that name, the built-in case of that name. The folder of "
            "results "
            "holds `case.yaml` (resolved), `summary.json` (named results), `series.csv` (time series), `run.h5` "
            "(snapshots, contacts, checkpoints), `figures/`, `paraview/` and `log.txt`.\n\n"
            "A folder that holds another run is refused unless `--force` is given; then the files that the old run "
            "listed in `files.txt` are removed, and nothing else. While a run goes on its folder is locked: a second "
            "run, a restart or `scree plot` there ends at once and says who holds it.\n\n"
            "Progress goes to standard error: one line that is rewritten on a terminal, plain lines every ten seconds "
            "elsewhere. The first interrupt (Ctrl-C, SIGTERM; SIGUSR1, SIGHUP, SIGXCPU) stops the run after a "
            "checkpoint, a "
            "second "
            "Ctrl-C or SIGTERM ends it at once. `scree run --restart DIR` continues a run that was stopped or killed, "
            "bit for bit.",
        .argument = {{"CASE", "a case file, or the name of a built-in case; none with --restart", SCREE_VALUE_CASE,
                      true, false}},
        .option = {{.name = "output",
                    .letter = 'o',
                    .value = "DIR",
                    .meaning = "folder of results",
                    .preset = "out",
                    .kind = SCREE_VALUE_FOLDER},
                   OPTION_SET,
                   OPTION_QUICK,
                   {.name = "threads",
                    .letter = 't',
                    .value = "N",
                    .meaning = "most threads; fewer work while the machine is busy; the results do not depend on it",
                    .preset = "one for every 4000 bodies"},
                   {.name = "balance",
                    .value = "WHAT",
                    .meaning = "with mpirun: processes share the sample by `counts` of bodies and contacts, or by the "
                               "`time` that their parts have taken; the results do not depend on it",
                    .preset = "counts"},
                   {.name = "force", .letter = 'f', .meaning = "replace the run that DIR holds"},
                   {.name = "no-figures", .meaning = "leave the figures out; `scree plot` draws them later"},
                   {.name = "restart",
                    .value = "DIR",
                    .meaning = "continue the run in DIR from its newest checkpoint",
                    .kind = SCREE_VALUE_FOLDER},
                   {.name = "from",
                    .value = "SNAPSHOT",
                    .meaning = "with --restart: continue from this snapshot, a number or `latest`, and drop what came "
                               "after it"},
                   {.name = "after",
                    .value = "DIR",
                    .meaning = "begin behind the last stage that the case has in common with the run in DIR and that "
                               "has ended there, with its rows and snapshots",
                    .kind = SCREE_VALUE_FOLDER},
                   OPTION_QUIET},
        .example = {{"scree run biaxial --quick -o out", "a built-in case in a minute"},
                    {"scree run my.yaml -o out --set stages.compress.rate=1e-2 --threads 2", "one value changed"},
                    {"scree run --restart out", "continue after an interrupt"},
                    {"scree run longer.yaml --after out -o longer", "the same case with stages added or changed"}},
        .status = {SCREE_ERROR_INPUT, SCREE_ERROR_GUARD, SCREE_ERROR_IO, SCREE_INTERRUPTED},
        .alone = true,
        .together = true,
        .function = scree_verb_run,
    },
    {
        .name = "bisect",
        .meaning = "find the limit of a number of a case by runs, or the value that gives a result",
        .text =
            "Runs a case with values of one of its numbers until it is known between which two of them runs cease to "
            "stand: by bisection, each run a process of its own. A run stands if it comes to its end and its result "
            "`--measure` is `--below` one limit, and `--above` another; one that a guard stops does not. Limits of "
            "stability stop none of them beforehand (`guard.stability: warn`). With `--target` it searches for the "
            "value "
            "at which the result is that: a friction of confinement for a solid fraction, say.\n\n"
            "The folder has the runs (`runs/`), a row of each (`bisection.csv`), and in `summary.json` the results of "
            "the last run that stood with `limit`, `limit_stands`, `limit_fails`, `limit_runs` (SI units). Called "
            "again it goes on with what is there. A sweep does it at every point of its grid (`bisect:` in its file).",
        .argument = {{"CASE", "a case file, or the name of a built-in case", SCREE_VALUE_CASE, false, false}},
        .option =
            {{.name = "output",
              .letter = 'o',
              .value = "DIR",
              .meaning = "folder of the search",
              .preset = "out",
              .kind = SCREE_VALUE_FOLDER},
             OPTION_SET,
             OPTION_QUICK,
             {.name = "key", .value = "KEY", .meaning = "path of the number, such as integrator.step"},
             {.name = "from", .value = "VALUE", .meaning = "one end, with its unit"},
             {.name = "to", .value = "VALUE", .meaning = "the other end"},
             {.name = "tolerance",
              .value = "NUMBER",
              .meaning = "distance of the ends at which it is over, relative",
              .preset = "0.001"},
             {.name = "measure", .value = "RESULT", .meaning = "result of a run by which it stands"},
             {.name = "below", .value = "NUMBER", .meaning = "the result of a run that stands is below this (SI)"},
             {.name = "above", .value = "NUMBER", .meaning = "the result of a run that stands is above this (SI)"},
             {.name = "target",
              .value = "NUMBER",
              .meaning = "what the result has to be (SI), within the tolerance; in place of --below and --above"},
             {.name = "curve", .value = "COLUMN", .meaning = "draw this column of the runs near the limit over time"},
             OPTION_MEMBER_THREADS,
             OPTION_NO_FIGURES,
             {.name = "force", .letter = 'f', .meaning = "replace the search of another case in DIR"},
             OPTION_QUIET},
        .example = {{"scree bisect ddem-stability -o step --key integrator.step --from 200ns --to 400ns "
                     "--measure kinetic --below 1e-3 --above=-1e-3",
                     "the largest step that stands"},
                    {"scree bisect confine.yaml -o find --key stages.confine.friction --from 0.01 --to 0.5 --measure "
                     "solid_fraction --target 0.83",
                     "friction that confines to a solid fraction; scree run --after goes on"}},
        .status = {SCREE_ERROR_INPUT, SCREE_ERROR_IO, SCREE_INTERRUPTED},
        .alone = true,
        .function = scree_verb_bisect,
    },
    {
        .name = "sweep",
        .meaning = "run a grid of parameters and realisations, with means and figures",
        .text =
            "Runs every member of a sweep (a combination of parameters and a seed) as a process of its own, as many at "
            "once as there are cores, and then collects them: `members.csv` (a row a member), `table.csv` (a row a "
            "point of the grid, means with confidence intervals), `curves/` (averaged curves) and `figures/`. Members "
            "have figures of their own where the sweep sets output.figures.\n\n"
            "A second call does what is missing: finished members are left as they are, interrupted ones are "
            "continued from their checkpoints, failed ones stay failed unless `--retry` is given. A member that fails "
            "does not keep the others from being run; the exit status is then 3. The first interrupt stops all members "
            "after a checkpoint.\n\n"
            "`--slurm` writes a script for a job array in place of running anything: its tasks call `--member`, and "
            "`--collect` comes after them. With `--ranks` each task has so many processes.",
        .argument = {{"SWEEP", "a sweep file, or the name of a built-in sweep", SCREE_VALUE_SWEEP, false, false}},
        .option = {{.name = "output",
                    .letter = 'o',
                    .value = "DIR",
                    .meaning = "folder of the sweep",
                    .preset = "out",
                    .kind = SCREE_VALUE_FOLDER},
                   OPTION_SET,
                   OPTION_QUICK,
                   OPTION_REALISATIONS,
                   OPTION_JOBS,
                   OPTION_MEMBER_THREADS,
                   OPTION_MEMBER_RANKS,
                   OPTION_RETRY,
                   OPTION_FORCE_MEMBERS,
                   OPTION_NO_FIGURES,
                   {.name = "dry-run",
                    .letter = 'n',
                    .meaning = "list the members as command lines, tell what they will cost, run nothing"},
                   {.name = "slurm",
                    .value = "FILE",
                    .meaning = "write a SLURM job array script, run nothing",
                    .kind = SCREE_VALUE_FILE},
                   {.name = "member", .value = "N", .meaning = "run one member, numbered from 0, and do not collect"},
                   {.name = "collect", .meaning = "make tables, curves and figures of what is there, run nothing"},
                   OPTION_QUIET},
        .example = {{"scree sweep friction.yaml -o friction", "all members, then tables and figures"},
                    {"scree sweep friction.yaml -o friction --realisations 10", "more realisations, beside those done"},
                    {"scree sweep friction.yaml -o friction --slurm friction.sh", "a job array for a cluster"}},
        .status = {SCREE_ERROR_INPUT, SCREE_ERROR_GUARD, SCREE_ERROR_IO, SCREE_INTERRUPTED},
        .alone = true,
        .function = scree_verb_sweep,
    },
    {
        .name = "reproduce",
        .meaning = "repeat the published experiments, and compare with their sources",
        .text = "Runs every built-in sweep into a folder of its own below DIR, continuing what is missing as `scree "
                "sweep` does, and writes `DIR/reproduction.md`. Without `--full` the quick forms are run: smaller "
                "samples, and a larger but still small quasistatic number; sweeps that judge no statement in this form are "
                "left out, which is told, unless `--only` asks for them.",
        .option = {{.name = "output",
                    .letter = 'o',
                    .value = "DIR",
                    .meaning = "folder of the sweeps",
                    .preset = "out-reproduce/quick or out-reproduce/full",
                    .kind = SCREE_VALUE_FOLDER},
                   {.name = "full", .meaning = "the sources' own numbers: hours"},
                   {.name = "only", .value = "NAME", .meaning = "run one built-in sweep", .kind = SCREE_VALUE_SWEEP},
                   OPTION_REALISATIONS,
                   OPTION_JOBS,
                   OPTION_MEMBER_THREADS,
                   OPTION_RETRY,
                   OPTION_FORCE_MEMBERS,
                   OPTION_NO_FIGURES,
                   OPTION_QUIET},
        .example = {{"scree reproduce", "all quick forms"},
                    {"scree reproduce --full --only triaxial", "one experiment with the source's numbers"}},
        .status = {SCREE_ERROR_INPUT, SCREE_ERROR_GUARD, SCREE_ERROR_IO, SCREE_INTERRUPTED},
        .alone = true,
        .function = scree_verb_reproduce,
    },
    {
        .name = "report",
        .meaning = "compare results with what the published sources state",
        .text =
            "Writes the reproduction page as Markdown: every statement of the sources with its value, the value "
            "found with its confidence interval, and whether it agrees, differs or is undecided. The runs are "
            "looked for in the folders given: folders of runs, of sweeps, or folders that hold such. A statement "
            "whose runs are not there is `not run`. Where FILE is there and a case rests on more realisations in it "
            "than the folders hold, its section stays (remove FILE to begin anew). Statements of your own sources are "
            "judged in the same way "
            "(`--statements`).",
        .argument = {{"DIR", "folder of runs or sweeps", SCREE_VALUE_FOLDER, false, true}},
        .option = {{.name = "output",
                    .letter = 'o',
                    .value = "FILE",
                    .meaning = "write to FILE",
                    .preset = "standard output",
                    .kind = SCREE_VALUE_FILE},
                   {.name = "statements",
                    .letter = 's',
                    .value = "FILE",
                    .meaning = "a table of statements, or the name of a built-in one; may be repeated",
                    .preset = "all built-in ones",
                    .kind = SCREE_VALUE_FILE,
                    .repeatable = true}},
        .example = {{"scree report out-reproduce/quick out-reproduce/full -o docs/reproduction.md", "the page of both "
                                                                                                    "forms"}},
        .status = {SCREE_ERROR_INPUT, SCREE_ERROR_IO},
        .function = scree_verb_report,
    },
};

static const scree_verb last_verbs[] = {
    {
        .name = "help",
        .meaning = "print help, the man page, shell completion or the case reference",
        .text = "Without options prints what `scree --help` or `scree VERB --help` prints.",
        .argument = {{"VERB", "a verb of this table, of one or two words", SCREE_VALUE_VERB, true, true}},
        .option = {{.name = "man", .meaning = "print the man page (roff)"},
                   {.name = "completion", .value = "SHELL", .meaning = "print completion for SHELL, which is `bash`"},
                   {.name = "case-reference", .meaning = "print the reference of case files (Markdown)"}},
        .example = {{"scree help run", "the same as scree run --help"},
                    {"source <(scree help --completion bash)", "completion in this shell"}},
        .status = {SCREE_ERROR_INPUT, SCREE_ERROR_IO},
        .function = scree_verb_help,
    },
};

// ---- the table ---------------------------------------------------------------------------------------------------

#define ROWS(table) (sizeof(table) / sizeof(table)[0])

const scree_verb *scree_verb_at(size_t number)
{
    if (number < ROWS(case_verbs)) return &case_verbs[number];
    number -= ROWS(case_verbs);
    if (number < scree_theory_verbs_count) return &scree_theory_verbs[number];
    number -= scree_theory_verbs_count;
    if (number < ROWS(run_verbs)) return &run_verbs[number];
    number -= ROWS(run_verbs);
    if (number < scree_results_verbs_count) return &scree_results_verbs[number];
    number -= scree_results_verbs_count;
    return number < ROWS(last_verbs) ? &last_verbs[number] : NULL;
}

const scree_verb *scree_verb_find(const char *name)
{
    size_t k = 0;
    while (scree_verb_at(k) && strcmp(scree_verb_at(k)->name, name) != 0) k++;
    return scree_verb_at(k);
}

const char *scree_exit_status_meaning(int status)
{
    const scree_exit_status *row = scree_exit_statuses;
    while (row->meaning && row->status != status) row++;
    return row->meaning;
}
