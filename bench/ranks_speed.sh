#!/usr/bin/env bash
# Speed of a run on several processes: a settled bed of 256,000 spheres (bench/data/bed32k.csv.gz eight times beside itself,
# hertz_mindlin with history and ledger, steps of 1e-5 s), by one process of either build, by two threads and by two
# processes, in turn, and by LAMMPS on one and two processes where it is installed.
# Usage: bench/ranks_speed.sh build/scree build-mpi/scree [TURNS [COPIES]]
# Time of steps: a run of 500 steps less one of 100, so that reading, lists of the begin and files are out of it; the least
# of TURNS (3). Only on idle cores it says something.
set -euo pipefail
alone=$(realpath "${1:?the program built without MPI}")
together=$(realpath "${2:?the program built with MPI}")
turns=${3:-3} copies=${4:-8}
here=$(dirname "$(realpath "$0")")
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
# Copies along x, by pairs along y.
zcat "$here/data/bed32k.csv.gz" | awk -F, -v copies="$copies" -v side=0.05728 '
    !/^#/ && $1 + 0 > 0 { row[++n] = $0 }
    END {
        rows = copies > 1 ? 2 : 1; columns = copies / rows
        printf "bed\n\n%d atoms\n1 atom types\n0 %.17g xlo xhi\n0 %.17g ylo yhi\n0 0.06 zlo zhi\n\nAtoms # sphere\n\n", n * copies, side * columns, side * rows
        for (c = 0; c < copies; c++) for (k = 1; k <= n; k++) { split(row[k], v, ","); i = int(c / rows); j = c % rows
            printf "%d 1 %.17g 2500 %.17g %.17g %.17g\n", c * n + k, 2 * v[2], v[3] + i * side, v[4] + j * side, v[5] }
        printf "\nVelocities\n\n"
        for (c = 0; c < copies; c++) for (k = 1; k <= n; k++) { split(row[k], v, ","); printf "%d %s %s %s %s %s %s\n", c * n + k, v[6], v[7], v[8], v[9], v[10], v[11] }
    }' >bed.data
spheres=$(awk '/atoms/ { print $1; exit }' bed.data)
cat >bed.yaml <<YAML
scree: 1
name: bed
dimension: 3
seed: 1
gravity: [0, 0, -9.81]
materials: [{name: glass, young_modulus: 5 MPa, poisson_ratio: 0.3, density: 2500 kg/m3, friction: 0.5, restitution: 0.3}]
particles: {shape: sphere, material: glass}
contact: {law: hertz_mindlin}
integrator: {scheme: velocity_verlet, step: 1e-5 s}
boundary: {periodic: xy}
walls: [{shape: plane, name: floor, point: [0, 0, 0], normal: [0, 0, 1]}]
stages:
  - {stage: prepare, method: file, file: bed.data}
  - {stage: relax, duration: 1 ms}
measure: {samples: 1, cells: no}
output: {snapshots: 0, figures: no, paraview: no, checkpoint_interval: 1000000 s}
guard: {stability: warn}
YAML
# once STEPS THREADS COMMAND...: seconds of a run.
once() {
    local steps=$1 threads=$2 begin
    shift 2
    begin=$(date +%s.%N)
    "$@" run bed.yaml -o out --force --quiet --threads "$threads" --set stages.relax.duration="$((10 * steps)) us" </dev/null >run.txt 2>&1 ||
        { cat run.txt >&2; return 1; }
    awk -v begin="$begin" -v end="$(date +%s.%N)" 'BEGIN { print end - begin }'
}
least() { awk -v a="${1:-1e9}" -v b="$2" 'BEGIN { print a < b ? a : b }'; }
names=("one process" "one process, built with MPI" "two threads" "two processes")
declare -A short long
for ((turn = 0; turn < turns; turn++)); do
    for k in 0 1 2 3; do
        case $k in
        0) command=("$alone") threads=1 ;;
        1) command=("$together") threads=1 ;;
        2) command=("$alone") threads=2 ;;
        3) command=(mpirun --bind-to core -n 2 "$together") threads=1 ;;
        esac
        seconds=$(once 100 $threads "${command[@]}")
        short[$k]=$(least "${short[$k]:-}" "$seconds")
        seconds=$(once 500 $threads "${command[@]}")
        long[$k]=$(least "${long[$k]:-}" "$seconds")
    done
done
echo "$spheres spheres"
echo "| | million particle-steps/s | over one process |"
echo "|---|---|---|"
for k in 0 1 2 3; do
    awk -v name="${names[$k]}" -v n="$spheres" -v s="${short[$k]}" -v l="${long[$k]}" -v s0="${short[0]}" -v l0="${long[0]}" \
        'BEGIN { printf "| %s | %.2f | %.3f |\n", name, n * 400 / (l - s) / 1e6, (l0 - s0) / (l - s) }'
done
command -v lmp >/dev/null || exit 0
for n in 1 2; do
    mpirun --bind-to core -n $n lmp -in "$here/peers/lammps_spheres.in" -var data bed.data -var young 5e6 -var poisson 0.3 -var restitution 0.3 \
        -var friction 0.5 -var gravity 9.81 -var step 1e-5 -var skin 2e-4 -var steps 200 -var wall_normal 3.663004e6 -var wall_tangential 4.524887e6 \
        -log none </dev/null | awk -v n=$n '/^Loop time/ { printf "| LAMMPS, processes: %d | %.2f | |\n", n, $9 * $12 / $4 / 1e6 }'
done
