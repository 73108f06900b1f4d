#!/usr/bin/env bash
# What is wrong with cases of polygons and piles is said as a user would want it: the place in the file, the key, what is
# wrong and what to do, with the right exit status, before anything is computed or with a run directory that can be read.
# shellcheck source=tests/cli/check.sh
. "$(dirname "$0")/check.sh"

"$scree" new pile-point >good.yaml
outline=$(grep -n 'outline: ellipse' good.yaml | cut -d: -f1)
corners=$((outline + 1))

# given CORNERS PATTERN: these corners in place of the ellipse.
given() {
    sed "s|outline: ellipse.*|outline: given\n  corners: $1|" good.yaml >bad.yaml
    expect 2 "$2" "$scree" check bad.yaml
}
here="^bad\.yaml:$corners:12: particles\.corners: "

# Outlines.
given '[[0,0],[3,0],[1,1],[0,3]]' "${here}the polygon is not convex at corner 2 .*only convex polygons"
given '[[0,0],[0,1],[1,1]]' "${here}the corners go clockwise .*list them in the opposite order"
given '[[0,0],[1,0],[1,0],[0,1]]' "${here}corners 1 and 2 .* are the same.*leave one out"
given '[[0,0],[1,0],[2,0],[0,1]]' "${here}corner 1 .*lies on the line through its neighbours.*leave it out, or move it"
given '[[0,0],[1,0]]' "${here}a polygon has 3 to 32 corners, not 2"
given '[[0,0],[1,1],[1,0],[0,1]]' "${here}the outline crosses itself: the edges that begin at corners 0 and 2"
given '[[0,1],[0.588,-0.809],[-0.951,0.309],[0.951,0.309],[-0.588,-0.809]]' "${here}the outline crosses itself"
given '[[0,0],[.nan,0],[0,1]]' "^bad\.yaml:$corners:20: particles\.corners: '\.nan' is not a number"
same "$(grep -c . <<<"$output")" 1 "one problem, one message"
given '[[0,0],[a,0],[0,1]]' "^bad\.yaml:$corners:20: particles\.corners: 'a' is not a number"
given corners.txt "${here}a single value is given; expected a list of pairs, e.g. \\[\\[0, 1\\], \.\.\.\\], or the name of a \.csv file of them"
given '[[0,0,1],[1,0],[0,1]]' "^bad\.yaml:$corners:13: particles\.corners: expected a pair of values"

# A thousand corners, in the case and in a file.
awk 'BEGIN { print "x,y"; for (k = 0; k < 1000; k++) printf "%.6f,%.6f\n", cos(k * 0.0062831853), sin(k * 0.0062831853) }' >thousand.csv
given thousand.csv "${here}a polygon has 3 to 32 corners, not 1000"
given "[$(tail -n +2 thousand.csv | sed 's/.*/[&]/' | paste -sd,)]" 'this line has more than 4096 bytes.*several lines, or into a \.csv file'

# Files of corners.
given nowhere.csv "${here}the file of this table cannot be used: No such file"
mkdir folder.csv
given folder.csv "${here}the file of this table cannot be used: it is not a file"
printf 'x,y\n0,0\n1,zz\n0,1\n' >corners.csv
given corners.csv "^corners\.csv:3:3: particles\.corners: 'zz' is not a number"
printf 'x,y\n0,0\n1\n0,1\n' >corners.csv
given corners.csv '^corners\.csv:3:1: particles\.corners: expected a pair of values'
printf 'x,y\n0,0\nnan,0\n0,1\n' >corners.csv
given corners.csv "^corners\.csv:3:1: particles\.corners: 'nan' is not a number"
printf 'x,z\n0,0\n1,0\n0,1\n' >corners.csv
given corners.csv "^corners\.csv:1:3: particles\.corners: unknown column 'z'; did you mean 'y'\?; expected x and y, in any order"
printf 'grain,x,y\n1,0,0\n1,1,0\n1,0,1\n' >corners.csv
given corners.csv "^corners\.csv:1:1: particles\.corners: unknown column 'grain'; expected x and y"
printf '# one name\ny\n0\n1\n' >corners.csv
given corners.csv "^corners\.csv:2:1: particles\.corners: the column 'x' is missing; expected x and y"
printf 'x,x\n0,0\n1,0\n0,1\n' >corners.csv
given corners.csv "^corners\.csv:1:3: particles\.corners: a second column 'x'; did you mean 'y'?"
printf '\0\1\2x,y\n' >corners.csv
given corners.csv '^corners\.csv: particles\.corners: this is not a text file'
: >corners.csv
given corners.csv "${here}a polygon has 3 to 32 corners, not 0"

