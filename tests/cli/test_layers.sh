#!/usr/bin/env bash
# Layers under a load on one grain: what a run tells, against closed forms and identities; the same bits with threads
# and after a restart; averages of the response; what cannot be is said with its key and the way out.
# shellcheck source=tests/cli/check.sh
. "$(dirname "$0")/check.sh"

layer=(layer-friction --threads 1 --quiet --set output.paraview=no --set output.figures=no --set particles.count=60
    --set stages.place.angle="60 degrees" --set stages.place.width="9.0005 cm" --set "walls.right.point=[9 cm, 0]"
    --set loads.piston.until_force="20 N")

# A number of a run within limits.
between() {
    checks=$((checks + 1))
    awk -v value="$("$scree" get "$1" "$2")" -v low="$3" -v high="$4" 'BEGIN { exit !(value >= low && value <= high) }' ||
        complain "$2 of $1 is $("$scree" get "$1" "$2"), not between $3 and $4"
}

# Without friction all forces point along the contacts, at multiples of 60 degrees; rows bear the load.
expect 0 '' "$scree" run "${layer[@]}" --set materials.stone.friction=0 -o smooth
between smooth response_order 0.9999 1
between smooth response_force_order 0.9999 1
between smooth response_missing 0 1e-3
between smooth response_force 19.999999 20.000001
between smooth response_grain_weights 6.3 6.5
# Two diameters hold 16 / (2 sqrt 3) = 4.6 touching discs; a layer counts the gaps at its ends.
between smooth response_element_grains 3.9 4.6
"$scree" get smooth warnings | grep -q 'elements of the response hold .* grains, fewer than 30' || complain "nothing is said of the few grains in elements of a response"
expect 0 '' "$scree" run "${layer[@]}" -o rough
between rough response_order 0.9999 1
between rough response_force_order -1 0.95
between rough response_missing 0 1e-3
same "$(wc -l <rough/response-depths.csv)" 9 "eight depths"
same "$(grep -c '^made' rough/response-contacts.csv)" "$("$scree" get rough response_made)" "contacts made"
same "$(grep -c '^lost' rough/response-contacts.csv)" "$("$scree" get rough response_lost)" "contacts lost"
same "$(grep -c '^sliding' rough/response-contacts.csv)" "$("$scree" get rough response_sliding)" "contacts brought to sliding"
head -1 rough/response.csv | grep -q 'depth \[m\],x \[m\].*vertical \[Pa\].*half_space \[Pa\].*bonded_horizontal \[Pa\]$' || complain "columns of response.csv"
# Horizontal responses at the base beside the theories, from the table again: largest over largest, root mean square of
# the difference within a thickness of the load over the peak.
for theory in half_space smooth bonded; do
    awk -F, -v theory="${theory}_horizontal [Pa]" -v thickness="$("$scree" get rough response_thickness)" '
        NR == 1 { for (k = 1; k <= NF; k++) { if ($k == "horizontal [Pa]") h = k; if ($k == theory) t = k } next }
        $1 != depth { depth = $1; most = peak = sum = number = 0 }
        { if ($h > most) most = $h; if ($t > peak) peak = $t }
        $2 <= thickness { w = $2 == 0 ? 1 : 2; sum += w * ($h - $t)^2; number += w }
        END { printf "%.5g %.5g\n", most / peak, sqrt(sum / number) / peak }' rough/response.csv >wanted
    awk '{ printf "%.5g %.5g\n", $1, $2 }' <<<"$("$scree" get rough "response_horizontal_over_$theory") $("$scree" get rough "response_horizontal_misfit_$theory")" >found
    same "$(cat found)" "$(cat wanted)" "horizontal response and $theory"
