#!/usr/bin/env bash
# Memory of the processes of one run: process 0 prepares the whole sample, and puts it together where somebody looks at it;
# the others never hold it, nor does any of them when a run goes on from a checkpoint or a snapshot. Skipped without MPI.
# shellcheck source=tests/cli/processes.sh
. "$(dirname "$0")/processes.sh"
# shellcheck source=tests/cli/check.sh
. "$(dirname "$0")/check.sh"
need_processes

# Runs its arguments and leaves their largest resident set, kB, in peak-PROCESS.
cat >watch.sh <<'END'
"$@" &
pid=$!
while seen=$(awk '/^VmHWM/ {print $2}' "/proc/$pid/status" 2>/dev/null) && [ -n "$seen" ]; do
    peak=$seen
    sleep 0.02
done
wait $pid
status=$?
echo "$peak" >"peak-${OMPI_COMM_WORLD_RANK:-0}"
exit $status
END
watched() { rm -f peak-*; mpirun --oversubscribe -n "$1" bash watch.sh "$scree" run "${@:2}" --threads 1 --quiet 2>&1 </dev/null; }
# The process with most but process 0, kB; what one process has without a sample is not counted.
most_of_others() { cat peak-[1-9]* | sort -n | tail -n 1; }
# less_than_half WHAT: of what the sample takes on one process ($alone), each of the others has less than half.
less_than_half() {
    checks=$((checks + 1))
    [ $((2 * ($(most_of_others) - empty))) -lt $((alone - empty)) ] ||
        complain "$1: a process has $(most_of_others) kB, one alone $alone, without a sample $empty"
}

cat >bed.yaml <<'END'
scree: 1
name: bed
dimension: 3
seed: 15
gravity: [0, 0, -9.81]
materials: [{name: rock, young_modulus: 1 MPa, density: 2500 kg/m3, friction: 0.5, restitution: 0.5}]
particles: {shape: sphere, material: rock, distribution: equal, radius: 1.5 mm, count: 100000}
contact: {law: hertz_mindlin, tangential_history: rescaled}
integrator: {scheme: velocity_verlet, step_fraction: 0.3}
walls: [{shape: plane, name: floor, point: [0, 0, 0], normal: [0, 0, 1]}]
stages:
  - {stage: prepare, method: cubic}
  - {stage: relax, name: press, duration: 0.4 ms}
measure: {samples: 4, cells: no}
output: {snapshots: 2, figures: no, checkpoint_steps: 8}
END
# Small, on as many processes: libraries and buffers.
expect 0 '|warning' watched 4 bed.yaml -o small --set particles.count=64
empty=$(most_of_others)

# --- a preparation, and files made of the whole
expect 0 '|warning' watched 1 bed.yaml -o one
alone=$(cat peak-0)
expect 0 '|warning' watched 4 bed.yaml -o four --set output.paraview=yes
less_than_half 'a preparation of 100,000 spheres'
same "$(checksum four)" "$(checksum one)" 'prepared by process 0 of four'
wholes=$(grep -o 'whole states were put together.*' four/log.txt)
grep -q 'in process 0 alone, for: .*ParaView files ([1-9]' <<<"$wholes" || complain "where the whole is, and for whom: $wholes"
grep -q 'begins of stages' <<<"$wholes" && complain "a stage that can begin in parts has the whole: $wholes"

# --- a run that is killed goes on from a checkpoint, which each process reads a range of; then from a snapshot
"$scree" run bed.yaml -o killed --threads 1 --quiet >/dev/null 2>&1 &
job=$!
for ((i = 0; i < 6000; i++)); do [ -e killed/parts/checkpoint-000002.h5 ] && break; sleep 0.02; done
kill -9 $job
wait $job 2>/dev/null
cp -r killed again
expect 0 '|warning' watched 1 --restart killed
alone=$(cat peak-0)
expect 0 '|warning' watched 4 --restart again
grep -q 'goes on from step [1-9]' again/log.txt || complain 'the run goes on from its begin'
less_than_half 'a restart with 100,000 spheres'
same "$(checksum again)" "$(checksum killed)" 'four processes go on from a checkpoint of one'
expect 0 '|warning' watched 3 --restart four --from 0
grep -q 'goes on from step 0' four/log.txt || complain 'the run does not go on from the snapshot'
less_than_half 'a restart from a snapshot'
same "$(checksum four)" "$(checksum one)" 'three processes go on from a snapshot of four'
finish
