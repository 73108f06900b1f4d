#!/usr/bin/env bash
# One run on several processes: the same bits for any number of them, in parts of space and in parts at random; what
# cannot be spread is refused by name; a process that is killed ends all, and any number goes on from the checkpoint.
# Skipped without MPI.
# shellcheck source=tests/cli/processes.sh
. "$(dirname "$0")/processes.sh"
# shellcheck source=tests/cli/check.sh
. "$(dirname "$0")/check.sh"
need_processes
program=$(dirname "$scree")/tests/check_ranks
several() { mpirun --oversubscribe -n "$1" "$program" "$2" 2>&1 </dev/null; }
for ranks in 1 2 3 4; do
    for seed in 1 2 3; do
        expect 0 "^ranks $ranks\$" several $ranks $seed
        same "$(wc -l <<<"$output")" 1 "lines of $ranks processes, seed $seed: $output"
    done
done

# --- cases: periodic and sheared; between plates where it repeats itself along x; in a drum; under a lid with a servo
materials='materials: [{name: glass, young_modulus: 10 MPa, density: 2500 kg/m3, friction: 0.5, restitution: 0.5}]'
discs='particles: {shape: disc, material: glass, radius_min: 0.7 mm, radius_max: 1.3 mm, count: 150}'
spheres='particles: {shape: sphere, material: glass, radius_min: 1.3 mm, radius_max: 1.7 mm, count: 120}'
rest='measure: {samples: 20, cells: no}
output: {snapshots: 2, figures: no}'
cat >shear.yaml <<EOF
scree: 1
name: shear
seed: 1
$materials
$discs
contact: {law: hertz_mindlin}
integrator: {scheme: velocity_verlet, step_fraction: 0.2}
boundary: {periodic: xy}
stages:
  - {stage: prepare, method: gas, solid_fraction: 45 %}
  - {stage: confine, pressure: 2 kPa, unbalanced_limit: 0.2}
  - {stage: deform, velocity_gradient: {xy: 20 1/s}, stress: {yy: 2 kPa}, strain: 10 %}
$rest
EOF
cat >layer.yaml <<EOF
scree: 1
name: layer
seed: 2
materials: [{name: glass, young_modulus: 1 MPa, density: 2500 kg/m3, friction: 0.5}]
$discs
contact: {law: hertz_brilliantov}
integrator: {scheme: two_timescales}
boundary: {periodic: x}
stages:
  - {stage: prepare, method: gas, aspect_ratio: 0.5, solid_fraction: 45 %}
  - {stage: confine, pressure: 1 kPa, unbalanced_limit: 0.9}
  - {stage: compress, rate: 5 1/s, strain: 0.05 %}
$rest
EOF
cat >drum.yaml <<EOF
scree: 1
name: drum
dimension: 3
seed: 3
gravity: [0, 0, -9.81]
$materials
$spheres
contact: {law: linear}
integrator: {scheme: position_verlet, step_fraction: 0.2}
walls:
  - {shape: cylinder, name: drum, start: [15 mm, -1 mm, 15 mm], end: [15 mm, 9 mm, 15 mm], radius: 23 mm, side: inside,
     ends: closed, spin: [0, 6 rad/s, 0], centre: [15 mm, 0, 15 mm]}
stages:
  - {stage: prepare, method: gas, width: 30 mm, depth: 8 mm, solid_fraction: 25 %}
  - {stage: relax, name: turn, walls: move, duration: 0.03 s}
$rest
EOF
cat >lid.yaml <<EOF
scree: 1
name: lid
seed: 4
gravity: [0, -9.81]
$materials
$discs
contact: {law: hertz_mindlin}
integrator: {scheme: velocity_verlet, step_fraction: 0.2}
loads: [{load: background_damping, translation: 0.2, rotation: 0.2}]
walls:
  - {shape: plane, name: left, point: [0, 0], normal: [1, 0]}
  - {shape: plane, name: right, point: [30 mm, 0], normal: [-1, 0]}
  - {shape: plane, name: floor, point: [0, 0], normal: [0, 1], motion: vibration, amplitude: [0, 0.3 mm], frequency: 100 1/s}
  - {shape: box, name: lid, side: outside, lower: [0.1 mm, 45 mm], upper: [29.9 mm, 50 mm], friction: 0, motion: servo,
     direction: [0, -1], force: 1 N, servo_gain: 5, servo_velocity: 0.5 m/s}
stages:
  - {stage: prepare, method: gas, width: 30 mm, solid_fraction: 40 %}
  - {stage: relax, name: settle, duration: 0.05 s, walls: stand}
  - {stage: relax, name: shake, duration: 0.05 s}
