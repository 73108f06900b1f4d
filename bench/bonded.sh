#!/bin/bash
# Bonded discs in a hexagonal lattice beside YADE's JCFpm (bench/peers/yade_bonded.py; Debian package yade), in turn, one
# thread each, processor times of the steps. bench/bonded.sh BUILD [ROUNDS]. 5000 discs of 1 mm with the mass of spheres,
# k_n = 1e7 N/m, k_t = k_n / 2, bonds that hold; the lowest and the highest row approach each other at 5 mm/s. Rates
# vary from run to run; only ratios measured in turn mean anything.
set -euo pipefail
build=$(realpath "${1:?usage: bench/bonded.sh BUILD [ROUNDS]}") rounds=${2:-3} steps=10000 peer_steps=1000
here=$(dirname "$(realpath "$0")")
folder=$build/bench/peers
mkdir -p "$folder"
cat >"$folder/bonded.yaml" <<END
name: bonded
materials: [{name: rock, normal_stiffness: 1e7 N/m, stiffness_ratio: 0.5, damping_ratio: 0, density: 2000 kg/m3, young_modulus: 10 GPa, poisson_ratio: 0.25, friction: 0.5}]
contact: {law: linear}
particles: {shape: disc, material: rock, count: 5000, distribution: equal, radius: 1 mm, thickness: 1.3333333 mm}
selections: [{select: side, name: low, side: bottom}, {select: side, name: high, side: top}]
loads:
  - {load: prescribed, name: low, selection: low, from: press, velocity_x: 0, velocity_y: 5 mm/s, spin_z: 0}
  - {load: prescribed, name: high, selection: high, from: press, velocity_x: 0, velocity_y: -5 mm/s, spin_z: 0}
integrator: {step: 1e-7 s}
stages: [{stage: prepare, method: hexagonal, aspect_ratio: 1}, {stage: bond}, {stage: relax, name: press, boundary: none, duration: $(awk "BEGIN { print $steps * 1e-7 }") s}]
measure: {cells: no, samples: 1}
output: {figures: no, paraview: no, snapshots: 0}
END
command -v yade >/dev/null || { echo "yade is not installed: no peer"; peer_steps=0; }
best=0 theirs=0
for ((round = 0; round < rounds; round++)); do
    "$build/scree" run "$folder/bonded.yaml" -o "$folder/bonded" --force --quiet --threads 1
    get() { "$build/scree" get "$folder/bonded" "$1"; }
    rate=$(awk "BEGIN { print $(get loading_force_evaluations) / $(get loading_processor_time) }")
    best=$(awk "BEGIN { print ($rate > $best ? $rate : $best) }")
    echo "scree: $rate steps/s"
    ((peer_steps)) || continue
    line=$(cd "$folder" && COUNT=5000 STEPS=$peer_steps STEP=1e-7 OMP_NUM_THREADS=1 yade -n -x -j1 "$here/peers/yade_bonded.py" 2>/dev/null | grep '^yade: ')
    echo "$line"
    rate=$(awk '{ print $7 / $9 }' <<<"$line")
    theirs=$(awk "BEGIN { print ($rate > $theirs ? $rate : $theirs) }")
done
((peer_steps)) && awk "BEGIN { printf \"best: scree %.0f, yade %.1f steps/s; ratio %.1f\n\", $best, $theirs, $best / $theirs }"
