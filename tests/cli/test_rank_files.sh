#!/usr/bin/env bash
# Snapshots and checkpoints that several processes write together: they hold what those of one process hold, and any number
# of processes goes on from them; a process that is killed while they are written leaves a folder to go on from; a full disk
# and a folder that is not shared end all processes with one message. Skipped without MPI.
# shellcheck source=tests/cli/processes.sh
. "$(dirname "$0")/processes.sh"
# shellcheck source=tests/cli/check.sh
. "$(dirname "$0")/check.sh"
need_processes compare_states forge_part
command -v h5diff >/dev/null || skip 'there is no h5diff (hdf5-tools)'
tools=$(dirname "$scree")/tests

# --- bonds that break in a sheared cell, in arrays that are large; polygons with corners and discs that fall and are taken
# out, so that ids have holes; spheres with rolling memory beside walls
cat >bonded.yaml <<'END'
scree: 1
name: bonded
seed: 9
materials: [{name: rock, young_modulus: 10 MPa, normal_stiffness: 1e4 N/m, stiffness_ratio: 0.5, damping_ratio: 0.1, density: 2500 kg/m3, friction: 0.5}]
particles: {shape: disc, material: rock, radius_min: 0.7 mm, radius_max: 1.3 mm, count: 700}
contact: {law: linear}
integrator: {scheme: velocity_verlet, step_fraction: 0.2}
boundary: {periodic: xy}
stages:
  - {stage: prepare, method: gas, solid_fraction: 60 %}
  - {stage: bond, gap_tolerance: 0.5 mm, tensile_strength: 0.4 N, shear_strength: 0.5 N}
  - {stage: deform, velocity_gradient: {xy: 60 1/s, yy: -10 1/s}, strain: 2 %}
measure: {samples: 4, cells: no}
output: {snapshots: 2, figures: no}
END
cat >heap.yaml <<'END'
scree: 1
name: heap
seed: 12
gravity: [0, -9.81]
materials: [{name: stone, young_modulus: 0.5 MPa, density: 2500 kg/m3, friction: 0.5, damping_constant: 0.5}]
particles:
  count: 160
  species: [{name: angular, material: stone, shape: polygon, radius_min: 0.8 mm, radius_max: 1.3 mm, share: 80 %, axis_ratio: 1.5}, {name: round, material: stone, shape: disc, distribution: equal, radius: 1 mm, share: 20 %}]
contact: {law: polygon_overlap}
integrator: {scheme: velocity_verlet, step_fraction: 0.4}
walls:
  - {shape: plane, name: left, point: [0, 0], normal: [1, 0]}
  - {shape: plane, name: right, point: [30 mm, 0], normal: [-1, 0]}
  - {shape: box, name: step, side: outside, lower: [0.1 mm, -6 mm], upper: [20 mm, -0.1 mm]}
loads: [{load: outlet, lower: [-1 m, -1 m], upper: [1 m, -0.5 mm], every: 20}]
stages:
  - {stage: prepare, method: gas, width: 30 mm, solid_fraction: 40 %}
  - {stage: relax, name: fall, duration: 30 ms}
measure: {samples: 4, cells: no}
output: {snapshots: 2, figures: no}
END
cat >roll.yaml <<'END'
scree: 1
name: roll
dimension: 3
seed: 5
materials: [{name: glass, young_modulus: 10 MPa, density: 2500 kg/m3, friction: 0.5, restitution: 0.5, surface_energy: 0.02 J/m2, rolling_friction: 0.1}]
particles: {shape: sphere, material: glass, radius_min: 1.3 mm, radius_max: 1.7 mm, count: 500}
contact: {law: hertz_jkr}
integrator: {scheme: velocity_verlet, step_fraction: 0.2}
boundary: {periodic: xyz}
stages:
  - {stage: prepare, method: gas, solid_fraction: 30 %}
  - {stage: confine, pressure: 5 kPa, unbalanced_limit: 0.3}
  - {stage: deform, velocity_gradient: {xz: 40 1/s}, strain: 1 %}
measure: {samples: 4, cells: no}
output: {snapshots: 2, figures: no}
END
declare -A steps=([bonded]=100 [heap]=900 [roll]=2500)

# What figures and people read of snapshots, beside the states.
same_snapshots() {
    local snapshot
    for snapshot in $(h5ls "$1/run.h5/snapshots" | cut -d' ' -f1); do
        checks=$((checks + 1))
        h5diff --exclude-path="/state" "$1/run.h5" "$2/run.h5" "/snapshots/$snapshot" "/snapshots/$snapshot" >differences.txt 2>&1
        grep -q '^dataset' differences.txt && complain "snapshot $snapshot of $2: $(cat differences.txt)"
    done
}

# same_files CASE FOLDER
same_files() {
    same "$(checksum "$2")" "$(checksum one-"$1")" "$1 in $2"
    expect 0 '^[1-9][0-9]* states are the same$' "$tools/compare_states" one-"$1" "$2"
    same_snapshots one-"$1" "$2"
    expect 0 'checkpoint [1-9]' "$scree" check "$2"
    checks=$((checks + 1)); [ "$("$scree" get "$2" processes_files_from_parts)" -gt 0 ] || complain "no file of $2 is from parts"
}

