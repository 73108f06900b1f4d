#!/usr/bin/env bash
# Runs outlive the machine that made them: keeps, of each sweep below OUT, what a report and a later `scree reproduce` need
# (case, results, and the columns of its mean curves), and puts back what is not there.
#     records.sh keep    OUT RECORDS      members of OUT/SWEEP that are done are added to RECORDS/SWEEP.tar.xz
#     records.sh restore OUT RECORDS      RECORDS/SWEEP.tar.xz -> OUT/SWEEP; members that are there, even in part, stay as they are
# A member that was put back is done for a sweep: its case and its summary.json say so. It has no snapshots, and its
# series.csv has the columns of the curves of its sweep alone, to seven digits. Of a sweep that averages over snapshots
# (`ensemble`) each member has those, to 24 bits (`scree export --archive`; the program is $SCREE, or build/scree), and
# its response.csv, to six digits.
# Members that are not of the sweep any more are not kept.
set -eu
export LC_ALL=C
sweeps=$(dirname "$(realpath "$0")")/../cases/sweeps
scree=${SCREE:-$sweeps/../../build/scree}
what=${1-} out=${2-} records=${3-}
[ -n "$records" ] || { sed -n '2,10s/^# //p' "$0" >&2; exit 2; }

# Columns that the mean curves of a sweep are made of; the stage tells which rows are those of the loading.
curve_columns() {
    sed -n 's/^ *- *{ *y: *\([a-z_0-9]*\)\(.*\)}.*/\1 \2/p' "$1" |
        awk '{ x = "axial_strain"; if (match($0, /x: *[a-z_0-9]+/)) { x = substr($0, RSTART, RLENGTH); sub(/x: */, "", x) }
               print $1; print x } END { if (NR) print "stage" }' | sort -u | paste -sd,
}

# series.csv $1 with the columns $2 (separated by commas) alone; their heads stay, units with them.
cut_series() {
    awk -F, -v names="$2" '
        BEGIN { OFS = ","; wanted = split(names, want, ",") }
        NR == 1 { for (k = 1; k <= wanted; k++) for (i = 1; i <= NF; i++) {
                      head = $i; sub(/ *\[.*/, "", head)
                      if (head == want[k]) column[++count] = i } }
        { line = ""
          for (k = 1; k <= count; k++) {
              value = $column[k]
              if (value ~ /^-?[0-9.]+(e[-+]?[0-9]+)?$/) value = sprintf("%.7g", value)
              line = line (k > 1 ? OFS : "") value
          }
          print line }' "$1"
}

# A table with six digits.
shorten() {
    awk -F, 'BEGIN { OFS = "," } NR > 1 { for (k = 1; k <= NF; k++) if ($k ~ /^-?[0-9.]+(e[-+]?[0-9]+)?$/) $k = sprintf("%.6g", $k) } { print }' "$1"
}

# Folders of a sweep's members that are done.
finished() {
    grep -o '"folder": *"[^"]*"' "$1/sweep.json" | sed 's/.*: *"\(.*\)"/\1/' | while read -r name; do
        grep -qs '"status": *"done"' "$1/members/$name/summary.json" && printf '%s\n' "$name"
    done
}

# Lays the members of the sweep $1 into the folder $2, beside those that are there; drops what is no member any more.
gather() {
    local columns member from to stage
    columns=$(curve_columns "$sweeps/$(basename "$1").yaml")
    mkdir -p "$2/members"
    cp "$1/sweep.json" "$2/"
    for to in "$2"/members/*/; do
        grep -qsF "\"$(basename "$to")\"" "$1/sweep.json" || rm -rf "$to"
    done
    finished "$1" | while read -r member; do
        from=$1/members/$member to=$2/members/$member
        # What was kept of this run is what there would be again.
        ! cmp -s "$from/summary.json" "$to/summary.json" || continue
        rm -rf "$to"
        if grep -q '^ensemble:' "$sweeps/$(basename "$1").yaml"; then
            stage=$(sed -nE 's/^ensemble:.*[{, ](from|at): *([a-z_]+).*/\2/p' "$sweeps/$(basename "$1").yaml")
            "$scree" export "$from" --archive "$to" ${stage:+--stage "$stage"} >/dev/null
            rm -f "$to/series.csv"
            [ ! -e "$from/response.csv" ] || shorten "$from/response.csv" >"$to/response.csv"
        else
            mkdir -p "$to"
            cp "$from/case.yaml" "$from/summary.json" "$to/"
        fi
        [ -z "$columns" ] || cut_series "$from/series.csv" "$columns" >"$to/series.csv"
    done
}

keep() {
    local sweep name record
    mkdir -p "$records"
    for sweep in "$out"/*/; do
        name=$(basename "$sweep") record=$records/$(basename "$sweep").tar.xz
        [ -e "$sweep/sweep.json" ] && [ -e "$sweeps/$name.yaml" ] && [ -n "$(finished "$sweep")" ] || continue
        [ ! -e "$record" ] || tar -C "$scratch" -xJf "$record"
        gather "${sweep%/}" "$scratch/$name"
        tar -C "$scratch" --sort=name --owner=0 --group=0 --numeric-owner --mtime=@0 --mode=u=rwX,go=rX -cf - "$name" |
            xz -9e >"$record.new"
        cmp -s "$record" "$record.new" || echo "$record: $(ls "$scratch/$name/members" | wc -l) members"
        mv "$record.new" "$record"
    done
}

restore() {
    local record name entry
    for record in "$records"/*.tar.xz; do
        [ -e "$record" ] || continue
        name=$(basename "$record" .tar.xz)
        tar -C "$scratch" -xJf "$record"
        mkdir -p "$out/$name/members"
        for entry in "$scratch/$name/sweep.json" "$scratch/$name"/members/*/; do
            entry=${entry#"$scratch/"} entry=${entry%/}
            [ -e "$out/$entry" ] || mv "$scratch/$entry" "$out/$entry"
        done
    done
}

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
case $what in
    keep | restore) $what ;;
    *) echo "records.sh: keep or restore, not '$what'" >&2; exit 2 ;;
esac
