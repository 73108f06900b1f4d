#!/usr/bin/env bash
# Whether built-in cases in their quick forms have the same state checksum on any number of processes and threads
# (preset mpi), and that which is stored in quick.txt beside this file.
#
#   ranks.sh SCREE_BINARY RESULTS [-p "1 2 3 4 8"] [-t "1 2"] [-l SECONDS] [-s STEPS] [NAME...]
#       Runs all cases that `scree list` names, or those given, the short ones first; appends a line to the file
#       RESULTS for each case and combination: name, processes, threads, seconds, and what came of it (a checksum, or
#       in words). Of cases with more than 3 STEPS (20000) all but the first combination go on from a snapshot of its
#       run, which lies in RESULTS.runs, so many steps before the end; the line says how many they were. What is in
#       the file is not run again, so a call that was ended goes on; but what was not done in fewer SECONDS than now
#       is. When a combination of a case is not done those behind it are left. Needs h5dump.
#   ranks.sh --table RESULTS
#       The same as a table of Markdown, a row a case. Status 1: something differs or has failed.
set -euo pipefail
stored=$(dirname "$(realpath "$0")")/quick.txt

table() {
    awk '
    FNR == NR { if ($1 !~ /^#/) stored[$1] = $2; next }
    {
        if (!($1 in count)) order[++cases] = $1
        at = $2 " x " $3
        if (!(($1, at) in result)) combination[$1, ++count[$1]] = at
        result[$1, at] = substr($0, length($1 $2 $3 $4) + 5)
        if (sub(/ last [0-9]+ steps$/, "", result[$1, at])) last[$1] = $(NF - 1) > last[$1] ? $(NF - 1) : last[$1]
        seconds[$1, at] = $4
    }
    function add(list, item) { return list (list == "" ? "" : ", ") item }
    function row(name,    k, at, what, wanted, agree, other, least, most, kinds, kind, where) {
        if (name in stored) wanted = stored[name]
        for (k = 1; k <= count[name]; k++) {
            at = combination[name, k]
            what = result[name, at]
            if (wanted == "" && what ~ /^[0-9a-f]+$/) wanted = what
            if (what == wanted) {
                agree = add(agree, at)
                if (least == "" || seconds[name, at] < least) least = seconds[name, at]
                if (seconds[name, at] > most) most = seconds[name, at]
                continue
            }
            if (what !~ /^(refused|not done)/) wrong = 1
            if (!(what in where)) kind[++kinds] = what
            where[what] = add(where[what], at)
        }
        for (k = 1; k <= kinds; k++) other = add(other, kind[k] ": " where[kind[k]])
        printf "| %s | %s | %s | %s | %s | %s |\n", name, wanted (name in stored ? "" : " (none is stored)"), agree, \
            name in last ? last[name] : "all", least (most > least ? " to " most : ""), other
    }
    END {
        print "| case | checksum | agree (processes x threads) | steps behind 1 x 1 | seconds | other |"
        print "|---|---|---|---|---|---|"
        for (c = 1; c <= cases; c++) row(order[c])
        exit wrong
    }' "$stored" "$1"
}

if [ "$1" = --table ]; then
    table "$2"
    exit
fi
scree=$(realpath "$1") results=$(realpath "$2")
shift 2
processes="1 2 3 4 8" threads="1 2" limit=600 steps=20000
while getopts p:t:l:s: option; do
    case $option in
    p) processes=$OPTARG ;;
    t) threads=$OPTARG ;;
    l) limit=$OPTARG ;;
    s) steps=$OPTARG ;;
    *) exit 2 ;;
    esac
done
shift $((OPTIND - 1))
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_mpi_yield_when_idle=1
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
touch "$results"
mkdir -p "$results.runs"

