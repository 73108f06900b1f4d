/// Reading a file along a schema of its own. Numbers are read in the C locale whatever the program's locale is.
#include "case/document.h"

#include "case/yaml.h"

#include <locale.h>
#include <string.h>

scree_status scree_reader_conclude(scree_reader *reader)
{
    if (reader->failure.status) {
        scree_problems_replace(reader->problems, &reader->failure);
        return reader->failure.status;
    }
    scree_problems_finish(reader->problems);
    return scree_problems_count(reader->problems) > 0 ? SCREE_ERROR_INPUT : SCREE_OK;
}

static void read_document(scree_reader *reader, const scree_document *document, void *base)
{
    const char *name = scree_arena_copy(reader->arena, document->name, strlen(document->name));
    scree_place place = {name, 1, 1, SCREE_ORIGIN_FILE};
    if (!name)
        scree_reader_fail(reader, strlen(document->name));
    else if (scree_text_check(reader, document->text, document->length, place))
        reader->root = scree_yaml_read(reader, document->text, document->length, place);
    if (!reader->root || reader->failure.status) return;
    bool keys = scree_root_read(reader, document->section, base);
    if (keys && document->rules && !reader->failure.status) document->rules(reader, document->user);
}

scree_status scree_document_read(const scree_document *document, scree_arena *arena, void *base, size_t size,
                                 scree_problems **problems)
{
    scree_problems *found;
    if (problems) *problems = NULL;
    memset(base, 0, size);
    scree_status status = scree_problems_create(&found);
    if (status) return status;
    scree_reader reader = {.arena = arena, .problems = found};
    locale_t c_locale = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    locale_t before = uselocale(c_locale);
    read_document(&reader, document, base);
    uselocale(before);
    freelocale(c_locale);
    status = scree_reader_conclude(&reader);
    if (status && problems)
        *problems = found;
    else
        scree_problems_free(found);
    return status;
}
