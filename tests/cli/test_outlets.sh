#!/usr/bin/env bash
# Outlets: what they count and take out, with energy and restart; what is refused. Angles of free surfaces that are given.
# shellcheck source=tests/cli/check.sh
. "$(dirname "$0")/check.sh"
near() { # name, value, wanted, tolerance
    checks=$((checks + 1))
    awk "BEGIN { exit !(($2 - ($3))^2 <= ($4)^2) }" || complain "$1 is $2, not $3 within $4"
}
get() { "$scree" get "$@"; }

# Discs that touch nothing, far above a floor.
discs='materials: [{name: rubber, young_modulus: 1 MPa, poisson_ratio: 0.3, density: 1000 kg/m3, friction: 0}]
integrator: {step: 10 us}
walls: [{shape: plane, name: floor, point: [0, -1 m], normal: [0, 1]}]'
rest='measure: {samples: 50, cells: no}
output: {figures: no, paraview: no}'

# --- four discs fly at 1 m/s, 10 mm one behind the other; after 25 ms two have passed x = 0
cat >flight.yaml <<END
name: flight
$discs
particles: {material: rubber, count: 4, distribution: equal, radius: 1 mm, thickness: 1 m}
loads: [{load: outlet, lower: [-1 m, -1 m], upper: [0 m, 1 m], every: 10}]
stages:
  - stage: prepare
    method: bodies
    bodies: [{position: [10 mm, 0], velocity: [-1 m/s, 0]}, {position: [20 mm, 0], velocity: [-1 m/s, 0]},
      {position: [30 mm, 0], velocity: [-1 m/s, 0]}, {position: [40 mm, 0], velocity: [-1 m/s, 0]}]
  - {stage: relax, duration: 25 ms}
$rest
END
expect 0 '' "$scree" run flight.yaml -o taken -q
mass=$(awk 'BEGIN { printf "%.17g", 1000 * 3.14159265358979324 * 1e-6 }')
same "$(get taken outflow)" 2 'particles taken out'
near 'their mass' "$(get taken outflow_mass)" "2 * $mass" 1e-12
near 'what is left' "$(get taken kinetic)" "2 * 0.5 * $mass" 1e-12
near 'energy' "$(get taken energy_residual)" 0 1e-12
awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) { if ($i ~ /^time/) t = i; if ($i ~ /^outflow \[/) n = i } next }
    { wanted = ($t > 0.01 + 1.5e-4) + ($t > 0.02 + 1.5e-4); least = ($t > 0.01 + 1e-9) + ($t > 0.02 + 1e-9)
      if ($n > least || $n < wanted) bad = 1 } END { exit bad }' taken/series.csv || complain 'outflow over time'
expect 0 '' "$scree" run flight.yaml -o counted -q --set loads.0.removes=no
same "$(get counted outflow)" 2 'particles counted'
near 'nothing is taken' "$(get counted kinetic)" "4 * 0.5 * $mass" 1e-12
"$scree" run flight.yaml -o again -q --set output.checkpoint_steps=700 >/dev/null 2>&1
expect 0 '' "$scree" run --restart again --from 0 -q
same "$(get again state_checksum)" "$(get taken state_checksum)" 'after a restart'

# --- others are taken out while a load pushes two: it pushes in that step, too
cat >pushed.yaml <<END
name: pushed
$discs
particles: {material: rubber, count: 3, distribution: equal, radius: 1 mm, thickness: 1 m}
selections: [{select: ids, name: pushed, ids: [1, 2]}]
loads:
  - {load: outlet, lower: [-1 m, -1 m], upper: [0 m, 1 m], every: 10}
  - {load: prescribed, selection: pushed, force_x: 0.1 N}
stages:
  - stage: prepare
    method: bodies
    bodies: [{position: [10 mm, 0], velocity: [-1 m/s, 0]}, {position: [20 mm, 0], velocity: [0, 0]}, {position: [40 mm, 0], velocity: [0, 0]}]
  - {stage: relax, duration: 15 ms}
$rest
END
expect 0 '' "$scree" run pushed.yaml -o pushed -q
same "$(get pushed outflow)" 1 'taken out beside two that are pushed'
near 'energy' "$(get pushed energy_residual)" 0 1e-12