for name in bonded heap roll; do
    every=(--set output.checkpoint_steps=${steps[$name]} --threads 1)
    checks=$((checks + 1)); "$scree" run $name.yaml -o one-$name --quiet "${every[@]}" 2>/dev/null || complain "$name on one process"
    for ranks in 2 3; do
        expect 0 '|warning' on $ranks $name.yaml -o many-$name-$ranks "${every[@]}"
        same_files $name many-$name-$ranks
    done
    expect 0 '|warning' env SCREE_RANDOM_PARTS=7 mpirun --oversubscribe -n 3 "$scree" run $name.yaml -o random-$name --quiet "${every[@]}"
    same_files $name random-$name
done
checks=$((checks + 1)); [ "$("$scree" get one-heap outlet_outflow)" -gt 0 ] || complain 'no id of heap is a hole'

# --- a process dies while all write; the folder is whole, and any number of processes goes on from it
for delay in 0 0.003 0.02; do
    rm -rf killed
    mpirun --oversubscribe -n 3 "$scree" run bonded.yaml -o killed --set output.checkpoint_steps=16 --quiet --threads 1 >killed.txt 2>&1 </dev/null &
    job=$!
    for ((i = 0; i < 20000; i++)); do [ -e killed/parts/checkpoint-000003.h5.new ] && break; sleep 0.002; done
    sleep $delay
    victim=$(pgrep -P $job | tail -n 1)
    kill -9 "$victim"
    wait $job && complain 'mpirun went on without one of its processes'
    expect 0 'checkpoint [1-9]' "$scree" check killed
    checks=$((checks + 1)); grep -qi damaged <<<"$output" && complain "a file is damaged: $output"
    for ranks in 1 2 3; do
        rm -rf again
        cp -r killed again
        expect 0 '|warning' on $ranks --restart again
        same "$(checksum again)" "$(checksum one-bonded)" "restart on $ranks processes after a kill"
        checks=$((checks + 1)); grep -q 'goes on from step [1-9]' again/log.txt || complain "the run goes on from its begin"
    done
done

# --- a checkpoint that names a body which no process has, or one that was never given: the older one serves, and says why
# stop_at CASE STEPS CHECKPOINT: `killed`, a run that is killed when this checkpoint, one each so many steps, is there
stop_at() {
    rm -rf killed
    "$scree" run "$1.yaml" -o killed --set output.checkpoint_steps="$2" --quiet --threads 1 2>/dev/null &
    local job=$!
    for ((i = 0; i < 20000; i++)); do [ -e "killed/parts/checkpoint-00000$3.h5" ] && break; sleep 0.002; done
    kill -9 $job
    checks=$((checks + 1)); wait $job 2>/dev/null && complain "$1 had ended before it was killed"
    newest=$(basename "$(find killed/parts -name 'checkpoint-*.h5' | sort | tail -n 1)")
}
# forged CASE WORDS [DATASET ROW VALUE]...: in the newest checkpoint
forged() {
    local name=$1 words=$2 number ranks
    shift 2
    rm -rf forged
    cp -r killed forged
    number=$(grep -o '[0-9]\{6\}' <<<"$newest")
    while [ $# -gt 0 ]; do
        checks=$((checks + 1)); "$tools/forge_part" "forged/parts/$newest" "$((10#$number))" "$1" "$2" "$3" || complain "$newest cannot be forged"
        shift 3
    done
    for ranks in 1 2 3; do
        rm -rf again
        cp -r forged again
        expect 0 "checkpoint [0-9]* is used: .*$newest.*$words" on "$ranks" --restart again
        same "$(checksum again)" "$(checksum one-"$name")" "restart on $ranks processes from the checkpoint before a forged one"
    done
}
stop_at bonded 16 3
forged bonded "dataset 'persistent/second', .* 700 .accepted: the id of a body that is here" scalars/next_id 0 701 persistent/second -1 700
forged bonded "dataset 'id'" id 7 700
stop_at roll 1000 6
forged roll 'contacts/second.*: 500 is no body' scalars/next_id 0 501 contacts/second -1 500

# --- ParaView files and figures; a disk that is full; a folder that is not shared
expect 0 '|warning' "$scree" run heap.yaml -o seen-one --set output.paraview=yes --set output.figures=yes --threads 1 --quiet
expect 0 '|warning' on 2 heap.yaml -o seen --set output.paraview=yes --set output.figures=yes --threads 1
for file in seen-one/paraview/*.vtp; do
    checks=$((checks + 1)); cmp -s "$file" "seen/paraview/$(basename "$file")" || complain "$file of several processes differs"
done
same "$(cd seen/figures && ls)" "$(cd seen-one/figures && ls)" 'figures'
# The limit is for what Scree writes, so messages do not go through files.
limited() { mpirun --oversubscribe --mca btl tcp,self -n 2 bash -c "trap '' XFSZ; ulimit -f 100; exec '$scree' run bonded.yaml -o limited --threads 1 --quiet" 2>&1 </dev/null; }
expect 4 'process 0: cannot write .*too large; all processes end' limited
same "$(grep -c 'too large' <<<"$output")" 1 "one message: $output"
mkdir here there
apart() { mpirun --oversubscribe -n 1 -wdir here "$scree" run ../bonded.yaml -o out --quiet : -n 1 -wdir there "$scree" run ../bonded.yaml -o out --quiet 2>&1 </dev/null; }
expect 2 'process 1 does not see the folder .out. that process 0 has locked' apart
same "$(grep -c 'does not see' <<<"$output")" 1 "one message: $output"
finish
