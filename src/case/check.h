/// From the tree to the config: types, units, ranges, unknown and unused keys (check.c), one value (value.c), rules
/// that tie several keys together (rules.c). Private to src/case/.
#ifndef SCREE_CASE_CHECK_H
#define SCREE_CASE_CHECK_H

#include "case/problems.h"
#include "case/schema.h"

#include <stdio.h>

enum { SCREE_PATH_BYTES = 160 };

/// path.name into `out`, which may be longer than what fits: then it is cut.
void scree_key_join(char out[SCREE_PATH_BYTES], const char *path, const char *name);

/// "stages.2.rate" of list "stages" into `path`, which it returns.
const char *scree_element_path(char path[SCREE_PATH_BYTES], const char *list, int64_t index, const char *key);

/// Whether a key is used, given the choices that its `when` names.
typedef enum scree_use {
    SCREE_USED,
    SCREE_UNUSED,
    SCREE_USE_UNKNOWN, ///< the choice itself is wrong
} scree_use;

typedef struct scree_usage {
    scree_use use;
    const scree_key *chooser; ///< the key that `when` names, or NULL
    const scree_node *choice; ///< its value where it is given
    const char *when;         ///< the condition that decides, up to a '&': of the key, or of one that its own names
} scree_usage;
scree_usage scree_key_usage(const scree_node *root, const scree_section *section, const scree_node *mapping,
                            const scree_key *key);

/// The condition after the first of `when`, or NULL.
const char *scree_next_condition(const char *when);

/// The section of `list` that describes `element`, or NULL when its first key is missing or wrong.
const scree_section *scree_element_section(const scree_key *list, const scree_node *element);

/// Name of an element of a list: its `name`; of a stage without one its kind, numbered from 1 when several such stages
/// are of the same kind. False when it has none.
bool scree_element_name(const scree_key *list, const scree_node *parent, const scree_node *element, char *name,
                        size_t size);

/// Reads the whole tree along `section` into the struct at `base` (zeroed before), and notes all problems. False when
/// there are no keys at all.
bool scree_root_read(scree_reader *reader, const scree_section *section, void *base);

/// Gives the tree of a case a value that the case leaves out. path: a key path such as "particles.count".
void scree_case_supply(scree_reader *reader, const char *path, const char *text);

/// Reads the whole tree into `config` (zeroed before), applies the rules, notes all problems.
void scree_config_read(scree_reader *reader, scree_config *config);

/// Stores one value, or notes why not. `node` is the value; NULL stores the default. base: the section's struct.
void scree_value_store(scree_reader *reader, const scree_key *key, const scree_node *node, const char *path,
                       void *base);

/// A value in one line of YAML, as --set takes it: `5e-3 1/s`, `[[1 %, 3 %]]`.
void scree_node_write(FILE *file, const scree_node *node);

/// The tree of a case, with everything that overruled the file.
scree_node *scree_case_root(const scree_case *c);

/// Rules that tie keys together. Values that are missing or wrong are left out: they have been noted.
void scree_rules_check(scree_reader *reader, scree_config *config);

/// Those of the modules that the case uses (module_rules.c).
void scree_rules_check_modules(scree_reader *reader, scree_config *config);

/// Notes a problem at a key path, "stages.2.rate"; where the case does not have the key, at the section that should.
/// For the rules of modules. accepted: may be NULL.
void scree_rule_refuse(scree_reader *reader, const char *path, const char *accepted, const char *format, ...)
    SCREE_PRINTF(4, 5);

/// Names of the modules that are choices of a key ("integrator.scheme") and suit, as the table has them, with `between`
/// between two: what is accepted, or a way out in a message. Lives as long as the case; NULL: none suits, or no memory.
const char *scree_rule_choices(scree_reader *reader, const char *key, const char *between,
                               bool (*suits)(const scree_module *module));

/// Whether the case gives the key at a path a value, right or wrong: not `auto`.
bool scree_rule_is_said(scree_reader *reader, const char *path);

/// Whether the case gives the key at `path` by what overrules that which gives the one at `other` (quick, --set): what
/// is not used with it is left out then, without a word.
bool scree_rule_overrules(scree_reader *reader, const char *path, const char *other);

/// Gives a key of the case a text, in the tree as in its member. path: of the key, "walls.0.file".
void scree_rule_set_text(scree_reader *reader, const char *path, const char *text, char **member);

/// Those of the particles: materials, sizes and shares of the species (particle_rules.c).
void scree_rules_check_particles(scree_reader *reader, const scree_config *config);

/// Those of the boundaries of stages, and of the velocity gradients that they impose (boundary_rules.c).
void scree_rules_check_boundaries(scree_reader *reader, scree_config *config);

/// Those of the laws of pairs of materials (pair_law_rules.c).
void scree_rules_check_pair_laws(scree_reader *reader, const scree_config *config);

/// Those of the selections: names (selection_rules.c).
void scree_rules_check_selections(scree_reader *reader, const scree_config *config);

/// Notes that the case has no THING ("selection") of this name, with the nearest of those that it has.
void scree_rule_refuse_name(scree_reader *reader, const char *path, const char *thing, const char *wanted,
                            const char *const *names, size_t count);

/// Whether the case has a selection `name`, which stands at `path`; else that is noted. True for one that is missing or
/// wrong, and noted.
bool scree_rule_is_selection(scree_reader *reader, const scree_config *config, const char *path, const char *name);

/// The same of a stage; true as well where there is no `name`.
bool scree_rule_is_stage(scree_reader *reader, const scree_config *config, const char *path, const char *name);

/// Those of the walls of the case (wall_rules.c). Files that they name are found: their paths become absolute, and the
/// case holds the checksum of their content.
void scree_rules_check_walls(scree_reader *reader, scree_config *config);

/// Those of the sources (source_rules.c).
void scree_rules_check_sources(scree_reader *reader, scree_config *config);

#endif