$rest
EOF
# A path in stress and strain, with grains that stick; layers that are driven and pushed, a piston among them.
cat >path.yaml <<EOF
scree: 1
name: path
dimension: 3
seed: 5
materials: [{name: glass, young_modulus: 10 MPa, density: 2500 kg/m3, friction: 0.5, restitution: 0.5, surface_energy: 0.02 J/m2, rolling_friction: 0.1}]
$spheres
contact: {law: hertz_jkr}
integrator: {scheme: velocity_verlet, step_fraction: 0.2}
boundary: {periodic: xyz}
stages:
  - {stage: prepare, method: gas, solid_fraction: 30 %}
  - {stage: confine, pressure: 5 kPa, unbalanced_limit: 0.3}
  - {stage: load_path, strain_rate: {zz: -5 1/s}, keep: volume, reverse_strain: 1 %, cycles: 1}
$rest
EOF
cat >block.yaml <<EOF
scree: 1
name: block
seed: 6
$materials
$discs
contact: {law: hertz_dmt}
integrator: {scheme: velocity_verlet, step_fraction: 0.2}
boundary: {periodic: x}
selections:
  - {select: band, name: floor, axis: y, measured: low, from: 0 mm, to: 3 mm}
  - {select: band, name: lid, axis: y, measured: high, from: 0 mm, to: 3 mm}
  - {select: band, name: some, axis: y, measured: low, from: 4 mm, to: 6 mm}
loads:
  - {load: prescribed, selection: floor, from: shear, velocity_x: 0, velocity_y: 0, spin_z: 0}
  - {load: prescribed, selection: lid, from: shear, velocity_x: {from: 0 m/s, to: 0.5 m/s, begin: 0 s, end: 5 ms, smooth: yes}, velocity_y: -5 mm/s, spin_z: 0, until_force: 0.2 N}
  - {load: prescribed, selection: some, from: shear, force_x: 1 mN, per: selection}
stages:
  - {stage: prepare, method: gas, aspect_ratio: 0.5, solid_fraction: 60 %}
  - {stage: confine, pressure: 1 kPa, unbalanced_limit: 0.3}
  - {stage: relax, name: shear, duration: 20 ms}
$rest
EOF
# Grains from a point, which has to wait for them to fall, and from a line that follows the top of the pile, onto a table
# above two that are driven: what falls off is taken out, beside it by an outlet, else below all that stands.
cat >pour.yaml <<EOF
scree: 1
name: pour
seed: 7
gravity: [0, -9.81]
materials: [{name: glass, young_modulus: 0.5 MPa, density: 2500 kg/m3, friction: 0.5, restitution: 0.5}]
particles: {shape: disc, material: glass, radius_min: 0.7 mm, radius_max: 1.3 mm, count: 32}
contact: {law: hertz_mindlin, tangential_history: rescaled}
integrator: {scheme: velocity_verlet, step_fraction: 0.2}
walls: [{shape: box, name: table, side: outside, lower: [-6 mm, -4 mm], upper: [6 mm, 0]}]
selections: [{select: ids, name: bar, ids: [0, 1]}]
loads: [{load: outlet, lower: [6 mm, -20 mm], upper: [40 mm, -2 mm], every: 20}, {load: prescribed, selection: bar, velocity_x: 50 mm/s, velocity_y: 0, spin_z: 0}]
sources:
  - {source: point, name: spout, place: [1 mm, 12 mm], interval: 2 ms, velocity: [0, -0.3], spread: [0.1, 0]}
  - {source: line, name: row, start: [-4 mm, 10 mm], end: [-1 mm, 10 mm], interval: 3 ms, velocity: [-0.1, -0.2], width: plateau, above: 6 mm, layer: 4}
stages:
  - {stage: prepare, method: bodies, bodies: [{position: [-12 mm, -8 mm], radius: 1 mm}, {position: [-14 mm, -6 mm], radius: 1 mm}]}
  - {stage: pour, past: take_out, unbalanced_limit: 0.5, rest_time: 8 ms}
$rest
EOF
# Layers of spheres into a hopper, until it is as full as wanted; what has run out is taken out.
cat >rain.yaml <<EOF
scree: 1
name: rain
dimension: 3
seed: 8
gravity: [0, 0, -9.81]
materials: [{name: glass, young_modulus: 0.2 MPa, density: 2500 kg/m3, friction: 0.5, restitution: 0.5}]
particles: {shape: sphere, material: glass, radius_min: 0.8 mm, radius_max: 1.2 mm, count: 90}
contact: {law: hertz_mindlin, tangential_history: rescaled}
integrator: {scheme: velocity_verlet, step_fraction: 0.2}
walls:
  - {shape: cone, name: funnel, start: [0, 0, 0], end: [0, 0, 8 mm], radius_start: 3 mm, radius_end: 7 mm, ends: open}
  - {shape: cylinder, name: silo, start: [0, 0, 8 mm], end: [0, 0, 40 mm], radius: 7 mm, ends: open}
  - {shape: plane, name: floor, point: [0, 0, -10 mm], normal: [0, 0, 1]}
