#!/usr/bin/env bash
# The structure that docs/architecture.md promises: a file includes only from its own layer or layers above it in the table;
# the command line includes only the public headers; the choices of a case that are modules are known by name in their own
# files alone; the library never exits, aborts or prints; no circle of files; files stay below 600 lines, functions below 60,
# half of them within 12; words are those of the field.
set -u
source_dir=${SCREE_SOURCE_DIR:?}
cd "$source_dir" || exit 1
mapfile -t layers < <(grep -oE '^\| `src/[a-z]+/` ' docs/architecture.md | grep -oE 'src/[a-z]+' | cut -d/ -f2)
[ ${#layers[@]} -ge 12 ] || { echo "the layer table of docs/architecture.md was not found"; exit 1; }
rank() { local k; for k in "${!layers[@]}"; do [ "${layers[k]}" = "$1" ] && { echo "$k"; return; }; done; echo 99; }

failures=0
complain() { echo "FAIL: $*"; failures=$((failures + 1)); }

for folder in src/*/; do
    layer=$(basename "$folder")
    mine=$(rank "$layer")
    [ "$mine" = 99 ] && complain "src/$layer is not in the table of docs/architecture.md"
    while IFS=: read -r file line include; do
        other=$(echo "$include" | sed -E 's/.*"([a-z]+)\/.*/\1/')
        if [ "$layer" = cli ]; then
            [ "$other" = cli ] || complain "$file:$line: the command line includes only <scree/...>, not $include"
        elif [ "$(rank "$other")" -gt "$mine" ]; then
            complain "$file:$line: layer $layer includes from $other, which lies below it"
        fi
    done < <(grep -nHE '^#include "[a-z]+/' "$folder"*.[ch])
done
# A law is known to its own two files, its row, and its header in contact/laws.h; else it may only be a default of the schema.
mapfile -t laws < <(grep 'define SCREE_LAWS_OF' src/module/table.h | grep -oE 'row\([a-z_]+\)' | sed -E 's/row\((.*)\)/\1/')
[ ${#laws[@]} -ge 2 ] || complain "the laws of src/module/table.h were not found"
for law in "${laws[@]}"; do
    for own in src/contact/$law.h src/contact/$law.c; do [ -f "$own" ] || complain "law $law has no $own"; done
    # A law that is called by a word of the language is known by its slot, its module, its traits, or as a choice.
    case $law in
    *_*) known=$law ;;
    *) known="(SCREE_SLOT|scree_module)_$law([^a-z]|\$)|(^|[^a-z])${law}_(traits|KERNELS)|[\"=|]$law[\"\\\\&|]" ;;
    esac
    while IFS= read -r hit; do complain "${hit%%:*} knows the law $law"; done \
        < <(find src -name '*.[ch]' ! -path "src/contact/$law.*" ! -path src/contact/laws.h ! -path src/module/table.h -exec \
            awk -v known="$known" '{ sub(/\/\/.*/, "") } $0 ~ known && !/\.standard = / { print FILENAME ":" FNR }' {} +)
done
mapfile -t modules < <(sed -nE '/define SCREE_(LAWS|GEOMETRIES|SHAPES|BOUNDARY_MODULES|SELECTION_MODULES|CASE_MODULES)/,/^$/p' src/module/table.h | grep -oE 'row\([a-z_]+\)' | sed -E 's/row\((.*)\)/\1/')
[ ${#modules[@]} -ge 30 ] || complain "the rows of src/module/table.h were not found"
# Files that make descriptors by a macro, and those that include a header with one.
mapfile -t makers < <(grep -rl 'scree_module_##[a-z]* = {' src)
for maker in "${makers[@]}"; do
    case $maker in *.h) mapfile -t -O ${#makers[@]} makers < <(grep -rlF "#include \"${maker#src/}\"" src --include='*.c') ;; esac
done
for name in "${modules[@]}"; do
    mapfile -t owner < <({ grep -rl "scree_module_$name = {" src; grep -lE "^[A-Z]+\($name, \"" "${makers[@]}"; } | sort -u)
    [ ${#owner[@]} -eq 1 ] || complain "module $name has ${#owner[@]} descriptors"
    while IFS= read -r file; do
        case $file in "${owner[0]%.c}"*) ;; *) complain "$file knows the module $name of ${owner[0]}" ;; esac
    done < <(grep -rlE "(SCREE_SLOT_|scree_module_)$name\b" src)
done
# A shape of walls is known by its name to its own file alone (a shape of particles may be called so too).
mapfile -t shapes < <(grep -lE '^    \.wall = ' src/shape/wall_*.c | sed -E 's/.*wall_(.*)\.c/\1/')
[ ${#shapes[@]} -ge 5 ] || complain "the shapes of walls were not found"
for shape in "${shapes[@]}"; do
    while IFS= read -r file; do complain "$file knows the wall shape $shape"; done \
        < <(grep -rlE "shape=([a-z|]*\|)?$shape\b|SCREE_SHAPE_OF_|scree_${shape}_keys" src | grep -vE "src/shape/(wall_($shape|keys|round)|${shape}s)\.")
done
# What the user said is read by what resolves the model, where a module takes its own keys for that; by nobody below.
while IFS= read -r hit; do complain "$hit: only the model reads the config" ; done \
    < <(grep -rnE 'model(\.|->)config' src --include='*.[ch]' | grep -vE '^src/model/|scree_config_own\(&scree_module_')
while IFS= read -r hit; do complain "$hit: the library never exits, aborts or prints"; done \
    < <(grep -nHE '(^|[^a-z_>.])(exit|abort|printf|puts|perror)\(' $(find src -name '*.[ch]' ! -path 'src/cli/*') | grep -vE '///|// ')
# Schemes, stages and methods whose names are more than a word are known to their own files: messages take choices from the table.
while IFS= read -r file; do
    name=$(sed -nE 's/^    \.name = "([a-z]+_[a-z_]+)",$/\1/p' "$file" | head -n 1)
    [ -n "$name" ] || continue
    while IFS= read -r hit; do complain "$hit knows the module $name of $file"; done \
        < <(find src -name '*.[ch]' ! -path "${file%.c}.*" ! -path src/case/former.c -exec \
            awk -v name="$name" '{ sub(/\/\/.*/, "") } $0 ~ "\"([^\"]*[^a-z_\"/])?" name "([^a-z_][^\"]*)?\"" && !/\.standard = / { print FILENAME ":" FNR }' {} +)
done < <(grep -lE 'CHOICE_OF\(IS\("(integrator.scheme|stages|stages.prepare.method)"' $(find src -name '*.c'))
# Functions: from the line of the name to the closing brace; one line is as long as it is.
while IFS= read -r hit; do complain "$hit"; done < <(awk '
    FNR == 1 { start = 0 }
    /^[A-Za-z_]/ { start = FNR; name = $0 }
    /^[A-Za-z_].*\) \{.*\}$/ && !/=/ { length_of[++count] = 1 }
    /^\{$/ { open = name ~ /\(/ }
    /^\}/ && open {
        lines = FNR - start0 + 1
    }
    /^\{$/ { start0 = start }
    /^\}/ && open {
        length_of[++count] = lines
        if (lines > 60) print FILENAME ":" start0 ": a function of " lines " lines"
        open = 0
    }
    END {
        for (k = 1; k <= count; k++) { number[length_of[k]]++; most = length_of[k] > most ? length_of[k] : most }
        for (k = 1; k <= most; k++) { below += number[k]; if (2 * below >= count) break }
        if (count < 3000) print "only " count " functions were found"
        if (k > 12) print "half of the functions have more than 12 lines: " k
    }' $(find src include -name '*.[ch]'))
# No circle: what a source and its header include, other pairs as one.
circle=$(grep -HoE '^#include "[a-z]+/[a-z0-9_]+\.h"' $(find src -name '*.[ch]') |
    sed -E 's,^src/([a-z0-9_/]+)\.[ch]:#include "([a-z0-9_/]+)\.h",\1 \2,' | awk '$1 != $2' | sort -u | tsort 2>&1 >/dev/null | head -n 5)
[ -z "$circle" ] || complain "a circle of files: $circle"
# Words that the field does not use (a YAML file has indentation).
while IFS= read -r hit; do complain "$hit: a word that the field does not use"; done \
    < <(grep -rniwE 'bookings?|booked|foresight|indentations?|teams?|seals?|deposited' src include docs/*.md docs/theory --include='*.[ch]' --include='*.md' | grep -v '^src/case/yaml.c' | cut -c1-120)
while read -r lines file; do [ "$lines" -gt 600 ] && complain "$file has $lines lines"; done < <(wc -l $(find src include -name '*.[ch]') | grep -v total)
[ "$failures" -eq 0 ] && echo "structure: ${#layers[@]} layers, $(find src -name '*.[ch]' | wc -l) files, no complaint"
exit $((failures > 0))