# changed SED PATTERN [STATUS]: the case with this change is refused, or ends so.
changed() {
    sed "$1" good.yaml >bad.yaml
    expect "${3:-2}" "$2" "$scree" check bad.yaml
}
changed 's/outline: ellipse.*/&\n  axis_ratio: 0.5/' "particles\.axis_ratio: '0\.5' is too small .accepted: 1 to 20"
changed 's/corners_min: 6/corners_min: 9/' 'particles\.corners_max: 8 is less than corners_min, 9$'
changed 's/corners_max: 8/corners_max: 1000/' "particles\.corners_max: '1000' is too large .accepted: 3 to 32"
same "$(grep -c . <<<"$output")" 1 "one problem, one message: $output"
changed 's/radius_min: .*/radius_min: 0 mm/' "particles\.radius_min: '0 mm' is too small"
changed 's/radius_min: .*/radius_min: -1 mm/' "particles\.radius_min: '-1 mm' is too small"
changed 's/radius_min: .*/radius_min: 5 mm/' "particles\.radius_min: '5 mm' is larger than radius_max"
changed 's/^dimension: 2/dimension: 3/' 'particles\.shape: polygons are bodies in the plane: dimension: 2'
changed 's/law: polygon_overlap/law: hertz_mindlin/; /damping_constant/d' 'contact\.law: law hertz_mindlin has no meaning for polygons with sharp corners: give particles\.rounding .*polygon_overlap, polygon_potential'
for law in hertz_jkr hertz_dmt; do
    # Rounding would be refused, too; the law is told beside a key that it does not use.
    changed "s/law: polygon_overlap/law: $law/" "contact\.law: law $law sticks: sharp polygons need one that only pushes: polygon_overlap, polygon_potential\$"
    grep -q 'damping_constant: not used' <<<"$output" || complain "nothing of the unused key: $output"
    grep -q 'rounding' <<<"$output" && complain "rounding is offered to a law that sticks: $output"
    changed "s/law: polygon_overlap/law: $law/; s/corners_min: 6/&\n  rounding: 0.1/" "contact\.law: law $law sticks: rounded polygons need one that only pushes: .*hertz_mindlin.*linear$"
    grep -q "pushes: .*$law" <<<"$output" && complain "a law that sticks is offered: $output"
done
changed 's/law: polygon_overlap/law: hertz_mindlin/' 'contact\.law: law hertz_mindlin has no meaning for polygons with sharp corners: give particles\.rounding'
grep -q 'damping_constant: not used' <<<"$output" || complain "nothing of the unused key: $output"
changed 's/corners_min: 6/&\n  rounding: 0.1/' 'particles\.rounding: law polygon_overlap .*leave rounding out, or take contact\.law .*linear'
changed 's/corners_min: 6/&\n  rounding: 1/' "particles\.rounding: '1' is too large .accepted: 0 to 0\.9"
changed 's/    place: \[0, 50 cm\]/    place: 25 cm/' 'sources\.0\.place: expected two or three values, e\.g\. \[0, 0\.5 mm\]'
changed '/stage: relax/i\  - stage: confine\n    pressure: 10 kPa\n    boundary: membrane' 'stages\.2\.boundary: `sources` and boundary: membrane do not go together: in a case with walls this stage has no free surface of the sample: only relax or pour can follow'
same "$(grep -c . <<<"$output")" 1 "one problem, one message: $output"
# The same of a boundary that no stage has chosen, and of what is said to such a one.
boundary() { # LINE PATTERN: the case with this line in its section `boundary`
    changed "s|^measure:|boundary:\n  $1\nmeasure:|" "$2"
}
boundary 'lateral: membrane' '^bad\.yaml:[0-9]+:[0-9]+: boundary\.lateral: `sources` and boundary: membrane do not go together: sources pour beside walls of the case only; give `walls` and boundary: walls'
same "$(grep -c . <<<"$output")" 1 "one problem, one message: $output"
for key in 'penalty: 1e6 Pa s' 'servo_gain: 2' 'membrane_stiffness: 1 N/mm' 'gap_limit: 1' 'every: 100'; do
    boundary "$key" "^bad\.yaml:[0-9]+:[0-9]+: boundary\.${key%%:*}: not used: all stages stand beside the .walls. of the case"
