#!/usr/bin/env bash
# scree check DIR, and going on from snapshots and from folders with damage.
# shellcheck source=tests/cli/check.sh
. "$(dirname "$0")/check.sh"
# What HDF5 itself loses of damaged files is told apart by its frames (leaks.supp).
export ASAN_OPTIONS=fast_unwind_on_malloc=0

cat >small.yaml <<'EOF'
scree: 1
name: small
seed: 3
gravity: [0, -10]
materials:
  - {name: quartz, young_modulus: 30 GPa, density: 2.675e8 kg/m3, friction: 0.45, restitution: 0.2}
particles: {material: quartz, count: 30, radius_min: 0.6 mm, radius_max: 0.9 mm}
contact: {law: hertz_mindlin, reference_velocity: 1e-4 m/s}
integrator: {scheme: velocity_verlet, step: 2e-5 s}
measure: {samples: 10, cells: no}
output: {snapshots: 2, paraview: no, figures: no, checkpoint_steps: 130}
walls:
  - {shape: box, lower: [0, 0], upper: [12 mm, 60 mm]}
stages:
  - {stage: prepare, method: gas, width: 12 mm, solid_fraction: 20 %, velocity: 10 mm/s}
  - {stage: relax, duration: 8 ms}
EOF
expect 0 '' "$scree" run small.yaml -o whole -q
sum=$("$scree" get whole state_checksum)
cp -r whole before

# --- a whole folder
expect 0 'run --restart whole --from NUMBER' "$scree" check whole
for line in 'case.yaml +whole +small' 'summary.json +whole +status done' 'series.csv +whole +11 rows' \
    'run.h5 +whole +snapshots and checkpoints' 'snapshot 0 +whole +step 0,' 'snapshot 3 +whole +step 400,.* 11 rows' \
    'checkpoint 3 +whole +step 400' 'checkpoint 3: scree run --restart whole' 'snapshots 0 1 2 3: '; do
    grep -qE "^$line" <<<"$output" || complain "check whole does not say '$line': $output"
done
same "$(diff -r before whole && echo same)" same 'check has changed the folder'
expect 4 'directory, not a case file' "$scree" check /

# --- from a snapshot
for from in 0 1 2 3 latest; do
    rm -rf part && cp -r whole part
    expect 0 '' "$scree" run --restart part --from $from -q --threads 2
    same "$("$scree" get part state_checksum)" "$sum" "from $from"
    same "$(cat part/series.csv)" "$(cat whole/series.csv)" "rows from $from"
    step=$("$scree" check whole | sed -nE "s/^snapshot $from .* step ([0-9]+),.*/\\1/p")
    grep -q "goes on from step ${step:-400}," part/log.txt || complain "the log does not say that it went on from $from"
done
expect 2 "there is no snapshot 9 in 'part'" "$scree" run --restart part --from 9
expect 2 "'last' is no snapshot" "$scree" run --restart part --from last
expect 2 'goes with --restart' "$scree" run small.yaml -o other --from 1

# --- one byte of the finished run.h5
size=$(stat -c %s whole/run.h5)
rm -rf part && cp -r whole part
printf 'x' | dd of=part/run.h5 bs=1 seek=$((size / 2)) conv=notrunc status=none
expect 4 'of what .part. holds is damaged' "$scree" check part
grep -qE '^run.h5 +damaged' <<<"$output" || complain "run.h5 is not damaged: $output"
same "$(grep -cE '^(snapshot|checkpoint) [0-9]+ +damaged' <<<"$output")" 1 'damaged snapshots and checkpoints'
expect 0 'warning: .* is damaged and left out' "$scree" run --restart part -q
expect 0 'run.h5.damaged +left over' "$scree" check part
same "$("$scree" get part state_checksum)" "$sum" 'after damage'

# --- rows are gone, and the case
rm -rf part && cp -r whole part
sed -i '5,$d' part/series.csv
expect 0 'nothing can go on from it: .*holds 3 rows, the checkpoint was taken after 11' "$scree" check part
expect 0 'snapshot 1 is used' "$scree" run --restart part -q
same "$(cat part/series.csv)" "$(cat whole/series.csv)" 'rows after rows were lost'
echo 'seed: [' >>part/case.yaml
expect 4 'case.yaml +damaged' "$scree" check part

finish