# Seconds of a quick form by the estimate of `scree check`, and its name.
estimate() {
    local seconds
    seconds=$("$scree" check "$1" --quick 2>/dev/null | awk '
        / time needed / { for (k = 4; k < NF; k += 2) s += $k * ($(k + 1) ~ /^h/ ? 3600 : $(k + 1) ~ /^min/ ? 60 : $(k + 1) ~ /^s/); print s; exit }')
    printf '%s %s\n' "${seconds:-1e9}" "$1"
}

# outcome NAME PROCESSES THREADS: what the file of results says last; nothing where it is to be run, first or again.
outcome() {
    awk -v name="$1" -v p="$2" -v t="$3" -v limit="$limit" '
        $1 == name && $2 == p && $3 == t { what = $5 " " $6; again = / not done in / && $(NF - 1) < limit }
        END { if (!again) print what }' "$results"
}

# snapshot FOLDER: the number of the last snapshot that lies STEPS before the end, and how many steps those are; nothing
# where the run has fewer than 3 STEPS.
snapshot() {
    local total names=()
    total=$("$scree" get "$1" steps)
    [ "$total" -gt $((3 * steps)) ] || return 0
    mapfile -t names < <(h5ls "$1/run.h5/snapshots" | awk '{print "-a\n/snapshots/" $1 "/step"}')
    h5dump -y "${names[@]}" "$1/run.h5" | awk -v left="$steps" -v total="$total" '
        /^ *[0-9]+$/ { if (total - $1 >= left) { found = number + 0 " " total - $1 } number++ }
        END { print found }'
}

# attempt NAME PROCESSES THREADS: the run, or its last part, in `folder`; `part` is what is behind the checksum.
attempt() {
    local from=() first=$results.runs/$1
    folder=$scratch/run part=
    rm -rf "$folder"
    if [ "$2 $3" = "1 1" ]; then
        folder=$first
        rm -f "$first.from"
        set -- "$@" --force --set output.snapshots=200 --set output.paraview=no
    elif [ -d "$first" ]; then
        [ -f "$first.from" ] || snapshot "$first" >"$first.from"
        read -r -a from <"$first.from" || true
    fi
    if [ ${#from[@]} = 0 ]; then
        set -- "$2" "$3" "$1" --quick "${@:4}" -o "$folder"
    else
        cp -r "$first" "$folder"
        part=" last ${from[1]} steps"
        set -- "$2" "$3" --restart "$folder" --from "${from[0]}"
    fi
    timeout -k 30 "$limit" mpirun --oversubscribe --bind-to none -n "$1" "$scree" run --threads "$2" --no-figures --quiet "${@:3}" 2>&1 </dev/null
}

# run NAME PROCESSES THREADS: appends a line to the results.
run() {
    local begin=$SECONDS status=0 what
    attempt "$@" >"$scratch/said" || status=$?
    if [ $status = 0 ]; then
        what=$("$scree" get "$folder" state_checksum)$part
    elif [ $((SECONDS - begin)) -ge "$limit" ]; then
        what="not done in $limit s"
    else
        what=$(sed -nE 's/.*scree run: (.*) cannot be spread.*/refused: \1/p' "$scratch/said" | head -n 1)
        what=${what:-failed: $(head -n 1 "$scratch/said")}
    fi
    printf '%s %s %s %d %s\n' "$1" "$2" "$3" $((SECONDS - begin)) "$what" | tee -a "$results"
}

[ $# -gt 0 ] || mapfile -t names < <("$scree" list | awk '{print $1}')
[ $# -eq 0 ] || names=("$@")
mapfile -t names < <(for name in "${names[@]}"; do estimate "$name"; done | sort -g | awk '{print $2}')
for name in "${names[@]}"; do
    for p in $processes; do
        for t in $threads; do
            [ -n "$(outcome "$name" "$p" "$t")" ] || run "$name" "$p" "$t"
            [[ $(outcome "$name" "$p" "$t") != "not done"* ]] || break 2
        done
    done
done
table "$results" >/dev/null