done
# Gaps are asked for by selections of a side, too; and a case as it is written out says the values of before.
sed 's/^measure:/selections: [{select: side, name: low, side: bottom}]\nboundary: {gap_limit: 1}\nmeasure:/' good.yaml >bad.yaml
expect 0 'gap_limit: 1 ' "$scree" check bad.yaml
"$scree" check good.yaml >written.yaml
expect 0 'membrane_stiffness: 10 N/mm' "$scree" check written.yaml
changed 's/^measure:/boundary:\n  periodic: x\nmeasure:/' 'sources\.0\.source: sources do not pour into a sample that repeats itself: leave boundary\.periodic out'
changed 's/^stages:/  - source: point\n    name: again\n    place: [0, 50 cm]\n    interval: 0.1 s\n\nstages:/' 'sources\.1\.source: it is in the same place as sources\.0.*give it another place'
changed 's/step: 2e-6 s/step: 1e-3 s/' 'integrator\.step: a step of 0\.001 s is above the critical step of this case.*or auto'

# Limits of sleep without sleep are refused, but for the values that they have anyway, which a run writes into its case;
# where --set drops the window they are dropped with it. Windows shorter than a step are none.
for limit in 'sleep_force: 0.3' 'sleep_motion: 0.01' 'wake_force: 1' 'wake_interval: 2 s'; do
    changed "s/  - stage: pour/&\n    $limit/" "^bad\.yaml:[0-9]*:[0-9]*: stages\.1\.${limit%%:*}: not used without .sleep_window.: give that, or leave this out"
    same "$(grep -c . <<<"$output")" 1 "one problem, one message: $output"
    changed "s/  - stage: pour/&\n    sleep_window: soon\n    $limit/" "stages\.1\.sleep_window: 'soon'"
    same "$(grep -c . <<<"$output")" 1 "one problem, one message: $output"
    changed "s/  - stage: pour/&\n    sleep_window: 5 ms\n    $limit/" 'pile-point' 0
    expect 0 'pile-point' "$scree" check bad.yaml --set stages.pour.sleep_window=auto
done
changed 's/  - stage: pour/&\n    sleep_force: 0.01\n    sleep_motion: 1e-4\n    wake_force: 0.1\n    wake_interval: 1 s/' 'pile-point' 0
changed 's/  - stage: pour/&\n    sleep_window: 1e-6 s/' '^bad\.yaml:[0-9]*:[0-9]*: stages\.1\.sleep_window: 1e-06 s is less than a step of this case, 2e-06 s: a particle has to be quiet for many'
changed 's/  - stage: pour/&\n    sleep_window: 2e-6 s/' 'pile-point' 0
changed 's/  - stage: pour/&\n    sleep_window: 5 ms\n    wake_interval: 20 ms/' '^bad\.yaml:[0-9]*:[0-9]*: stages\.1\.wake_interval: none would ever sleep: within 0\.02 s all wake for 4 of .sleep_window., 0\.005 s, and have to be quiet for another: give more than 0\.025 s'

# Without sources the keys of quick that set some of theirs are wrong, and nothing else is near to them.
sed '/^sources:/,/^$/d' good.yaml >bad.yaml
expect 2 'stages\.1\.stage: there is nothing that it could pour from: give .sources' "$scree" check bad.yaml
same "$(grep -c 'the case has no list of sources$' <<<"$output")" 1 "keys of a list that is not there: $output"

# Grains that find no room, and what only a run can know.
small=(--quick --set particles.count=6 --no-figures --set output.paraview=no)
sed 's/^sources:/  - {shape: box, name: cage, lower: [-1 mm, -5 mm], upper: [1 mm, 60 cm]}\nsources:/' good.yaml >bad.yaml
expect 2 "sources\.0: source 'spout' is in wall 'cage'.*the smallest particle has the radius.*move the source or the wall" \
    "$scree" run bad.yaml "${small[@]}" -o caged
sed 's/    place: .*/    place: [0, 1 mm]/' good.yaml >bad.yaml
expect 2 "^bad\.yaml:[0-9]+:5: sources\.0: source 'spout' is in wall 'plate'.*move the source or the wall" \
    "$scree" run bad.yaml "${small[@]}" -o inside
sed 's/shape: plane/shape: polygon/; s/^    point: .*/    corners: [[-6 mm, -1 cm], [6 mm, -1 cm], [6 mm, 0], [-6 mm, 0]]/; /normal: /d
    s/    place: .*/    place: [0, 2 cm]/' good.yaml >bad.yaml
