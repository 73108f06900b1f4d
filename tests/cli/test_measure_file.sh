#!/usr/bin/env bash
# Files of grains are measured as runs are: a run's own snapshot, written as a dump with its contacts, has the numbers
# of the run, in a sheared periodic cell, between plates, and in a layer that repeats itself; overlaps alone have its contacts and normal forces.
# shellcheck source=tests/cli/check.sh
. "$(dirname "$0")/check.sh"

small=(--quick -q --no-figures --set output.paraview=no --set output.snapshots=4)
run() { "$scree" run "$@" >/dev/null 2>run.txt || complain "scree run $*: $(cat run.txt)"; }
measure() { "$scree" measure "$@" --no-figures 2>measure.txt || complain "scree measure $*: $(cat measure.txt)"; }
# value FOLDER COLUMN of values.csv
value() { awk -F, -v c="$2" '/^#/ { next } !head { for (k = 1; k <= NF; k++) { sub(/ *\[.*/, "", $k); if ($k == c) at = k } head = 1; next } at { print $at; exit }' "$1/values.csv"; }
# close A B TOLERANCE NAME: relative
close() { awk -v a="$1" -v b="$2" -v t="$3" 'BEGIN { d = a - b; if (d < 0) d = -d; if (b < 0) b = -b; exit !(a != "" && d <= t * b) }' || complain "$4: $1 and $2"; }

run periodic-shear "${small[@]}" --set particles.count=150 -o cell
run oedometer "${small[@]}" --set particles.count=150 -o plates
cat >layer.yaml <<'EOF'
scree: 1
name: layer
seed: 2
materials: [{name: glass, young_modulus: 1 MPa, density: 2500 kg/m3, friction: 0.5}]
particles: {shape: disc, material: glass, radius_min: 0.7 mm, radius_max: 1.3 mm, count: 150}
contact: {law: linear}
boundary: {periodic: x}
stages:
  - {stage: prepare, method: gas, aspect_ratio: 0.5, solid_fraction: 45 %}
  - {stage: confine, pressure: 1 kPa, unbalanced_limit: 0.9}
  - {stage: compress, rate: 5 1/s, strain: 0.5 %}
measure: {samples: 20, cells: no}
quick: {measure.samples: 10}
EOF
run layer.yaml "${small[@]}" -o layer
for name in cell plates layer; do
    expect 0 "contacts of" "$scree" export $name -o $name.dump --contacts $name.local
    measure $name -o own >/dev/null
    measure $name.dump --case $name/case.yaml --contacts $name.local -o listed >/dev/null
    measure $name.dump --case $name/case.yaml -o overlaps >said.txt
    grep -q 'by the overlaps' said.txt || complain "$name: it is not said that contacts come of overlaps"
    for column in time grains contacts coordination force_mean sliding_share unbalanced_ratio chains element_side density_core density_flank; do
        close "$(value listed $column)" "$(value own $column)" 1e-6 "$name: $column with contacts"
    done
    close "$(value overlaps grains)" "$(value own grains)" 0 "$name: grains of the dump"
