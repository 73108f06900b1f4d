#!/bin/bash
# What a run on several processes sends: bench/ranks.sh SCREE [COUNT [STEPS [PROCESSES...]]]. SCREE is built with MPI. A
# periodic packing of COUNT (20,000) spheres, then discs, is pressed on one process; then STEPS (60) steps of shear follow
# on 1, 2, 4 ... 64 processes, more than there are cores (mpirun --oversubscribe): counts are exact all the same, times
# say nothing. Prints a table of each dimension, and fits of the ghosts of a process (bench/ranks_fit.py). The folder
# bench-ranks holds the runs; packings that are there are used again.
set -euo pipefail
scree=$(realpath "${1:?usage: bench/ranks.sh SCREE [COUNT [STEPS [PROCESSES...]]]}")
count=${2:-20000} steps=${3:-60}
shift $(($# < 3 ? $# : 3))
processes=("$@")
[ $# -gt 0 ] || processes=(1 2 4 8 16 32 64)
here=$(dirname "$(realpath "$0")")
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
mkdir -p bench-ranks
cd bench-ranks

# write_case DIMENSION DURATION: pressed, and sheared for so long.
write_case() {
    local shape=sphere per=xyz fraction=34 plane=xz
    [ "$1" = 2 ] && shape=disc per=xy fraction=50 plane=xy
    cat <<YAML
scree: 1
name: ranks
dimension: $1
seed: 1
materials: [{name: glass, young_modulus: 10 MPa, density: 2500 kg/m3, friction: 0.5, restitution: 0.3}]
particles: {shape: $shape, material: glass, radius_min: 0.8 mm, radius_max: 1.2 mm, count: $count}
contact: {law: hertz_mindlin}
integrator: {scheme: velocity_verlet, step_fraction: 0.3}
boundary: {periodic: $per}
stages:
  - {stage: prepare, method: gas, solid_fraction: $fraction %}
  - {stage: confine, pressure: 10 kPa, friction: 0, unbalanced_limit: 0.1}
  - {stage: deform, velocity_gradient: {$plane: 1 1/s}, strain: $2}
measure: {samples: 1, cells: no}
output: {snapshots: 1, figures: no, paraview: no}
YAML
}

# result FOLDER NAME
result() { "$scree" get "$1" "$2" 2>/dev/null || echo -; }

for dimension in 3 2; do
    bed=bed-$dimension-$count
    write_case $dimension 1e-5 >"$bed.yaml"
    [ "$(result "$bed" status)" = done ] || "$scree" run "$bed.yaml" -o "$bed" --force --quiet 2>/dev/null
    strain=$(awk "BEGIN { print $steps * $(result "$bed" step_size) }")
    write_case $dimension "$strain" >counted.yaml
    printf '%d bodies in %dD, %d steps\n' "$count" $dimension "$steps"
    printf '%9s %9s %9s %9s %9s %10s %7s %10s %9s %9s  %s\n' processes bodies ghosts most neighbours bytes ratio reductions balance whole-MB checksum
    for n in "${processes[@]}"; do
        mpirun --oversubscribe -n "$n" "$scree" run counted.yaml --after "$bed" -o "run-$dimension-$n" --force --quiet --threads 1 >"run-$dimension-$n.txt" 2>&1 </dev/null ||
            { cat "run-$dimension-$n.txt"; exit 1; }
        # Numbers that only log.txt has: messages of steps, the process with most ghosts, bytes of whole states.
        awk -v n="$n" -v count="$count" -v checksum="$(result "run-$dimension-$n" state_checksum)" '
            / processes, a step of all of them/ { match($0, /\): [0-9.]+ messages, [0-9]+ bytes/); split(substr($0, RSTART + 3, RLENGTH), w, " "); messages = w[1]; bytes = w[3]
                                                  match($0, /reductions [0-9.]+ times/); split(substr($0, RSTART, RLENGTH), w, " "); ratio = w[2] }
            / a process: / { match($0, /process: .*$/); split(substr($0, RSTART), w, " "); ghosts = w[2]
                             match($0, /at most [0-9.]+\)/); split(substr($0, RSTART, RLENGTH), m, /[ )]/); most = m[3]
                             match($0, /[0-9.]+ reductions/); split(substr($0, RSTART, RLENGTH), m, " "); reductions = m[1]
                             match($0, /part has [0-9.]+/); split(substr($0, RSTART, RLENGTH), m, " "); balance = m[3]
                             match($0, /[0-9.e+-]+ MB sent/); split(substr($0, RSTART, RLENGTH), m, " "); whole = m[1] }
            END { if (n == 1) ratio = reductions = balance = whole = "-"
                  printf "%9d %9.0f %9.4g %9.4g %9.1f %10.0f %7s %10s %9s %9s  %s\n", n, count / n, ghosts, most, messages / n / 2, bytes / n, ratio, reductions, balance, whole, checksum }' \
            "run-$dimension-$n/log.txt" | tee -a "counts-$dimension.new"
    done
    mv "counts-$dimension.new" "counts-$dimension.txt"
    python3 "$here/ranks_fit.py" $dimension "$count" "counts-$dimension.txt"
done