expect 3 'has fallen past everything that stands: .*make the plate wider, pour fewer particles, or give stages\.1\.past' \
    "$scree" run bad.yaml "${small[@]}" -o past
expect 0 'stopped' "$scree" get past status
sed 's/    place: .*/    place: [0, 8 mm]/; s/  - stage: pour/&\n    patience: 50 ms/' good.yaml >bad.yaml
expect 3 "source 'spout' has been blocked .*raise the source, pour fewer particles, or let it stay .above. the pile" \
    "$scree" run bad.yaml "${small[@]}" -o blocked
expect 0 'stopped' "$scree" get blocked status
expect 0 '' "$scree" run bad.yaml "${small[@]}" --set sources.spout.place='[0, 10 cm]' --set particles.count=1 --quiet -o fine

# Sources too small for what they pour, and too near to a wall for the largest of them.
changed 's/source: point/source: line/; s/place: \[0, 50 cm\]/start: [0, 50 cm]\n    end: [1 mm, 50 cm]/' 'warning' 0
grep -q "warning .*source 'spout' is 0.001 m long, less than its smallest particle, 0.00385 m: it pours like a point; make it longer, or take source: point" <<<"$output" ||
    complain "no warning of a line of 1 mm: $output"
changed 's/source: point/source: region/; s/place: \[0, 50 cm\]/lower: [0, 50 cm]\n    upper: [0.1 mm, 50 cm]/' \
    '^bad\.yaml:[0-9]+:[0-9]+: sources\.0\.upper: the region is smaller, 0\.0001 m, than the smallest particle, 0\.00385 m: give corners.*source: point'
same "$(grep -c . <<<"$output")" 1 "one problem, one message: $output"
changed 's/radius_max: .*/radius_max: 40 cm/; s/place: \[0, 50 cm\]/place: [0, 25 cm]/' \
    "sources\.0: source 'spout' is too near to wall 'plate': .* is 0\.25 m from it, and the largest particle has the radius 0\.[4-6].*smaller particles"
changed 's/source: point/source: line/; s/place: \[0, 50 cm\]/start: [-10 cm, 50 cm]\n    end: [10 cm, 50 cm]/; /sources.spout.place/d
    s/^stages:/  - source: point\n    name: within\n    place: [0, 50 cm]\n    interval: 0.1 s\n\nstages:/' \
    'sources\.1\.source: it is in the same place as sources\.0.*give it another place'

# Sources pour beside walls alone; what follows from a boundary that does not go with them is not said again.
changed 's/  - stage: pour/&\n    boundary: membrane/' 'stages\.1\.boundary: `sources` and boundary: membrane do not go together: .*give `walls` and boundary: walls'
same "$(grep -c . <<<"$output")" 1 "one problem, one message: $output"

# A funnel whose opening of 4 mm is narrower than its discs is refused; one that is hardly wider may clog.
opening() { # HALF: half the width in mm
    printf '%s\n' --set walls.left.corners="[[-$(($1 + 6)) mm, 156 mm], [-$1 mm, 156 mm], [-$(($1 + 30)) mm, 186 mm], [-$(($1 + 36)) mm, 186 mm]]" \
        --set walls.right.corners="[[$1 mm, 156 mm], [$(($1 + 6)) mm, 156 mm], [$(($1 + 36)) mm, 186 mm], [$(($1 + 30)) mm, 186 mm]]" \
        --set sources.belt.start='[-20 mm, 20 cm]' --set sources.belt.end='[20 mm, 20 cm]'
}
mapfile -t narrow < <(opening 2)
mapfile -t wide < <(opening 5)
expect 2 "walls\.2: between this wall, 'right', and wall 'left' is an opening of 0\.004 m below source 'belt', and the narrowest particle is 0\.0069 m wide: none passes; make the opening wider" \
    "$scree" check pile-hopper --quick "${narrow[@]}"
expect 2 'an opening of 0\.004 m below source' "$scree" run pile-hopper --quick "${narrow[@]}" -o narrow
[ -e narrow/series.csv ] && complain "a funnel that nothing passes was run"
expect 0 "warning .*the opening of 0\.01 m between walls 'left' and 'right', below source 'belt', may clog: the largest particles have a diameter of 0\.0089 m; make it 3 of them wide" \
    "$scree" check pile-hopper --quick "${wide[@]}"