done
# The largest load that changes nothing is told from a load that begins slowly; a run that is
# continued before and after the first change, or on two threads, tells the same. The contacts are those of the snapshots.
slow=("${layer[@]}" --set loads.piston.velocity_y="{from: 0 m/s, to: -10 mm/s, begin: 0 s, end: 4 s}" --set stages.press.duration="60 ms")
expect 0 '' "$scree" run "${slow[@]}" -o slow
expect 0 '' "$scree" run "${slow[@]}" --set materials.stone.friction=0.1 -o slippery
# With little friction a contact slides first, with more one is made under a larger load.
same "$("$scree" get slow response_first_made)$("$scree" get slow response_first_sliding)" 10 "what changes first with friction 0.3"
same "$("$scree" get slippery response_first_made)$("$scree" get slippery response_first_sliding)" 01 "what changes first with friction 0.1"
between slippery response_unchanged_force 0.05 0.2
for run in slow slippery; do
    least=$("$scree" get $run response_unchanged_force)
    between $run response_changed_force "$least" "$(awk -v f="$least" 'BEGIN { print 1.05 * f }')"
    friction=0.3
    [ $run = slippery ] && friction=0.1
    # A load below it changes no contact to the end, a larger one does; at this velocity waves are some 5 % of the load.
    for part in 0.92 1.06; do
        expect 0 '' "$scree" run "${slow[@]}" --set materials.stone.friction=$friction --set loads.piston.until_force="$(awk -v f="$least" -v p=$part 'BEGIN { print p * f }') N" -o $run-$part
        sum=$("$scree" get $run-$part response_made response_lost response_sliding | awk '{ s += $2 } END { print s }')
        [ $part = 0.92 ] && { same "$sum" 0 "contacts that a smaller load changes, $run"; between $run-$part response_unchanged_force "$(awk -v f="$least" 'BEGIN { print 0.919 * f }')" 1; }
        [ $part = 0.92 ] || between $run-$part response_unchanged_force "$(awk -v f="$least" 'BEGIN { print 0.9 * f }')" "$(awk -v f="$least" 'BEGIN { print 1.05 * f }')"
        [ $part = 0.92 ] || between $run-$part response_changed_force 0 1
    done
done
expect 0 '' "$scree" run "${slow[@]}" --threads 2 -o slow2
cp -r slow slow4
cp -r slow slow24
expect 0 '' "$scree" run --restart slow4 --from 4 --quiet
expect 0 '' "$scree" run --restart slow24 --from 24 --quiet
for run in slow2 slow4 slow24; do
    for result in unchanged_force changed_force first_made first_lost first_sliding; do
        same "$("$scree" get $run response_$result)" "$("$scree" get slow response_$result)" "$result of $run"
    done
done
# A load that changes nothing: all of it, and no first change.
expect 0 '' "$scree" run "${slow[@]}" --set loads.piston.until_force="0.2 N" -o faint
between faint response_unchanged_force 0.1999 0.2001
expect 2 'no result .response_changed_force' "$scree" get faint response_changed_force
same "$("$scree" get faint response_made) $("$scree" get faint response_lost) $("$scree" get faint response_sliding)" "0 0 0" "contacts that a faint load changes"

# Threads.
expect 0 '' "$scree" run "${layer[@]}" --threads 2 -o two
same "$("$scree" get two state_checksum)" "$("$scree" get rough state_checksum)" "two threads"
cmp -s two/response.csv rough/response.csv || complain "response.csv of two threads"

# Mean responses of runs, over thickness and load, and theories fitted to them: one layer, an ensemble, and what cannot be.
expect 0 'fit_layer_bonded_poisson_ratio' "$scree" measure rough --fit layer --no-figures -o one
expect 0 'fit_flamant_information' "$scree" measure rough slow smooth --fit flamant,layer_bonded --no-figures -o three
for run in rough slow smooth; do
    expect 0 'volume_fraction' "$scree" measure $run --no-figures -o m-$run
    awk -F, -v OFS=, 'NR > 1 { print $1, $2, $4 }' m-$run/response.csv >m-$run.txt
done
paste -d, m-rough.txt m-slow.txt m-smooth.txt | awk -F, '!/nan/ { printf "%.5g %.5g\n", $2, ($3 + $6 + $9) / 3 }' >wanted
awk -F, 'NR == 1 { for (k = 1; k <= NF; k++) { if ($k == "x [1]") x = k; if ($k == "vertical [1]") v = k } next } !/nan/ { printf "%.5g %.5g\n", $x, $v }' three/response.csv >found
same "$(cat found)" "$(cat wanted)" "mean response of three runs"
[ "$(wc -l <found)" -gt 100 ] || complain "mean response of three runs: few places"
# At the load at a half of the depth: response times thickness over load, from the run's own table.
awk -F, -v h="$("$scree" get rough response_thickness)" -v f="$("$scree" get rough response_force)" '
    NR == 1 { for (k = 1; k <= NF; k++) if ($k == "vertical [Pa]") v = k; next }
    $1 != depth { depth = $1; if (++level == 4) printf "%.6g\n", $v * h / f }' rough/response.csv >wanted
awk -F, 'NR > 1 && $2 == 0 && ++level == 4 { printf "%.6g\n", $4 }' m-rough/response.csv >found
same "$(cat found)" "$(cat wanted)" "response below the load at a half"
expect 2 '--fit: theories of piles and of layers are not' "$scree" measure rough --fit osl,layer_smooth --no-figures -o no0
expect 2 "--fit: there is no theory 'layers'" "$scree" measure rough --fit layers --no-figures -o no0