loads: [{load: outlet, lower: [-1 m, -1 m, -1 m], upper: [1 m, 1 m, 1 mm], every: 20}]
sources: [{source: region, name: cloud, lower: [-4 mm, -4 mm, 16 mm], upper: [4 mm, 4 mm, 16 mm], batch: layer, interval: 5 ms, velocity: [0, 0, -0.3]}]
stages:
  - {stage: prepare, method: empty}
  - {stage: pour, name: fill, count: 45}
  - {stage: relax, name: flow, duration: 10 ms}
  - {stage: pour, name: more, height: 6 mm}
$rest
EOF
# Bonds with gaps of half a radius in a cell that is sheared until they break, and part; a lattice that is pulled apart, of
# which nothing moves in some parts at first.
cat >bonded.yaml <<EOF
scree: 1
name: bonded
seed: 9
materials: [{name: rock, young_modulus: 10 MPa, normal_stiffness: 1e4 N/m, stiffness_ratio: 0.5, damping_ratio: 0.1, density: 2500 kg/m3, friction: 0.5}]
particles: {shape: disc, material: rock, radius_min: 0.7 mm, radius_max: 1.3 mm, count: 150}
contact: {law: linear}
integrator: {scheme: velocity_verlet, step_fraction: 0.2}
boundary: {periodic: xy}
stages:
  - {stage: prepare, method: gas, solid_fraction: 60 %}
  - {stage: bond, gap_tolerance: 0.5 mm, tensile_strength: 0.4 N, shear_strength: 0.5 N}
  - {stage: deform, velocity_gradient: {xy: 60 1/s, yy: -10 1/s}, strain: 15 %}
$rest
EOF
cat >strip.yaml <<EOF
scree: 1
name: strip
seed: 10
materials: [{name: rock, normal_stiffness: 1e7 N/m, stiffness_ratio: 0.5, damping_ratio: 0.02, density: 2000 kg/m3, young_modulus: 1 GPa, friction: 0.5}]
contact: {law: linear}
particles: {shape: disc, material: rock, count: 120, distribution: equal, radius: 1 mm, thickness: 10 mm}
selections:
  - {select: band, name: floor, axis: y, measured: low, from: 0 mm, to: 3 mm}
  - {select: band, name: lid, axis: y, measured: high, from: 0 mm, to: 3 mm}
loads:
  - {load: background_damping, translation: 0.1, rotation: 0.1}
  - {load: prescribed, selection: floor, velocity_x: 0, velocity_y: 0, spin_z: 0}
  - {load: prescribed, selection: lid, velocity_x: 0, velocity_y: 1 m/s, spin_z: 0}
stages:
  - {stage: prepare, method: hexagonal, aspect_ratio: 2}
  - {stage: bond, tensile_strength: 100 N, shear_strength: 25 N, scatter: normal, scatter_deviation: 0.15}
  - {stage: relax, name: pull, boundary: none, duration: 0.4 ms}
$rest
EOF
# Polygons, and discs among them, poured on a step, sharp or rounded; with a potential, in a sheared cell.
cat >heap.yaml <<EOF
scree: 1
name: heap
seed: 12
gravity: [0, -9.81]
materials: [{name: stone, young_modulus: 0.5 MPa, density: 2500 kg/m3, friction: 0.5, damping_constant: 0.5}]
particles:
  count: 30
  species: [{name: angular, material: stone, shape: polygon, radius_min: 0.8 mm, radius_max: 1.3 mm, share: 70 %, axis_ratio: 1.5}, {name: round, material: stone, shape: disc, distribution: equal, radius: 1 mm, share: 30 %}]
contact: {law: polygon_overlap}
integrator: {scheme: velocity_verlet, step_fraction: 0.2}
walls: [{shape: plane, name: floor, point: [0, 0], normal: [0, 1]}, {shape: box, name: step, side: outside, lower: [-9 mm, -1 mm], upper: [-3 mm, 2 mm]}]
sources:
  - {source: line, name: row, start: [-6 mm, 10 mm], end: [6 mm, 10 mm], interval: 0.7 ms, velocity: [0.1, -0.4], above: 6 mm}
stages:
  - {stage: prepare, method: empty}
  - {stage: pour, count: 30}
  - {stage: relax, name: fall, duration: 8 ms}
$rest
EOF
cat >cell.yaml <<EOF
scree: 1
name: cell
seed: 13
materials: [{name: glass, young_modulus: 10 MPa, density: 2500 kg/m3, friction: 0.5}]
particles: {shape: polygon, material: glass, radius_min: 0.7 mm, radius_max: 1.3 mm, count: 70}
contact: {law: polygon_potential}
integrator: {scheme: velocity_verlet, step_fraction: 0.4}
boundary: {periodic: xy}
stages:
  - {stage: prepare, method: gas, solid_fraction: 60 %}
  - {stage: confine, pressure: 50 kPa, unbalanced_limit: 0.9}
  - {stage: deform, velocity_gradient: {xy: 200 1/s}, stress: {yy: 50 kPa}, strain: 8 %}
