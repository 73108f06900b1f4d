#!/usr/bin/env bash
# Records of full runs (cmake/records.sh): what was kept and put back is done for a sweep and gives the same results; what
# is there stays; the records of the repository are of the sweeps of today.
# shellcheck source=tests/cli/check.sh
. "$(dirname "$0")/check.sh"
root=$SCREE_SOURCE_DIR
records=$root/cmake/records.sh
name=biaxial-timescales-implicit
members=$name/members
run() { "$scree" sweep "$name" --quick --realisations "$1" --no-figures -q --jobs 2 -o "$2/$name"; }

expect 0 '' run 1 out
expect 0 "$name.tar.xz: 1 members" bash "$records" keep out kept
expect 0 '' bash "$records" keep out kept
expect 0 '' bash "$records" restore again kept
[ ! -e again/$members/000-seed=301/run.h5 ] || complain "snapshots were kept"
cp again/$members/000-seed=301/summary.json before.json

# The second member is run, the first is not, though it has no snapshots.
expect 0 '1 of 2 members are done, 0 have failed, 1 to run' "$scree" sweep $name --quick --realisations 2 --no-figures --jobs 2 -o again/$name
same "$(cat before.json)" "$(cat again/$members/000-seed=301/summary.json)" "a member that was put back ran again"
expect 0 '' run 2 out
same "$(grep -v '^#' out/$name/table.csv | cut -d, -f1-5)" "$(grep -v '^#' again/$name/table.csv | cut -d, -f1-5)" "means of what was put back"
mean() { awk -F, 'NR > 1 { sum += $4 * $4; rows++ } END { printf "%.5g of %d", sqrt(sum / rows), rows }' "$1/$name/curves/stress_ratio-over-axial_strain.csv"; }
same "$(mean out)" "$(mean again)" "curves of what was put back"

# Records grow by what is new, from wherever; a member that the sweep has no more goes.
expect 0 "$name.tar.xz: 2 members" bash "$records" keep again kept
rm -r "out/$members/000-seed=301"
expect 0 "$name.tar.xz: 2 members" bash "$records" keep out kept
same 2 "$(tar -tJf kept/$name.tar.xz | grep -c summary.json)" "members that are kept"
sed -i 's/000-seed=301/000-seed=901/' out/$name/sweep.json
expect 0 "$name.tar.xz: 1 members" bash "$records" keep out kept

# What is there stays as it is; a member that is there in part gets nothing of what another run left.
echo own >again/$members/001-seed=302/summary.json
expect 0 '' bash "$records" restore again kept
same own "$(cat again/$members/001-seed=302/summary.json)" "what was there"
rm again/$members/001-seed=302/summary.json
expect 0 '' bash "$records" restore again kept
[ ! -e again/$members/001-seed=302/summary.json ] || complain "a member that is there in part was called done"
rm -r again/$members/001-seed=302
expect 0 '' bash "$records" restore again kept
[ -s again/$members/001-seed=302/summary.json ] || complain "a member that was not there was not put back"
expect 2 'keep +OUT RECORDS' bash "$records" keep
expect 2 "keep or restore, not 'lose'" bash "$records" lose out kept

# Of a sweep that averages over snapshots a member keeps those.
member=layer-response/members/000-smooth-seed=1
expect 0 '' "$scree" sweep layer-response --quick --realisations 1 --no-figures -q --member 0 -o bands/layer-response
"$scree" sweep layer-response --quick --realisations 1 --no-figures -q --collect -o bands/layer-response >/dev/null 2>&1
expect 0 'layer-response.tar.xz: 1 members' env SCREE="$scree" bash "$records" keep bands bands-kept
before=$(cksum bands-kept/layer-response.tar.xz)
expect 0 '' env SCREE="$scree" bash "$records" keep bands bands-kept
same "$(cksum bands-kept/layer-response.tar.xz)" "$before" "kept again"
expect 0 '' bash "$records" restore bands-again bands-kept
for folder in bands bands-again; do
    expect 0 '.' "$scree" measure $folder/$member --at settle --no-figures -o $folder-averages
done
same "$(awk -F, 'NR > 1 {printf "%.5g\n", $11}' bands-again-averages/cuts.csv)" "$(awk -F, 'NR > 1 {printf "%.5g\n", $11}' bands-averages/cuts.csv)" "averages of what was put back"
# Kept to six digits: of values below 10, and their differences of places, that is 1e-4.
same "$(paste -d, <(cut -d, -f4 bands-averages/response.csv) <(cut -d, -f4 bands-again-averages/response.csv) | awk -F, 'NR > 1 { d = $1 - $2; if (d < -1e-4 || d > 1e-4) bad++ } END { print NR, bad + 0 }')" "329 0" "mean response of what was put back"

# A record of a case that has changed since would stop `make reproduce-full`: remove it with the change.
expect 0 '' bash "$records" restore whole "$root/records"
for folder in whole/*/; do
    [ -e "$folder/sweep.json" ] || continue
    expect 0 '.' "$scree" sweep "$(basename "$folder")" --collect --no-figures -o "$folder"
    ! grep -qE '\b([0-9]+) of \1 members are still to be run' <<<"$output" ||
        complain "the record of $(basename "$folder") has none of the members that the sweep has: $output"
done
finish ""
