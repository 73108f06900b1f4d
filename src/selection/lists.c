/// Selections by what bodies are: all, by id, by species.
#include "case/check.h"
#include "module/key_rows.h"
#include "selection/selection.h"

#include <stdlib.h>
#include <string.h>

// ---- all ---------------------------------------------------------------------------------------------------------

static scree_status choose_all(const scree_model *model, const scree_state *state, const void *own, uint8_t *chosen,
                               scree_error *error)
{
    (void)model, (void)own, (void)error;
    memset(chosen, 1, state->count);
    return SCREE_OK;
}

static const scree_selection_kind all_kind = {.choose = choose_all};

const scree_module scree_module_select_all = {
    .name = "all",
    .meaning = "All particles.",
    .choice_of = CHOICE_OF(IS("selections")),
    .selection = &all_kind,
};

// ---- ids ---------------------------------------------------------------------------------------------------------

typedef struct id_list {
    const scree_node *ids; ///< numbers, and pairs of the first and the last one
} id_list;

/// First and last id of an element of the list; false when it is neither a whole number nor a pair of them.
static bool read_range(const scree_node *node, unsigned long long range[2])
{
    const scree_node *part[2] = {node, node};
    if (node->kind == SCREE_NODE_LIST) {
        if (node->count != 2) return false;
        part[0] = node->first;
        part[1] = node->last;
    }
    for (int k = 0; k < 2; k++) {
        const char *text = part[k]->kind == SCREE_NODE_SCALAR ? part[k]->text : "";
        if (!text[0] || strlen(text) > 9 || text[strspn(text, "0123456789")]) return false;
        range[k] = strtoull(text, NULL, 10);
    }
    return range[0] <= range[1];
}

static scree_status choose_ids(const scree_model *model, const scree_state *state, const void *own, uint8_t *chosen,
                               scree_error *error)
{
    const id_list *list = own;
    (void)model;
    for (const scree_node *node = list->ids->first; node; node = node->next) {
        unsigned long long range[2] = {0};
        (void)read_range(node, range); // the rules have seen to it
        for (unsigned long long id = range[0]; id <= range[1]; id++) {
            uint32_t row = scree_state_row_of(state, id);
            if (row == SCREE_NO_ROW)
                return scree_error_set(error, SCREE_ERROR_INPUT, "names particle %llu, which is not there", id);
            chosen[row] = 1;
        }
    }
    return SCREE_OK;
}

/// Too many for this count are many.
static size_t number_of_ids(const void *own)
{
    const id_list *list = own;
    size_t number = 0;
    for (const scree_node *node = list->ids->first; node; node = node->next) {
        unsigned long long range[2] = {1, 0};
        if (read_range(node, range)) number += (size_t)(range[1] - range[0]) + 1;
    }
    return number;
}

static void check_ids(scree_reader *reader, const scree_config *config)
{
    for (int64_t i = 0; i < config->selection_count; i++) {
        const id_list *list = config->selections[i].own;
        if (config->selections[i].kind != SCREE_SLOT_select_ids || !list || !list->ids) continue;
        size_t at = 0;
        for (const scree_node *node = list->ids->first; node; node = node->next, at++) {
            unsigned long long range[2];
            char path[SCREE_PATH_BYTES];
            (void)snprintf(path, sizeof path, "selections.%lld.ids.%zu", (long long)i, at);
            if (!read_range(node, range))
                scree_rule_refuse(reader, path, "a whole number, or [first, last]",
                                  "expected the number of a particle, or a pair of the first and the last one");
        }
    }
}

static const scree_key id_keys[] = {
    KEY(id_list, ids, SCREE_KEY_VALUES, FROM("1"), TO("10000"),
        .meaning = "Numbers of particles, and pairs [first, last] of them."),
};
static const scree_selection_kind ids_kind = {.choose = choose_ids, .number = number_of_ids};

const scree_module scree_module_select_ids = {
    .name = "ids",
    .meaning = "Particles by their numbers, which begin with 0.",
    .choice_of = CHOICE_OF(IS("selections")),
    .keys = (const scree_keys[]){KEYS_OF(NULL, id_keys, id_list)},
    .keys_count = 1,
    .rules = check_ids,
    .selection = &ids_kind,
};

// ---- species -----------------------------------------------------------------------------------------------------

typedef struct species_list {
    const scree_node *species; ///< names
} species_list;

static bool is_named(const species_list *list, const char *name)
{
    for (const scree_node *node = list->species->first; node; node = node->next)
        if (name && strcmp(node->text, name) == 0) return true;
    return false;
}

static scree_status choose_species(const scree_model *model, const scree_state *state, const void *own, uint8_t *chosen,
                                   scree_error *error)
{
    (void)error;
    for (size_t row = 0; row < state->count; row++) {
        int species = state->species[row];
        chosen[row] = species < model->species_count && is_named(own, model->species[species].name);
    }
    return SCREE_OK;
}

static void check_species(scree_reader *reader, const scree_config *config)
{
    const char *names[SCREE_MOST_SPECIES];
    size_t count = 0;
    for (int64_t k = 0; k < config->particles.species_count; k++)
        if (config->particles.species[k].name) names[count++] = config->particles.species[k].name;
    if ((int64_t)count < config->particles.species_count) return; // noted
    for (int64_t i = 0; i < config->selection_count; i++) {
        const species_list *list = config->selections[i].own;
        if (config->selections[i].kind != SCREE_SLOT_select_species || !list || !list->species) continue;
        size_t at = 0;
        for (const scree_node *node = list->species->first; node; node = node->next, at++) {
            bool found = false;
            char path[SCREE_PATH_BYTES];
            (void)snprintf(path, sizeof path, "selections.%lld.species.%zu", (long long)i, at);
            for (size_t k = 0; k < count; k++) found = found || (node->text && strcmp(names[k], node->text) == 0);
            if (!found) scree_rule_refuse_name(reader, path, "species", node->text ? node->text : "", names, count);
        }
    }
}

static const scree_key species_keys[] = {
    KEY(species_list, species, SCREE_KEY_VALUES, FROM("1"), TO("16"), .meaning = "Names of species."),
};
static const scree_selection_kind species_kind = {.choose = choose_species};

const scree_module scree_module_select_species = {
    .name = "species",
    .meaning = "Particles of some species.",
    .choice_of = CHOICE_OF(IS("selections")),
    .keys = (const scree_keys[]){KEYS_OF(NULL, species_keys, species_list)},
    .keys_count = 1,
    .rules = check_species,
    .selection = &species_kind,
};