$rest
EOF
sed 's/name: heap/name: rounded/; s/shape: polygon,/shape: polygon, rounding: 0.2,/; s/polygon_overlap/hertz_mindlin, tangential_history: rescaled/; s/, damping_constant: 0.5//' heap.yaml >rounded.yaml
# Grains that fall asleep where they lie, and wake when others fall on them. Gear's scheme, whose velocities lead, on a table
# that shakes, of which not all parts have the fastest body.
cat >nap.yaml <<EOF
scree: 1
name: nap
seed: 14
gravity: [0, -9.81]
materials: [{name: glass, young_modulus: 0.5 MPa, density: 2500 kg/m3, friction: 0.5, restitution: 0.3}]
particles: {shape: disc, material: glass, radius_min: 0.7 mm, radius_max: 1.3 mm, count: 45}
contact: {law: hertz_mindlin, tangential_history: rescaled}
integrator: {scheme: velocity_verlet, step_fraction: 0.4}
loads: [{load: background_damping, translation: 0.5, rotation: 0.5}]
walls: [{shape: plane, name: floor, point: [0, 0], normal: [0, 1]}]
sources: [{source: line, name: row, start: [-5 mm, 8 mm], end: [5 mm, 8 mm], interval: 2 ms, velocity: [0, -0.2], above: 5 mm}]
stages:
  - {stage: prepare, method: empty}
  - {stage: pour, count: 45, sleep_window: 2 ms, sleep_force: 0.1, sleep_motion: 0.05}
  - {stage: relax, name: fall, duration: 2 ms}
$rest
EOF
cat >gear.yaml <<EOF
scree: 1
name: gear
dimension: 3
seed: 15
gravity: [0, 0, -9.81]
materials: [{name: rock, young_modulus: 1 MPa, density: 2500 kg/m3, friction: 0.5, restitution: 0.5}]
particles: {shape: sphere, material: rock, distribution: equal, radius: 1.5 mm, count: 64}
contact: {law: hertz_mindlin, tangential_history: rescaled}
integrator: {scheme: gear, step_fraction: 0.3}
walls: [{shape: plane, name: floor, point: [0, 0, 0], normal: [0, 0, 1], motion: vibration, amplitude: [0, 0, 1 mm], frequency: 100 1/s}]
stages:
  - {stage: prepare, method: cubic}
  - {stage: relax, name: press, duration: 8 ms, walls: move}
$rest
EOF
sed -i "s/cells: no/cells: no, orientation: yes/" gear.yaml
# Pressure on the Delaunay boundary, which is found anew many times and loses some of its bodies; the same in space; plates on
# all sides, then the pressure on two of them.
cat >sides.yaml <<EOF
scree: 1
name: sides
seed: 16
$materials
$discs
contact: {law: hertz_mindlin}
integrator: {scheme: velocity_verlet, step_fraction: 0.2}
boundary: {lateral: pressure, every: 60}
loads: [{load: outlet, lower: [14 mm, 14 mm], upper: [40 mm, 18 mm], every: 2500}]
stages:
  - {stage: prepare, method: drop_and_roll, aspect_ratio: 2}
  - {stage: confine, pressure: 4 kPa, unbalanced_limit: 0.3, friction: 0.05}
  - {stage: compress, strain: 4 %, rate: 10 1/s}
$rest
EOF
# The same around long polygons: gaps are those between outlines, which all processes have to know.
sed 's/name: sides/name: flanks/; s/step_fraction: 0.2/step_fraction: 0.4/; s/, restitution: 0.5//; s/shape: disc,/shape: polygon, axis_ratio: 2,/; s/law: hertz_mindlin/law: polygon_overlap/; s/method: drop_and_roll, aspect_ratio: 2/method: growth/; s/, unbalanced_limit: 0.3, friction: 0.05/, unbalanced_limit: 0.3/' sides.yaml >flanks.yaml
cat >core.yaml <<EOF
scree: 1
name: core
dimension: 3
seed: 17
$materials
$spheres
contact: {law: hertz_mindlin, tangential_history: rescaled}
integrator: {scheme: velocity_verlet, step_fraction: 0.4}
boundary: {lateral: pressure, every: 30}
stages:
  - {stage: prepare, method: drop_and_roll, aspect_ratio: 1.5}
  - {stage: confine, pressure: 4 kPa, unbalanced_limit: 0.9}
  - {stage: compress, strain: 2 %, rate: 20 1/s}
$rest
EOF
cat >mould.yaml <<EOF
scree: 1
name: mould
seed: 18
materials: [{name: glass, young_modulus: 10 MPa, density: 2500 kg/m3, friction: 0.5, restitution: 0.2}]
particles: {shape: disc, material: glass, radius_min: 0.7 mm, radius_max: 1.3 mm, count: 60}
contact: {law: linear}
integrator: {scheme: position_verlet, step_fraction: 0.6}
boundary: {every: 30}
stages:
  - {stage: prepare, method: drop_and_roll, aspect_ratio: 1}
  - {stage: confine, boundary: plates, pressure: 8 kPa, unbalanced_limit: 0.9}
  - {stage: compress, boundary: plates, name: press, strain: 0.5 %, rate: 10 1/s}
  - {stage: compress, boundary: pressure, strain: 6 %, rate: 20 1/s}
