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
# A larger load, with the same layer, changes more contacts; the first is its limit.
between rough response_unchanged_force 0 20

# Threads.
expect 0 '' "$scree" run "${layer[@]}" --threads 2 -o two
same "$("$scree" get two state_checksum)" "$("$scree" get rough state_checksum)" "two threads"
cmp -s two/response.csv rough/response.csv || complain "response.csv of two threads"

# What cannot be.
expect 2 "selections.0: .*'top-grain' .*0.3 m outside of the sample.*0.09" "$scree" run "${layer[@]}" --set selections.top-grain.x="30 cm" -o no1
expect 2 "measure.response_load: .*load of the kind prescribed.*'pisto'.*piston" "$scree" run "${layer[@]}" --set measure.response_load=pisto -o no2
expect 2 'loads.0.until_force: .*velocity' "$scree" run "${layer[@]}" --set loads.piston.velocity_y=0 -o no3
expect 2 'selections.0.y: .*upwards.*auto' "$scree" check layer-friction --set selections.top-grain.y="1 cm"
sed 's/{select: top, name: top-grain}/{select: ids, name: top-grain, ids: [3]}/' <("$scree" new layer-friction) >below.yaml
expect 2 'measure.response_load: .*particle 3, which is not at the top: particle [0-9]+ stands over it' "$scree" run below.yaml "${layer[@]:1}" -o no4
sed 's/ids: \[3\]/ids: [58, 59]/' below.yaml >several.yaml
expect 2 'measure.response_load: .*particle 58 and on particle 59' "$scree" run several.yaml "${layer[@]:1}" -o no5
expect 2 'measure.response_element: an element of 0.3 m is larger than the layer, which is 0.09.* m wide and 0.0.* m high' "$scree" run "${layer[@]}" --set measure.response_element="30 cm" -o no6
# A load that the layer does not bear: no response, and why.
expect 0 'no response: the layer gives way.*until_force.*smaller' "$scree" run "${layer[@]}" --set loads.piston.until_force="1 MN" --set stages.press.duration="2 ms" --set stages.hold.duration="2 ms" -o yields
expect 2 'no result .response_force' "$scree" get yields response_force
finish
