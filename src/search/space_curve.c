/// Radix sort of keys.
#include "search/space_curve.h"

#include "base/memory.h"

enum { DIGIT_BITS = 11, DIGITS = 1 << DIGIT_BITS };

scree_status scree_key_list_reserve(scree_key_list *list, size_t count, scree_error *error)
{
    if (count <= list->capacity) return SCREE_OK;
    size_t capacity = count + count / 8 + 64;
    scree_key_list_destroy(list);
    scree_status status = scree_allocate(&list->key, capacity, sizeof *list->key, error);
    if (!status) status = scree_allocate(&list->other_key, capacity, sizeof *list->other_key, error);
    if (!status) status = scree_allocate(&list->index, capacity, sizeof *list->index, error);
    if (!status) status = scree_allocate(&list->other_index, capacity, sizeof *list->other_index, error);
    if (status)
        scree_key_list_destroy(list);
    else
        list->capacity = capacity;
    return status;
}

void scree_key_list_destroy(scree_key_list *list)
{
    scree_release(&list->key);
    scree_release(&list->other_key);
    scree_release(&list->index);
    scree_release(&list->other_index);
    list->capacity = 0;
}

/// Moves keys and indices to the other arrays in the order of one digit, and exchanges the arrays.
static void sort_by_digit(scree_key_list *list, size_t count, int shift)
{
    uint32_t begin[DIGITS] = {0};
    for (size_t k = 0; k < count; k++) begin[list->key[k] >> shift & (DIGITS - 1)]++;
    uint32_t sum = 0;
    for (int digit = 0; digit < DIGITS; digit++) {
        uint32_t size = begin[digit];
        begin[digit] = sum;
        sum += size;
    }
    for (size_t k = 0; k < count; k++) {
        uint32_t to = begin[list->key[k] >> shift & (DIGITS - 1)]++;
        list->other_key[to] = list->key[k];
        list->other_index[to] = list->index[k];
    }
    uint64_t *key = list->key;
    uint32_t *index = list->index;
    list->key = list->other_key;
    list->index = list->other_index;
    list->other_key = key;
    list->other_index = index;
}

void scree_key_list_sort(scree_key_list *list, size_t count)
{
    uint64_t different = 0;
    for (size_t k = 1; k < count; k++) different |= list->key[k] ^ list->key[0];
    // Digits begin at the lowest bit that differs, so that none is wasted.
    while (different) {
        int shift = __builtin_ctzll(different);
        sort_by_digit(list, count, shift);
        different = shift + DIGIT_BITS < 64 ? different >> (shift + DIGIT_BITS) << (shift + DIGIT_BITS) : 0;
    }
}
