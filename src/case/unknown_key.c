/// A key that is none: the nearest that is there.
#include "case/unknown_key.h"
#include "case/schema.h"

#include <scree/scree.h>

#include <stdio.h>
#include <string.h>

enum { MOST_KEYS = 64 };

const scree_key *scree_unknown_key_refuse(scree_reader *reader, scree_place place, const char *path, const char *name,
                                          const char *value, const scree_section *section)
{
    const char *names[MOST_KEYS];
    char accepted[256] = "";
    size_t count = 0, length = 0;
    for (size_t i = 0; i < section->count && count < MOST_KEYS; i++) {
        names[count++] = section->keys[i].name;
        if (length < sizeof accepted)
            length += (size_t)snprintf(accepted + length, sizeof accepted - length, "%s%s", i > 0 ? ", " : "",
                                       section->keys[i].name);
    }
    const char *nearest = scree_nearest(name, names, count);
    scree_problem_add(reader, place, path, value, nearest ? nearest : accepted, "unknown key%s%s%s",
                      nearest ? "; did you mean '" : "", nearest ? nearest : "", nearest ? "'?" : "");
    return nearest ? scree_section_find(section, nearest, strlen(nearest)) : NULL;
}
