#!/usr/bin/env bash
# Snapshots as a dump of LAMMPS: read back they are the same bodies, in the plane and in space; the box of a
# sheared cell is tilted and holds all of them (some lie a little outside, until the next list).
# shellcheck source=tests/cli/check.sh
. "$(dirname "$0")/check.sh"

run() { "$scree" run "$@" >/dev/null 2>run.txt || complain "scree run $*: $(cat run.txt)"; }

# bodies FILE FRAME: id, place from the first one (a sample read back may be moved as a whole), radius of the bodies of a frame.
bodies() {
    awk -v frame="$2" '/^ITEM: TIMESTEP/ { getline; on = $1 == frame; rows = 0; next }
        /^ITEM/ { rows = on && /^ITEM: ATOMS/; next }
        rows { if (!n++) { x = $3; y = $4; z = $5 }; printf "%d %.9f %.9f %.9f %.12f\n", $1, $3 - x, $4 - y, $5 - z, $6 }' "$1" | sort -n
}

# read_back NAME CASE: the last frame as the sample of another run of the case, and its first frame.
read_back() {
    local frame
    frame=$(awk '/^ITEM: TIMESTEP/ { getline; last = $1 } END { print last }' "$1.dump")
    run "$2" "${small[@]}" --set particles.count="$(bodies "$1.dump" "$frame" | wc -l)" --set stages.prepare.method=file \
        --set stages.prepare.file="$1.dump" -o "$1-again"
    expect 0 'frames$' "$scree" export "$1-again" -o "$1-again.dump"
    same "$(bodies "$1-again.dump" 0)" "$(bodies "$1.dump" "$frame")" "bodies of $1 read back"
}

small=(--quick -q --no-figures --set output.paraview=no --set 'measure.windows=[]' --set output.snapshots=4
    --set 'stages.compress.strain=0.5 %' --set stages.confine.unbalanced_limit=0.2)
run biaxial "${small[@]}" --set particles.count=60 -o plane
expect 0 'plane.dump: [0-9]* frames$' "$scree" export plane -o plane.dump
same "$(grep -c TIMESTEP plane.dump)" "$("$scree" export plane | sed 's/.*: \([0-9]*\) frames/\1/')" "frames"
cmp -s plane.dump plane/snapshots.lammpstrj || complain "two names, two dumps"
read_back plane biaxial
expect 0 'of-one.dump: 5 frames' "$scree" export plane --stage compress -o of-one.dump
expect 4 "^scree export: cannot open 'none/run.h5': No such file or directory\$" "$scree" export none
expect 2 "^scree export: --stage: the run has no snapshot of a stage 'compres' \(accepted: prepare, confine, compress\)" \
    "$scree" export plane --stage compres
# A run in little: the same averages, to 24 bits; nothing to go on from.
expect 0 '^little: a run in little$' "$scree" export plane --archive little --stage confine
[ "$(stat -c %s little/run.h5)" -lt $(($(stat -c %s plane/run.h5) / 3)) ] || complain "a run in little is $(stat -c %s little/run.h5) bytes of $(stat -c %s plane/run.h5)"
for name in plane little; do
    for at in confine compress; do
        "$scree" measure $name --at $at --element 30 --no-figures -o $name-$at >/dev/null 2>&1 || complain "measure $name at $at"
    done
done
for at in confine compress; do
    same "$(awk -F, 'NR > 1 { printf "%.5g %.5g\n", $11, $8 }' little-$at/cuts.csv)" "$(awk -F, 'NR > 1 { printf "%.5g %.5g\n", $11, $8 }' plane-$at/cuts.csv)" "averages of a run in little at $at"
done
cmp -s little/series.csv plane/series.csv || complain "another series"
same "$("$scree" get little state_checksum)" "$("$scree" get plane state_checksum)" "results of a run in little"
expect 2 '^scree export: .*prepare' "$scree" export little --stage prepare -o no.dump
expect 2 "there is no checkpoint in 'little'" "$scree" run --restart little -q
expect 4 "no snapshot 6 in 'little' can be used: snapshot 6 was kept without its state" "$scree" run --restart little --from 6 -q
expect 0 'whole  *nothing can go on from it: snapshot 6 was kept without its state' "$scree" check little
expect 2 "there is a 'little' already: give another name" "$scree" export plane --archive little
expect 2 "^scree export: --archive: it takes no --output" "$scree" export plane --archive no -o no.dump
expect 2 "^scree export: --archive: it takes no --contacts" "$scree" export plane --archive no --contacts no.dump
expect 2 "^scree export: --stage: the run has no snapshot of a stage 'compres' " "$scree" export plane --archive no --stage compres
[ ! -e no ] || complain "a folder for nothing"
expect 4 '^scree export: ' "$scree" export none
[ ! -e none ] || complain "export makes folders"

run "$SCREE_SOURCE_DIR/tests/reference/cases/drum_3d.yaml" -q -o space
expect 0 'frames$' "$scree" export space -o space.dump
sed '/^gravity:/d; /^walls:/,/^     ends:/d; /^measure:/,$d' "$SCREE_SOURCE_DIR/tests/reference/cases/drum_3d.yaml" >free.yaml
cat >>free.yaml <<'END'
output: {paraview: no}
stages:
  - {stage: prepare, method: gas, solid_fraction: 24 %}
  - {stage: relax, boundary: none, duration: 1 us}
END
small=(-q --no-figures)
read_back space free.yaml
awk '/^ITEM: ATOMS/ { rows = 1; next } /^ITEM/ { rows = 0 } rows && $10 != 0 { spins++ } END { exit !(spins > 50) }' space.dump ||
    complain "spheres without spins"

# --- a sheared cell: lengths and tilt are those of the lattice, and bodies lie in it
run periodic-shear --quick -q --no-figures --set output.paraview=no --set particles.count=60 -o cell
expect 0 'frames$' "$scree" export cell -o cell.dump
awk '/^ITEM: BOX BOUNDS xy xz yz pp pp ff/ { getline; low = $1; high = $2; tilt = $3; getline; height = $2 - $1; tilted = 1; next }
     /^ITEM: BOX/ { tilted = 0 }
     /^ITEM: ATOMS/ { rows = tilted; next } /^ITEM/ { rows = 0 }
     rows { width = high - low - (tilt < 0 ? -tilt : tilt); origin = low - (tilt < 0 ? tilt : 0); f = $4 / height
            x = ($3 - origin - f * tilt) / width; seen++; if (x < -0.3 || x > 1.3 || f < -0.3 || f > 1.3) out++ }
     END { exit !(seen > 500 && out == 0) }' cell.dump || complain "bodies outside of the tilted box"
strain=$(awk -F, 'NR == 1 { for (k = 1; k <= NF; k++) if ($k ~ /^strain_shear /) c = k } NR > 1 && $c != "" { last = $c } END { print last }' cell/series.csv)
tilt=$(awk '/^ITEM: BOX BOUNDS xy/ { getline; t = $3; getline; h = $2 - $1 } END { print t / h }' cell.dump)
[ -n "$strain" ] || complain "no shear strain in series.csv"
awk -v a="$strain" -v b="$tilt" 'BEGIN { t = b - a; exit !(t - int(t + (t < 0 ? -0.5 : 0.5)) < 2e-2 && t - int(t + (t < 0 ? -0.5 : 0.5)) > -2e-2) }' ||
    complain "tilt over height $tilt is not the shear strain $strain (but for whole cells)"
finish