$rest
EOF
# Rates that are imposed on the boundary itself.
cat >loose.yaml <<EOF
scree: 1
name: loose
seed: 19
$materials
$discs
contact: {law: hertz_mindlin}
integrator: {scheme: velocity_verlet, step_fraction: 0.4}
boundary: {every: 40}
stages:
  - {stage: prepare, method: drop_and_roll, aspect_ratio: 1.5}
  - {stage: confine, boundary: pressure, pressure: 4 kPa, unbalanced_limit: 0.9}
  - {stage: deform, boundary: minimal, velocity_gradient: {yy: -20 1/s}, strain: 2 %}
  - {stage: deform, boundary: affine, name: stiff, velocity_gradient: {xx: 0, xy: 20 1/s, yx: 20 1/s, yy: 0}, strain: 0.5 %}
$rest
EOF
cat >ball.yaml <<EOF
scree: 1
name: ball
dimension: 3
seed: 20
$materials
$spheres
contact: {law: hertz_mindlin, tangential_history: rescaled}
integrator: {scheme: velocity_verlet, step_fraction: 0.4}
boundary: {every: 40}
stages:
  - {stage: prepare, method: drop_and_roll, aspect_ratio: 1}
  - {stage: confine, boundary: minimal, pressure: 4 kPa, unbalanced_limit: 0.9}
  - {stage: deform, boundary: minimal, velocity_gradient: {zz: -20 1/s}, strain: 8 %}
  - {stage: deform, boundary: affine, name: stiff, velocity_gradient: {xx: 0, yy: 0, zz: -20 1/s, xy: 0, xz: 0, yx: 0, yz: 0, zx: 0, zy: 0}, strain: 0.3 %}
$rest
EOF
# A membrane around a sample that was pressed before, and from the begin; in space.
cat >sleeve.yaml <<EOF
scree: 1
name: sleeve
seed: 21
$materials
$discs
contact: {law: hertz_mindlin}
integrator: {scheme: velocity_verlet, step_fraction: 0.2}
boundary: {lateral: membrane, membrane_stiffness: 1 N/mm, every: 60}
stages:
  - {stage: prepare, method: drop_and_roll, aspect_ratio: 2}
  - {stage: confine, boundary: pressure, pressure: 4 kPa, unbalanced_limit: 0.9}
  - {stage: confine, name: wrap, pressure: 4 kPa, unbalanced_limit: 0.5}
  - {stage: compress, strain: 2 %, rate: 10 1/s}
$rest
EOF
cat >tube.yaml <<EOF
scree: 1
name: tube
dimension: 3
seed: 22
$materials
$spheres
contact: {law: hertz_mindlin, tangential_history: rescaled}
integrator: {scheme: position_verlet, step_fraction: 0.4}
boundary: {lateral: membrane, membrane_stiffness: 100 N/m, every: 30}
stages:
  - {stage: prepare, method: drop_and_roll, aspect_ratio: 1.5}
  - {stage: confine, pressure: 4 kPa, unbalanced_limit: 0.9, stress_tolerance: 0.3}
  - {stage: compress, strain: 0.5 %, rate: 20 1/s}
$rest
EOF
# Discs that deform under the pressure on their boundary, listened to at two places and in layers; spheres that deform; a disc
# that is turned.
cat >soft.yaml <<EOF
scree: 1
name: soft
seed: 23
materials: [{name: gel, young_modulus: 100 kPa, poisson_ratio: 0.3, density: 1000 kg/m3, friction: 0.3, normal_stiffness: 50 kN/m, stiffness_ratio: 0.5, damping_ratio: 0.3}]
$(sed 's/glass/gel/; s/150/100/; s/}/, thickness: 1 m}/' <<<"$discs")
contact: {law: linear, deformation: relaxed}
integrator: {scheme: velocity_verlet, step_fraction: 0.2}
boundary: {lateral: pressure, every: 60}
stages:
  - {stage: prepare, method: drop_and_roll, aspect_ratio: 2}
  - {stage: confine, pressure: 300 Pa, unbalanced_limit: 0.9, stress_tolerance: 0.5}
  - {stage: compress, strain: 1 %, rate: 10 1/s}