# A lattice takes grains of several sizes where the distance of their centres is said, else it does not.
sizes=(--set particles.distribution=uniform --set particles.radius_min="4.49955 mm" --set particles.radius_max="4.5 mm")
expect 0 '' "$scree" run "${layer[@]}" "${sizes[@]}" --set stages.place.distance="9 mm" -o uneven
between uneven response_order 0.999 0.9999999
expect 2 'a lattice needs particles of one radius' "$scree" run "${layer[@]}" "${sizes[@]}" -o no0

# What cannot be.
expect 2 "selections.0.x: .*0.3 m: it lies behind the wall 'right'.*between the walls" "$scree" check layer-friction "${layer[@]:4}" --set selections.top-grain.x="30 cm"
expect 2 "selections.0.x: .*-1e-06 m: it lies behind the wall 'left'" "$scree" check layer-friction "${layer[@]:4}" --set selections.top-grain.x="-1 um"
expect 0 'time step' "$scree" check layer-friction "${layer[@]:4}" --set selections.top-grain.x="9 cm"
# Where no wall says so the sample does, when the load begins, and nothing is said of a response.
expect 2 "selections.0.x: .*'top-grain' .*0.3 m outside of the sample.*0.09" "$scree" run "${layer[@]}" --set walls.right.velocity="[1e-9, 0]" --set selections.top-grain.x="30 cm" -o no1
grep -q 'no response' <<<"$output" && complain "a load that is refused: $output"
expect 2 "measure.response_load: .*load of the kind prescribed.*'pisto'.*piston" "$scree" run "${layer[@]}" --set measure.response_load=pisto -o no2
expect 2 'loads.0.until_force: .*velocity' "$scree" run "${layer[@]}" --set loads.piston.velocity_y=0 -o no3
expect 2 'selections.0.y: .*upwards.*auto' "$scree" check layer-friction --set selections.top-grain.y="1 cm"
sed 's/{select: top, name: top-grain}/{select: ids, name: top-grain, ids: [3]}/' <("$scree" new layer-friction) >below.yaml
expect 2 'measure.response_load: .*particle 3, which is not at the top: particle [0-9]+ stands over it' "$scree" run below.yaml "${layer[@]:1}" -o no4
sed 's/ids: \[3\]/ids: [58, 59]/' below.yaml >several.yaml
expect 2 "measure.response_load: .*2 particles of 'top-grain'.*one grain" "$scree" check several.yaml
sed 's/{select: top, name: top-grain}/{select: band, name: top-grain, axis: y, measured: high, from: 0 mm, to: 6 mm}/' <("$scree" new layer-friction) >band.yaml
expect 2 'measure.response_load: .*particle [0-9]+ and on particle [0-9]+' "$scree" run band.yaml "${layer[@]:1}" -o no5
grep -q 'no response' <<<"$output" && complain "a load on several grains: $output"
expect 2 'measure.response_element: an element of 0.3 m is larger than the layer, which is 0.09.* m wide and 0.0.* m high' "$scree" run "${layer[@]}" --set measure.response_element="30 cm" -o no6
# A load that the layer does not bear: no response, and why.
expect 0 'no response: the layer gives way.*until_force.*smaller' "$scree" run "${layer[@]}" --set loads.piston.until_force="1 MN" --set stages.press.duration="2 ms" --set stages.hold.duration="2 ms" -o yields
expect 2 'no result .response_force' "$scree" get yields response_force

# A load that begins where nothing touches: the contact that is made is the change.
cat >fall.yaml <<END
name: fall
gravity: [0, -10]
materials: [{name: stone, young_modulus: 10 MPa, poisson_ratio: 0.3, density: 5000 kg/m3, friction: 0}]
particles: {material: stone, thickness: 1 m, count: 1, distribution: equal, radius: 5 mm}
integrator: {step: 1e-5 s}
walls: [{shape: plane, name: plate, point: [0, 0], normal: [0, 1]}]
selections: [{select: top, name: one}]
loads: [{load: prescribed, name: piston, selection: one, from: fall, force_y: -1 N}]
stages: [{stage: prepare, method: bodies, bodies: [{position: [0, 6 mm]}]}, {stage: relax, name: fall, duration: 20 ms}]
measure: {samples: 20, cells: no, response_load: piston}
output: {figures: no, paraview: no}
END
expect 0 'there are no contacts' "$scree" run fall.yaml -o fall -q
same "$("$scree" get fall response_changed_force)" 1 'the load at a first contact'
same "$("$scree" get fall response_first_made)" 1 'a first contact'
finish
