#!/usr/bin/env bash
# Speed of a run on several processes: a settled bed of 256,000 spheres (bench/data/bed32k.csv.gz eight times beside itself,
# hertz_mindlin with history and ledger, steps of 1e-5 s), by one process of either build, by two threads and by two
# processes with parts by counts and by time, by two runs that have nothing to do with each other, and by LAMMPS where it is installed, in turn.
# Usage: bench/ranks_speed.sh build/scree build-mpi/scree [TURNS [COPIES [STEPS]]]
# Speed of STEPS (400) steps as the program itself takes it (`scree get DIR particle_steps_per_second`: reading, the last
# snapshot and results are out of it). Each turn takes every way once; told are the medians of TURNS (5) and, as a machine
# changes in minutes, the median, least and largest of each turn's own ratio to one process. Only on idle cores it says something.
set -euo pipefail
alone=$(realpath "${1:?the program built without MPI}")
together=$(realpath "${2:?the program built with MPI}")
turns=${3:-5} copies=${4:-8} steps=${5:-400}
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
# speed FOLDER THREADS COMMAND...: particle-steps a second of a run, parts by $balance.
balance=counts
speed() {
    local folder=$1 threads=$2
    shift 2
    "$@" run bed.yaml --balance "$balance" -o "$folder" --force --quiet --threads "$threads" --set stages.relax.duration="$((10 * steps)) us" </dev/null >"$folder.txt" 2>&1 ||
        { cat "$folder.txt" >&2; return 1; }
    "$alone" get "$folder" particle_steps_per_second
}
# beside: two runs of one process at the same time, both speeds together: what the machine gives to two that never wait.
beside() {
    local other
    speed first 1 taskset -c 0 "$alone" >first.speed &
    other=$!
    speed second 1 taskset -c 1 "$alone" >second.speed && wait $other &&
        awk '{ sum += $1 } END { print sum }' first.speed second.speed
}
# lammps PROCESSES: the same of LAMMPS, half as many steps.
lammps() {
    mpirun --bind-to core -n "$1" lmp -in "$here/peers/lammps_spheres.in" -var data bed.data -var young 5e6 -var poisson 0.3 -var restitution 0.3 \
        -var friction 0.5 -var gravity 9.81 -var step 1e-5 -var skin 2e-4 -var steps $((steps / 2)) -var wall_normal 3.663004e6 -var wall_tangential 4.524887e6 \
        -log none </dev/null | awk '/^Loop time/ { print $9 * $12 / $4 }'
}
# median COLUMN FILE: the median, the least and the largest.
median() { cut -d' ' -f"$1" "$2" | sort -g | awk '{ v[NR] = $1 } END { print (v[int((NR + 1) / 2)] + v[int((NR + 2) / 2)]) / 2, v[1], v[NR] }'; }
names=("one process" "one process, built with MPI" "two threads" "two processes" "two processes, parts by time" "two runs of one process beside each other" "LAMMPS, one process" "LAMMPS, two processes")
ways=6
command -v lmp >/dev/null && ways=8
for ((turn = 0; turn < turns; turn++)); do
    for ((k = 0; k < ways; k++)); do
        case $k in
        0) value=$(speed out 1 "$alone") ;;
        1) value=$(speed out 1 "$together") ;;
        2) value=$(speed out 2 "$alone") ;;
        3) value=$(speed out 1 mpirun --bind-to core -n 2 "$together") ;;
        4) value=$(balance=time && speed out 1 mpirun --bind-to core -n 2 "$together") ;;
        5) value=$(beside) ;;
        6) value=$(lammps 1) ;;
        7) value=$(lammps 2) ;;
        esac
        echo "$turn $k $value"
    done
done >speeds.txt
echo "$spheres spheres, $steps steps, $turns turns"
echo "| | million particle-steps/s | over one process | least to largest |"
echo "|---|---|---|---|"
for ((k = 0; k < ways; k++)); do
    awk -v k=$k '$2 == 0 { one[$1] = $3 } $2 == k { print $3 / 1e6, $3 / one[$1] }' speeds.txt >way.txt
    echo "${names[$k]} | $(median 1 way.txt) | $(median 2 way.txt)" |
        awk -F' [|] ' '{ split($2, v, " "); split($3, r, " "); printf "| %s | %.2f | %.3f | %.3f to %.3f |\n", $1, v[1], r[1], r[2], r[3] }'
done