measure: {samples: 20, cells: no, receivers: [{name: low, place: [4 mm, 5 mm]}, {name: high, place: [8 mm, 20 mm]}], wave_layers: 5, wave_axis: y, wave_every: 7, wave_from: compress}
output: {snapshots: 2, figures: no}
EOF
cat >gel.yaml <<EOF
scree: 1
name: gel
dimension: 3
seed: 24
materials: [{name: gel, young_modulus: 10 MPa, poisson_ratio: 0.3, density: 1000 kg/m3, friction: 0.3, normal_stiffness: 5 kN/m, stiffness_ratio: 0.5, damping_ratio: 0.3}]
$(sed 's/glass/gel/' <<<"$spheres")
contact: {law: linear, deformation: explicit}
integrator: {scheme: position_verlet, step_fraction: 0.2}
boundary: {periodic: xyz}
stages:
  - {stage: prepare, method: gas, solid_fraction: 30 %}
  - {stage: confine, pressure: 1 kPa, unbalanced_limit: 0.9, stress_tolerance: 0.5}
  - {stage: deform, velocity_gradient: {xz: 20 1/s}, strain: 5 %}
$rest
EOF
cat >spun.yaml <<EOF
scree: 1
name: spun
seed: 25
$materials
$discs
contact: {law: hertz_mindlin}
integrator: {scheme: velocity_verlet, step_fraction: 0.4}
boundary: {every: 40}
stages:
  - {stage: prepare, method: drop_and_roll, outline: circle}
  - {stage: confine, boundary: minimal, pressure: 4 kPa, unbalanced_limit: 0.3}
  - {stage: rotate_particle, boundary: minimal, spin: 10 rad/s, rest_time: 2 ms, hold_time: 2 ms}
$rest
EOF
# Few bodies are pressed at their surfaces: some processes have none of them, and get some.
cat >pressed.yaml <<EOF
scree: 1
name: pressed
seed: 26
materials: [{name: gel, young_modulus: 200 GPa, poisson_ratio: 0.35, density: 2000 kg/m3, friction: 0, normal_stiffness: 7e10 N/m, stiffness_ratio: 0, damping_ratio: 0}]
particles: {shape: disc, material: gel, count: 24, distribution: equal, radius: 1 mm, thickness: 1 m}
contact: {law: linear, deformation: explicit}
selections: [{select: layer, name: low, axis: y, end: low}, {select: layer, name: high, axis: y, end: high}]
loads:
  - {load: prescribed, selection: low, attack: surface, force_y: 5 kN}
  - {load: prescribed, selection: high, attack: surface, force_y: -5 kN}
integrator: {step: 200 ns}
stages:
  - {stage: prepare, method: square, width: 8 mm}
  - {stage: bond, gap_tolerance: 1 um}
  - {stage: relax, boundary: none, duration: 40 us}
measure: {samples: 20, cells: no}
output: {snapshots: 20, figures: no}
EOF
# Where the law looks ahead bodies have more to send from their first step on than when their list was made.
cat >ahead.yaml <<EOF
scree: 1
name: ahead
seed: 27
materials: [{name: glass, young_modulus: 10 MPa, density: 2500 kg/m3, friction: 0.5}]
$discs
contact: {law: hertz_brilliantov, damping_time: 20 us, friction_update: implicit, reference_velocity: 1 mm/s}
integrator: {scheme: position_verlet, step_fraction: 0.2}
boundary: {lateral: pressure, every: 1000}
stages:
  - {stage: prepare, method: drop_and_roll, aspect_ratio: 2}
  - {stage: confine, pressure: 3 kPa, unbalanced_limit: 0.5, stress_tolerance: 0.5}
  - {stage: compress, strain: 2 %, rate: 10 1/s}
