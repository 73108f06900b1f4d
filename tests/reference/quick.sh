#!/usr/bin/env bash
# The state checksums of the built-in cases in their quick forms, against those stored in quick.txt beside this file.
# quick.sh SCREE_BINARY compare|write [NAME...]: all cases that `scree list` names, or those given; some minutes each.
set -euo pipefail
scree=$(realpath "$1") action=$2
shift 2
table=$(dirname "$(realpath "$0")")/quick.txt
head='# State checksums of the built-in cases in their quick forms, written by `make reference`: name checksum'
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
[ $# -gt 0 ] || mapfile -t names < <("$scree" list | awk '{print $1}')
[ $# -eq 0 ] || names=("$@")
stored() { awk -v name="$1" '$1 == name { print $2 }' "$table" 2>/dev/null; }
wrong=0
for name in "${names[@]}"; do
    begin=$SECONDS
    "$scree" run "$name" --quick --no-figures --quiet -o "$scratch/$name"
    found=$("$scree" get "$scratch/$name" state_checksum) was=$(stored "$name" || true)
    rm -rf "${scratch:?}/$name"
    if [ "$action" = write ]; then
        { echo "$head"; { grep -v -e '^#' -e "^$name " "$table" 2>/dev/null || true; echo "$name $found"; } | LC_ALL=C sort; } >"$scratch/table"
        cp "$scratch/table" "$table"
        verdict=written
    elif [ "$found" = "$was" ]; then
        verdict=same
    else
        verdict="differs: stored ${was:-none}" wrong=1
    fi
    printf '%-24s %s  %4d s  %s\n' "$name" "$found" $((SECONDS - begin)) "$verdict"
done
exit $wrong
