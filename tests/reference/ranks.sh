#!/usr/bin/env bash
# Whether built-in cases in their quick forms have the same state checksum on 1, 2 and 4 processes (preset mpi): a line
# each, with what is refused. ranks.sh SCREE_BINARY [NAME...]: all cases that `scree list` names, or those given.
set -euo pipefail
scree=$(realpath "$1")
shift
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
[ $# -gt 0 ] || mapfile -t names < <("$scree" list | awk '{print $1}')
[ $# -eq 0 ] || names=("$@")
wrong=0
on() { mpirun --oversubscribe -n "$1" "$scree" run "$2" --quick --no-figures --quiet --threads 1 -o "$scratch/$1" 2>&1 </dev/null; }
for name in "${names[@]}"; do
    begin=$SECONDS
    rm -rf "${scratch:?}"/*
    if ! said=$(on 2 "$name"); then
        why=$(sed -nE "s/.*scree run: (.*) cannot be spread.*/\1/p" <<<"$said" | head -n 1)
        [ -n "$why" ] || wrong=1
        printf '%-24s %s\n' "$name" "${why:+refused: }${why:-failed: $(head -n 1 <<<"$said")}"
        continue
    fi
    verdict=same
    for ranks in 1 4; do
        on $ranks "$name" >/dev/null || verdict="failed on $ranks"
        [ "$("$scree" get "$scratch/$ranks" state_checksum)" = "$("$scree" get "$scratch/2" state_checksum)" ] || verdict="differs on $ranks"
    done
    [ "$verdict" = same ] || wrong=1
    printf '%-24s %s  %4d s  %s\n' "$name" "$("$scree" get "$scratch/2" state_checksum)" $((SECONDS - begin)) "$verdict"
done
exit $wrong