done
measure cell.dump --case cell/case.yaml -o overlaps >/dev/null
measure cell -o own >/dev/null
close "$(value overlaps contacts)" "$(value own contacts)" 0 'contacts by overlaps'
close "$(value overlaps volume_fraction)" "$("$scree" get cell solid_fraction)" 1e-9 'solid fraction of a cell'
area=$(awk '/^ITEM: ATOMS/ { sum = 0; for (k = 3; k <= NF; k++) if ($k == "radius") at = k - 2; rows = 1; next } /^ITEM/ { rows = 0 }
    rows { sum += atan2(0, -1) * $at^2 } END { printf "%.17g", sum }' cell.dump)
close "$(awk -v l="$(value own element_side)" -v n="$(value own element_grains)" 'BEGIN { print l * l * 150 / n }')" \
    "$(awk -v a="$area" -v f="$("$scree" get cell solid_fraction)" 'BEGIN { print a / f }')" 1e-5 'area of the cell by the element'
close "$(value overlaps force_mean)" "$(value own force_mean)" 0.05 'mean force by overlaps'

# --- other units, other names of columns, another frame, a table of contacts
awk '/^ITEM: TIMESTEP/ { step = 1; print; next } step == 1 { step = 0; last = $0; print; next }
    /^ITEM: BOX/ { box = 3; print; next } box > 0 { box--; for (k = 1; k <= NF; k++) $k = sprintf("%.17g", $k * 1000); print; next }
    /^ITEM: ATOMS/ { rows = 1; print; next } /^ITEM/ { rows = 0 }
    rows { for (k = 3; k <= 9; k++) $k = sprintf("%.17g", $k * 1000) } { print }' cell.dump >mm.dump
sed 's/^ITEM: ENTRIES.*/ITEM: ENTRIES index c_1[1] c_1[2] c_1[3] c_1[4] c_1[5]/' cell.local |
    awk '/^ITEM: ENTRIES/ { rows = 1; print; next } /^ITEM/ { rows = 0 } rows { print ++n, $1, $2, $3 * 1000, $4 * 1000, $5 * 1000; next } { print }' >renamed.local
measure mm.dump --case cell/case.yaml --length-unit mm --force-unit 'mN' --contacts renamed.local \
    --contact-columns -,first,second,fx,fy,fz -o renamed >/dev/null
close "$(value renamed force_mean)" "$(value own force_mean)" 1e-6 'mean force in other units'
close "$(value renamed volume_fraction)" "$(value own volume_fraction)" 1e-9 'volume fraction in other units'
awk -v frame="$(awk '/^ITEM: TIMESTEP/ { getline; last = $1 } END { print last }' cell.local)" 'BEGIN { print "first,second,fx,fy" }
    /^ITEM: TIMESTEP/ { getline; on = $1 == frame; rows = 0; next } /^ITEM: ENTRIES/ { rows = on; next } /^ITEM/ { rows = 0 }
    rows { print $1 "," $2 "," $3 "," $4 }' cell.local >cell.csv
measure cell.dump --case cell/case.yaml --contacts cell.csv -o table >/dev/null
close "$(value table force_mean)" "$(value own force_mean)" 1e-6 'mean force of a table'
measure cell.dump --case cell/case.yaml --at '#1' --contacts cell.local -o first >/dev/null
measure cell --at '#1' -o own-first >/dev/null
close "$(value first contacts)" "$(value own-first contacts)" 0 'contacts of an earlier frame'

# --- what is wrong
expect 2 '^cell.dump: --case: a file of grains says neither material nor law' "$scree" measure cell.dump
expect 4 "^scree measure: cannot open 'none.dump': No such file" "$scree" measure none.dump --case biaxial
expect 2 'it is of files of grains' "$scree" measure cell --case biaxial
awk '/^ITEM: ATOMS/ { rows = 1; print; next } /^ITEM/ { rows = 0 } rows { $5 = 1e-3 * $1 } { print }' cell.dump >space.dump
expect 2 'they lie in space, and the case in a plane' "$scree" measure space.dump --case cell/case.yaml -o x
expect 2 'no frame of time step 99999' "$scree" measure cell.dump --case cell/case.yaml --at '#99999' -o x
expect 2 "'start' is no frame" "$scree" measure cell.dump --case cell/case.yaml --at start -o x
expect 2 'no column is called first' "$scree" measure cell.dump --case cell/case.yaml --contacts renamed.local -o x
expect 2 "did you mean 'first'" "$scree" measure cell.dump --case cell/case.yaml --contacts cell.local --contact-columns firts,second,fx,fy -o x
sed 's/^1,/9999,/; s/,1,/,9999,/' cell.csv >wrong.csv
expect 2 'grain 9999, and there is none' "$scree" measure cell.dump --case cell/case.yaml --contacts wrong.csv -o x
printf '1,2,3,4\n' >bare.csv
expect 2 'bare.csv:1:1: .*first row of a table names' "$scree" measure cell.dump --case cell/case.yaml --contacts bare.csv -o x
expect 2 'contacts are those of one file' "$scree" measure cell.dump mm.dump --case cell/case.yaml --contacts cell.csv -o x
finish
