#!/usr/bin/env bash
# Memory of each process while the steps of a stage run, whose samples are taken in parts: spheres on a lattice above a
# plate that shakes, on several numbers of processes. Resident memory (VmRSS) is read while rows of series.csv are written,
# behind the preparation of the whole, which process 0 does. Usage: bench/ranks_memory.sh build-mpi/scree [SPHERES [PROCESSES...]]
set -u
program=$(realpath "${1:?the program, built with MPI}")
count=${2:-200000}
processes=("${@:3}")
[ ${#processes[@]} -gt 0 ] || processes=(1 2 4 8)
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
cat >bed.yaml <<CASE
scree: 1
name: bed
dimension: 3
seed: 15
gravity: [0, 0, -9.81]
materials: [{name: rock, young_modulus: 1 MPa, density: 2500 kg/m3, friction: 0.5, restitution: 0.5}]
particles: {shape: sphere, material: rock, distribution: equal, radius: 1.5 mm, count: $count}
contact: {law: hertz_mindlin, tangential_history: rescaled}
integrator: {scheme: velocity_verlet, step_fraction: 0.3}
walls: [{shape: plane, name: floor, point: [0, 0, 0], normal: [0, 0, 1], motion: vibration, amplitude: [0, 0, 1 mm], frequency: 100 1/s}]
stages:
  - {stage: prepare, method: cubic}
  - {stage: relax, name: press, duration: 1 ms, walls: move}
measure: {samples: 20, cells: no}
output: {snapshots: 2, figures: no}
CASE
rows() { if [ -e out/series.csv ]; then wc -l <out/series.csv; else echo 0; fi; }
# Resident memory of the process `$1` and those that it has started, MB, one a line.
memory() {
    local pid
    for pid in "$1" $(pgrep -P "$1"); do
        [ "$(readlink "/proc/$pid/exe")" = "$program" ] && awk '/^VmRSS/ {printf "%.1f\n", $2 / 1024}' "/proc/$pid/status"
    done
}
echo "| processes | spheres of each | MiB of each, least | most | whole states |"
echo "|---|---|---|---|---|"
for n in "${processes[@]}"; do
    rm -rf out
    if [ "$n" = 1 ]; then "$program" run bed.yaml -o out --threads 1 --quiet & else
        mpirun --oversubscribe -n "$n" "$program" run bed.yaml -o out --threads 1 --quiet </dev/null & fi
    job=$!
    seen=
    while kill -0 $job 2>/dev/null; do
        if [ "$(rows)" -ge 8 ] && [ "$(rows)" -le 18 ]; then seen=$(memory $job); fi
        sleep 0.2
    done
    wait $job || { echo "the run on $n processes failed" >&2; exit 1; }
    echo "| $n | $((count / n)) | $(sort -n <<<"$seen" | head -n 1) | $(sort -n <<<"$seen" | tail -n 1) | $(grep -o 'process 0 alone, for: .*' out/log.txt | cut -d: -f2) |"
done
