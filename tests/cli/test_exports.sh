#!/usr/bin/env bash
# What the shared library exports is what the headers below include/scree/ declare with SCREE_API, both ways; every
# function there has a comment above it or above the lines that it stands among.
# shellcheck source=tests/cli/check.sh
. "$(dirname "$0")/check.sh"
headers=${SCREE_SOURCE_DIR:?}/include/scree
library=$(find "$(dirname "$scree")" -maxdepth 1 -name 'libscree.so' | head -n 1)
[ -n "$library" ] || { echo "there is no libscree.so beside $scree"; exit 1; }

# A sanitizer exports marks of its own; they begin with underscores.
nm -D --defined-only "$library" | awk '{print $NF}' | grep -vE '^_' | sort >exported.txt
cat "$headers"/*.h | tr '\n' ' ' | grep -oE 'SCREE_API [a-z0-9_ *]+ \*?(scree_[a-z0-9_]+)\(' |
    grep -oE 'scree_[a-z0-9_]+\($' | tr -d '(' | sort >declared.txt
checks=$((checks + 2))
[ "$(wc -l <declared.txt)" -gt 60 ] || complain "only $(wc -l <declared.txt) functions were found in the headers"
[ "$(sort -u declared.txt | wc -l)" -eq "$(wc -l <declared.txt)" ] || complain "declared twice: $(uniq -d declared.txt)"
while read -r name; do complain "$name is exported, and no header declares it"; done < <(comm -23 exported.txt declared.txt)
while read -r name; do complain "$name is declared, and not exported"; done < <(comm -13 exported.txt declared.txt)

# No function in a header without the mark: it would be there in the static library alone.
while read -r hit; do complain "without SCREE_API: $hit"; done \
    < <(grep -nE '^[a-z].*\bscree_[a-z0-9_]+\(' "$headers"/*.h | grep -vE 'SCREE_API|typedef|_function\(')
# Each header can stand alone, in C and in C++.
for header in "$headers"/*.h; do
    name=scree/$(basename "$header")
    printf '#include <%s>\nint main(void)\n{\n    return 0;\n}\n' "$name" >alone.c
    expect 0 '' "${CC:-cc}" -std=c17 -Wall -Wextra -Wpedantic -Werror -I"${headers%/*}" -fsyntax-only alone.c
    command -v c++ >/dev/null && expect 0 '' c++ -x c++ -std=c++17 -Wall -Wextra -Werror -I"${headers%/*}" -fsyntax-only alone.c
done
finish "$(wc -l <exported.txt) functions"