# --- what is wrong
expect 2 'loads.0.upper: no coordinate of .upper. may be as small' "$scree" check flight.yaml --set 'loads.0.upper=[-2 m, 1 m]'
expect 2 'loads.0.upper: the region of the outlet lies within the wall .floor.' \
    "$scree" run flight.yaml -o bad -q --set 'loads.0.lower=[-1 m, -3 m]' --set 'loads.0.upper=[1 m, -2 m]'
expect 2 'loads.0.upper.*within the wall .floor.' "$scree" check flight.yaml --set 'loads.0.lower=[-1 m, -3 m]' --set 'loads.0.upper=[1 m, -2 m]'
sed 's/^loads: .*/loads: [{load: outlet, name: a, lower: [-1 m, -1 m], upper: [0 m, 1 m], removes: no}, {load: outlet, lower: [-1 m, -1 m], upper: [5 mm, 1 m]}]/' flight.yaml >named.yaml
expect 0 '' "$scree" run named.yaml -o named -q
same "$(get named outlet2_outflow)" 2 'an outlet without a name'
same "$(get named a_outflow)" 0 'what another one has taken before'
same "$(get named outflow)" 2 'all outlets'
expect 2 'loads.1.name: another outlet has this name' "$scree" check named.yaml --set loads.1.name=a

# --- surfaces: stacks of spheres, and of discs, cut off at 30 degrees
awk 'BEGIN { print "x [mm],y [mm],z [mm],radius [mm]"; s = 1.98; slope = 0.57735
    for (i = -12; i <= 12; i++) for (j = -12; j <= 12; j++) for (k = 0; k < 10; k++) {
        x = i * s; y = j * s; if (k * s <= (24 - sqrt(x * x + y * y)) * slope - 1) print x + 30 "," y + 30 "," 0.99 + k * s ",1" } }' >cone.csv
awk 'BEGIN { print "x [mm],y [mm],radius [mm]"; s = 1.98; slope = -0.57735
    for (i = 0; i < 40; i++) for (k = 0; k < 40; k++) if (k * s <= 60 + i * s * slope) print 1 + i * s "," 0.99 + k * s ",1" }' >slope.csv
cat >cone.yaml <<'END'
name: surface
dimension: 3
gravity: [0, 0, -9.81]
materials: [{name: rubber, young_modulus: 1 MPa, poisson_ratio: 0.3, density: 1000 kg/m3, friction: 0.5}]
particles: {shape: sphere, material: rubber, count: COUNT, distribution: equal, radius: 1 mm}
integrator: {step: 1 us}
walls: [{shape: plane, name: floor, point: [0, 0, 0], normal: [0, 0, 1]}]
stages:
  - {stage: prepare, method: file, file: cone.csv}
  - {stage: relax, duration: 20 us}
measure: {samples: 20, cells: no, surface: cone}
output: {figures: no, paraview: no}
END
sed -i "s/COUNT/$(tail -n +2 cone.csv | wc -l)/" cone.yaml
expect 0 '' "$scree" run cone.yaml -o cone -q
near 'the angle of a cone' "$(get cone surface_angle)" 30 2
sed "s/dimension: 3/dimension: 2/; s/\[0, 0, -9.81\]/[0, -9.81]/; s/sphere/disc/; s/cone.csv/slope.csv/; s/point: .*/point: [0, 0], normal: [0, 1]}]/
    s/surface: cone/surface: slope/; s/count: [0-9]*/count: $(tail -n +2 slope.csv | wc -l)/" cone.yaml >slope.yaml
expect 0 '' "$scree" run slope.yaml -o slope -q
near 'the angle of a slope' "$(get slope surface_angle)" -30 1
expect 2 'measure.surface: a cone has three dimensions' "$scree" check slope.yaml --set measure.surface=cone

# --- all have gone: figures of what is left have nothing to show, and are drawn
sed 's/count: 4, distribution: equal, radius: 1 mm/count: 4, distribution: uniform, radius_min: 0.8 mm, radius_max: 1 mm/
    s/, velocity: \[-1 m/, radius: 1 mm&/g; s/{stage: relax, duration: 25 ms}/{stage: relax, duration: 60 ms}/' flight.yaml >gone.yaml
expect 0 '' "$scree" run gone.yaml -o gone -q
same "$(get gone outflow)" 4 'all have gone'
expect 0 'sizes' "$scree" plot gone --only sizes
finish