expect 0 'pile-hopper' "$scree" check pile-hopper --quick
grep -q 'opening' <<<"$output" && complain "the funnel of the case is warned of: $output"

# Of walls that move only a run tells: one that ends says so, one that goes on pouring stops.
funnel=(--quick --no-figures --quiet --set output.paraview=no --set stages.pour.rest_time='50 ms' --set stages.settle.duration='1 ms'
    --set walls.left.velocity='[1e-12, 0]' --set walls.right.velocity='[1e-12, 0]'
    --set walls.left.corners='[[-8 mm, 156 mm], [-2 mm, 156 mm], [-32 mm, 186 mm], [-38 mm, 186 mm]]'
    --set walls.right.corners='[[2 mm, 156 mm], [8 mm, 156 mm], [38 mm, 186 mm], [32 mm, 186 mm]]'
    --set sources.belt.start='[-3 mm, 17 cm]' --set sources.belt.end='[3 mm, 17 cm]')
expect 0 "warning: grains that are no part of the pile on wall 'plate' touch other walls at [0-9]* points: .*funnel, it has clogged.*opening wider" \
    "$scree" run pile-hopper "${funnel[@]}" --set particles.count=4 -o clogged
same "$("$scree" get clogged grains)" 0 "grains of a pile on the plate below a clogged funnel"
"$scree" get clogged warnings | grep -q 'there is no pile' || complain "a pile without a grain is told of: $("$scree" get clogged warnings)"
# Without a named plate they are told of as the pile; of a funnel that is open nothing is said.
expect 0 "warning: 4 of the 4 grains of the pile do not rest on wall 'plate', the lowest one below the sources, but on others alone: .*funnel, it has clogged.*opening wider; give measure\.plate" \
    "$scree" run pile-hopper "${funnel[@]}" --set particles.count=4 --set measure.plate=auto -o unnamed
same "$("$scree" get unnamed grains)" 4 "grains in a clogged funnel, of all that stands"
expect 3 "source 'belt' has been blocked .*the pile has reached the source, or a funnel has clogged" \
    "$scree" run pile-hopper "${funnel[@]}" --set particles.count=40 --set stages.pour.patience='0.1 s' -o choked

# Through an open one all come to the plate, and lie between its sides as well.
expect 0 'results in open' "$scree" run pile-hopper --quick --no-figures --set output.paraview=no --set particles.count=4 \
    --set measure.plate=auto --set sources.belt.interval='20 ms' -o open
grep -q 'funnel, it has clogged' <<<"$output" && complain "an open funnel is told of as clogged: $output"
same "$("$scree" get open grains)" 4 "grains below an open funnel"

# A pile that moves, and one that has not come to lie yet, are done, but not without a word; one at rest is.
moving=("${small[@]}" --quiet --set particles.count=12 --set sources.spout.place='[0, 5 cm]' --set stages.pour.rest_time='1 ms')
expect 0 "warning: the pile is not at rest: unbalanced 0\.[0-9]*, weight_ratio [0-9.]* .at rest: below 1e-05, and 1 to within 0\.001.: .*lengthen stage 'settle'" \
    "$scree" run good.yaml "${moving[@]}" --set stages.settle.duration='1 ms' -o moving
"$scree" get moving warnings | grep -q '^the pile is not at rest: unbalanced 0' || complain "warnings of a pile that moves: $("$scree" get moving warnings)"
awk -v ratio="$("$scree" get moving weight_ratio)" -v unbalanced="$("$scree" get moving unbalanced)" 'BEGIN { exit !(unbalanced > 1e-5 || (ratio - 1) ^ 2 > 1e-6) }' ||
    complain "the pile that moves is at rest"
expect 0 "warning: there is no pile: .*if they still fall, lengthen stage 'settle'" \
    "$scree" run good.yaml "${small[@]}" --quiet --set particles.count=1 --set stages.pour.rest_time='1 ms' --set stages.settle.duration='1 ms' -o falling
expect 0 "not at rest: .*give a smaller stages\.1\.unbalanced_limit, or a stage relax behind it" \
    "$scree" run pour-discs --quick --quiet --no-figures --set output.paraview=no --set particles.count=12 --set stages.pour.unbalanced_limit=0.5 -o restless
expect 0 '' "$scree" run good.yaml "${moving[@]}" --set particles.count=4 -o settled
same "$("$scree" get settled warnings | grep -c 'not at rest')" 0 "warnings of a pile at rest"