$rest
EOF
# Who asked for whole states, as log.txt has it; samples taken in parts.
wholes() { grep -o 'whole states were put together, in process 0 alone, for: .*' "$1/log.txt"; }
in_parts() { "$scree" get "$1" processes_samples_in_parts; }
for name in shear layer drum lid path block pour rain bonded strip heap rounded cell nap gear sides flanks core mould loose ball sleeve tube soft gel spun pressed ahead; do
    checks=$((checks + 1)); "$scree" run $name.yaml -o one-$name --quiet --threads 1 2>/dev/null || complain "$name on one process"
    for ranks in 2 3 4; do
        expect 0 '|warning' on $ranks $name.yaml -o many -f --threads 1
        same "$(checksum many)" "$(checksum one-$name)" "$name on $ranks processes"
        for table in one-"$name"/*.csv; do
            cmp -s "many/$(basename "$table")" "$table" || complain "$(basename "$table") of $name on $ranks processes differs"
        done
        grep -q "process 0 of $ranks: " many/log.txt || complain "$ranks processes did not compute $name together"
        # Two reductions a step, of a bed of spheres as of a periodic cell; what samples and lists ask comes on top.
        case $name in shear | layer | drum)
            checks=$((checks + 1)); awk -v count="$("$scree" get many processes_reductions)" 'BEGIN { exit !(count >= 2 && count < 2.6) }' || complain "$name asks all of $ranks processes $("$scree" get many processes_reductions) times a step" ;;
        esac
        # Samples are taken in parts, unless there is a pile.
        case $name in
        pour | rain | heap | rounded | nap) wholes many | grep -q 'samples of pile ([1-9]' || complain "$name: who asked for whole states is not told: $(wholes many)" ;;
        *) [ "$(in_parts many)" -ge 20 ] || complain "$name: $(in_parts many) samples were taken in parts"
           wholes many | grep -q 'samples of' && complain "$name: whole states for samples: $(wholes many)" ;;
        esac
        # Stages begin in parts, unless there is a boundary to be found, or a selection.
        case $name in
        shear | drum | path | lid | cell | rain | gear | gel) wholes many | grep -q 'begins of stages' && complain "$name: whole states for begins: $(wholes many)" ;;
        layer) wholes many | grep -q 'begins of stages by plates ([1-9]' || complain "$name: whose begin needs the whole is not told: $(wholes many)" ;;
        sides | flanks | core) wholes many | grep -q 'begins of stages by pressure ([1-9]' || complain "$name: whose begin needs the whole is not told: $(wholes many)" ;;
        esac
    done
    # From an early snapshot, which other processes than those that wrote it go on from.
    rm -rf later && cp -r "one-$name" later && rm later/summary.json
    expect 0 '|warning' on 3 --restart later --from 1 --threads 1
    same "$(checksum later)" "$(checksum one-$name)" "$name from snapshot 1 on 3 processes"
    expect 0 '|warning' env SCREE_RANDOM_PARTS=7 mpirun --oversubscribe -n 3 "$scree" run $name.yaml -o many -f --threads 1 --quiet
    same "$(checksum many)" "$(checksum one-$name)" "$name in parts at random"
    grep -qE ' [1-9][0-9]* bodies sent' many/log.txt || complain "no body of $name went to another process"
done

# --- what falls together costs more than what is above it: space is cut anew by cost, and stays so; by time, too
cat >silt.yaml <<EOF
scree: 1
name: silt
seed: 11
gravity: [0, -9.81]
$materials
particles: {shape: disc, material: glass, radius_min: 0.7 mm, radius_max: 1.3 mm, count: 600}
contact: {law: hertz_mindlin}
integrator: {scheme: velocity_verlet, step_fraction: 0.2}
boundary: {periodic: x}
walls: [{shape: plane, name: floor, point: [0, 0], normal: [0, 1]}]
stages:
  - {stage: prepare, method: gas, aspect_ratio: 3, solid_fraction: 20 %}
  - {stage: relax, name: settle, duration: 0.12 s}
$rest
EOF
expect 0 '|warning' "$scree" run silt.yaml -o silt-one --threads 1 --quiet
for balance in counts time; do
    expect 0 '|warning' on 2 silt.yaml -o silt-$balance --threads 1 --balance $balance
    same "$(checksum silt-$balance)" "$(checksum silt-one)" "silt in parts by $balance"
done
checks=$((checks + 1)); grep -o 'costs most at a list at most .* times;' silt-counts/log.txt |
    awk '{exit !($8 < 1.3 && $(NF - 1) > 3 && $(NF - 1) < 100)}' || complain "balance of silt: $(grep 'costs most' silt-counts/log.txt)"
expect 2 "'tme' is not one of its values" on 2 silt.yaml -o no --balance tme

# --- more processes than bodies in some of them
expect 0 '|warning' on 6 shear.yaml -o few -f --set particles.count=16 --threads 1
expect 0 '1 of 4 processes have no particle' on 4 lid.yaml -o fewer -f --set particles.count=3 --set stages.0.solid_fraction=5% --threads 1
expect 0 '|warning' "$scree" run shear.yaml -o few-one --set particles.count=16 --threads 1 --quiet
same "$(checksum few)" "$(checksum few-one)" "16 bodies on 6 processes"

# --- in a row of parts a body is held against those beside its own (against all: 5.7)
cat >row.yaml <<EOF
scree: 1
name: row
seed: 26
$materials
$(sed 's/150/400/' <<<"$discs")
contact: {law: hertz_mindlin}
integrator: {scheme: velocity_verlet, step_fraction: 0.2}
boundary: {periodic: xy}
stages:
  - {stage: prepare, method: gas, aspect_ratio: 0.04, solid_fraction: 45 %, velocity: 0.3 m/s}
  - {stage: relax, duration: 3 ms}
$rest
EOF
expect 0 '|warning' "$scree" run row.yaml -o row-one --threads 1 --quiet
expect 0 '|warning' on 8 row.yaml -o row --threads 1
same "$(checksum row)" "$(checksum row-one)" '8 parts in a row'
grep -q 'held against [12][.][0-9]* parts' row/log.txt || complain "bodies are $(grep -o 'held against.*' row/log.txt)"

# --- a column that looks at the whole is named
expect 0 '|warning' "$scree" run drum.yaml -o look-one --set measure.mean_strain=yes --threads 1 --quiet
expect 0 '|warning' on 3 drum.yaml -o look --set measure.mean_strain=yes --threads 1
cmp -s look/series.csv look-one/series.csv || complain "series.csv of drum with mean strains differs"
wholes look | grep -q 'samples of mean_strain ([1-9]' || complain "who asked: $(wholes look)"
same "$(in_parts look)" 0 'samples in parts with mean strains'

# --- what cannot be spread
refused() { expect 2 "$1.*cannot be spread over several processes yet" on 2 "${@:2}"; same "$(grep -c 'cannot be spread' <<<"$output")" 1 "one message: $output"; [ -e no ] && complain "a refused run has made its folder"; }
refused "stage 'collide'" restitution -o no
refused "deformation 'implicit'" ddem-uniaxial --quick --set contact.deformation=implicit -o no
expect 2 'there is no key' on 2 shear.yaml -o no --set particles.many=1

# --- bonds broke, and pairs have parted behind it
for name in bonded strip; do
    checks=$((checks + 1)); [ $(($("$scree" get one-$name bonds_broken_tension) + $("$scree" get one-$name bonds_broken_shear))) -gt 0 ] || complain "no bond of $name broke"
done

checks=$((checks + 1)); awk -v awake="$("$scree" get one-nap mean_awake)" 'BEGIN {exit !(awake < 40)}' || complain 'nothing of nap slept'

# --- what was poured, waited and was taken out; errors tell of the whole sample; other numbers of processes go on
for result in spout_waits row_waits row_layers outlet_outflow; do
    checks=$((checks + 1)); [ "$("$scree" get one-pour $result)" -gt 0 ] || complain "$result of pour is nothing"
done
checks=$((checks + 1)); [ $(($("$scree" get one-pour particles) + $("$scree" get one-pour outlet_outflow))) -lt 32 ] || complain 'nothing of pour was lost'
for result in cloud_waits outlet_outflow; do
    checks=$((checks + 1)); [ "$("$scree" get one-rain $result)" -gt 0 ] || complain "$result of rain is nothing"
done
grep -q 'the pile is as high as wanted' one-rain/log.txt || complain 'rain did not end with the height'
"$scree" run pour.yaml -o error-one --set stages.pour.past=stop --quiet --threads 1 2>error-one.txt
expect 3 'has fallen past everything that stands' on 3 pour.yaml -o error --set stages.pour.past=stop --threads 1
grep -qF "$(grep -o 'step [0-9]*: particle.* m, has' error-one.txt)" <<<"$output" || complain "another grain is lost: $output"
"$scree" run pour.yaml -o error-one -f --set stages.pour.patience="10 ms" --set sources.spout.place="[1 mm, 5 mm]" --quiet --threads 1 2>error-one.txt
expect 3 "source 'spout' has been blocked" on 3 pour.yaml -o error -f --set stages.pour.patience="10 ms" --set sources.spout.place="[1 mm, 5 mm]" --threads 1
grep -qF "$(grep -o 'step [0-9]*: source.*' error-one.txt)" <<<"$output" || complain "another source is blocked: $output"
expect 0 '|warning' on 3 pour.yaml -o again --set output.snapshots=10 --threads 1
expect 0 '|warning' on 2 --restart again --from 5
grep -q 'goes on from step [1-9]' again/log.txt || complain 'pour does not go on from its middle'
same "$(checksum again)" "$(checksum one-pour)" 'pour goes on with two processes in place of three'

# --- the boundary has lost bodies, and is told anew where a run goes on
same "$("$scree" get one-sides outlet_outflow)" 3 'grains of sides that were taken out'
expect 0 '|warning' on 3 mould.yaml -o again -f --set output.snapshots=10 --threads 1
expect 0 '|warning' on 2 --restart again --from 5
grep -q 'goes on from step [1-9]' again/log.txt || complain 'mould does not go on from its middle'
same "$(checksum again)" "$(checksum one-mould)" 'mould goes on with two processes in place of three'

# --- a process dies while servos read the boundary; the checkpoint is whole, and any number of processes goes on from it
mpirun --oversubscribe -n 4 "$scree" run sides.yaml -o killed --set output.checkpoint_steps=500 --quiet --threads 1 >killed.txt 2>&1 </dev/null &
job=$!
for ((i = 0; i < 600; i++)); do [ "$(find killed/parts -name 'checkpoint-*[1-9].h5' 2>/dev/null | wc -l)" -ge 1 ] && break; sleep 0.1; done
victim=$(pgrep -P $job | tail -n 1)
kill -9 "$victim"
wait $job && complain 'mpirun went on without one of its processes'
cp -r killed killed-1
cp -r killed killed-3
expect 0 '|warning' "$scree" run --restart killed-1 --quiet
same "$(checksum killed-1)" "$(checksum one-sides)" 'restart on one process'
expect 0 '|warning' on 3 --restart killed-3
same "$(checksum killed-3)" "$(checksum one-sides)" 'restart on three processes'
grep -q 'goes on from step [1-9]' killed-3/log.txt || complain 'the run goes on from its begin'
finish