# A polygon larger than its domain, and one that strikes too hard.
cat >big.yaml <<'CASE'
scree: 1
name: big
dimension: 2
gravity: [0, -10]
materials:
  - {name: stone, young_modulus: 1e7 Pa, density: 2500 kg/m3, friction: 0.5}
particles: {shape: polygon, thickness: 1 m, material: stone, count: 1, distribution: equal, radius: 5 cm}
contact: {law: polygon_potential}
integrator: {step: 1e-6 s}
walls:
  - {shape: box, name: vessel, lower: [0, 0], upper: [4 cm, 4 cm]}
stages:
  - {stage: prepare, method: bodies, width: 4 cm, height: 4 cm, bodies: [{position: [2 cm, 2 cm]}]}
  - {stage: relax, boundary: walls, duration: 0.01 s}
CASE
expect 2 "particle 0 at .* is in wall 'vessel'.*move the wall" "$scree" run big.yaml --no-figures -o big
sed 's/method: bodies.*}/method: gas, width: 4 cm, solid_fraction: 30 %, velocity: 0.1 m\/s}/' big.yaml >bad.yaml
expect 2 "^bad\.yaml:13:[0-9]+: stages\.0\.width: .*does not fit into a box 0\.04 m wide" "$scree" check bad.yaml
sed 's/radius: 5 cm/radius: 1.9 cm, axis_ratio: 4/; s/method: bodies.*}/method: gas, width: 4 cm, solid_fraction: 30 %, velocity: 0.1 m\/s}/' big.yaml >bad.yaml
expect 2 'stages\.0\.width: a particle with a bounding circle of radius 0\.0[0-9]* m does not fit into a box 0\.04 m wide and' "$scree" run bad.yaml --no-figures -o long
sed 's/^walls:/boundary: {periodic: xy}/; /shape: box/d; s/, boundary: walls//; s/^gravity: .*/gravity: [0, 0]/; s/radius: 5 cm/radius: 1 cm/
    s/method: bodies.*}/method: gas, width: 3 cm, solid_fraction: 30 %, velocity: 0.1 m\/s}/' big.yaml >bad.yaml
expect 2 'stages\.0\.width: the periodic cell is only 0\.03 m wide along x, .*two of the largest particles side by side .0\.04 m.: make it wider' "$scree" check bad.yaml
sed 's/radius: 5 cm/radius: 1 cm/; s/young_modulus: 1e7/young_modulus: 1e4/; s/\[{position: \[2 cm, 2 cm\]}\]/[{position: [2 cm, 2 cm], velocity: [0, -20]}]/; s/step: 1e-6/step: 1e-5/' big.yaml >bad.yaml
expect 3 'particle 0 at .*guard\.overlap.*try a stiffer material' "$scree" run bad.yaml --no-figures -o deep
expect 0 'stopped' "$scree" get deep status
expect 0 'snapshot [0-9]* .*nothing can go on from it: snapshot [0-9]* has no state to go on from: it shows what a guard stopped, or was kept so' "$scree" check deep

# Two that strike within one large step: which the other one is, and that it is wholly inside.
cat >strike.yaml <<'CASE'
scree: 1
name: strike
gravity: [0, 0]
materials:
  - {name: stone, young_modulus: 1e5 Pa, density: 2500 kg/m3, friction: 0.5}
particles: {shape: polygon, outline: regular, material: stone, thickness: 1 m, count: 2, radius_min: 4 mm, radius_max: 4 cm}
contact: {law: polygon_overlap}
integrator: {scheme: velocity_verlet, step: 4e-3 s}
guard: {stability: warn}
walls:
  - {shape: plane, point: [0, -50 cm], normal: [0, 1]}
stages:
  - {stage: prepare, method: bodies, width: 40 cm, height: 40 cm, bodies: [{position: [20 cm, 20 cm], radius: 4 cm}, {position: [20 cm, 25 cm], radius: 5 mm, velocity: [0, -9 m/s]}]}
  - {stage: relax, boundary: walls, duration: 0.01 s}
measure: {cells: no}
output: {paraview: no, figures: no}
CASE
expect 3 'particle 0 at .*guard\.overlap. by particle 1: one of them lies inside the other; .*a slower rate or a smaller step' "$scree" run strike.yaml -o strike
sed 's/-9 m/-3 m/' strike.yaml >bad.yaml
expect 3 'particle 0 at .*guard\.overlap. by particle 1; .*a smaller step' "$scree" run bad.yaml -o strike-less

finish
