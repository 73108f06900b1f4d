#!/usr/bin/env bash
# Gravity is halved on a small pile: the stage does not end before gravity has come to its end, what is found depends less
# and less on how fast that was, the numbers of the run are those of scree measure, and what cannot be done is said.
# shellcheck source=tests/cli/check.sh
. "$(dirname "$0")/check.sh"

small=(--set particles.count=60 --set sources.spout.interval="20 ms" --set output.paraview=no --set output.figures=no
    --threads 1 --quiet)
make_case() { # RAMP: a pile of discs that settles, and on which gravity is halved within a time
    "$scree" new pour-discs | sed -e "s/^measure:/  - {stage: relax, name: settle, duration: 3 s, unbalanced_limit: 1e-9}\n  - {stage: relax, name: change, duration: 4 s, unbalanced_limit: 1e-9, gravity: [[0 s, 0, -9.81], [$1, 0, -4.905]]}\nloads:\n  - {load: background_damping, from: settle, translation: 0.7, rotation: 0.7}\nmeasure:\n  compare_with: settle/" >"change.yaml"
}
number() { "$scree" get "$1" "$2" 2>&1; }
# All of one seed go on behind the pile of the first.
for ramp in 10 80 320; do
    make_case "$ramp ms"
    if [ $ramp = 10 ]; then pile=(); else pile=(--after run10); fi
    expect 0 '' "$scree" run change.yaml "${small[@]}" "${pile[@]}" -o run$ramp
    same "$(number run$ramp gravity_ratio)" 0.5 "gravity at the end of a ramp of $ramp ms"
done
# The limit of the unbalanced force, which a slow ramp is below all the time, is asked at the end of the ramp alone.
expect 0 '' "$scree" run change.yaml "${small[@]}" --set stages.change.unbalanced_limit=0.5 --after run10 -o early
same "$(number early gravity_ratio)" 0.5 "gravity where the limit is wide"
# The difference of runs from the slowest one falls with the rate; numbers that are not there fail here, too.
for name in vertical_pressure_ratio horizontal_pressure_ratio mobilised_ratio strain_mean displacement_top; do
    checks=$((checks + 1))
    awk -v a="$(number run10 $name)" -v b="$(number run80 $name)" -v c="$(number run320 $name)" \
        'function size(x) { return x < 0 ? -x : x } BEGIN { exit !(c != 0 && size(b - c) < 0.01 * size(c) && size(b - c) < 0.5 * size(a - c) + 1e-3 * size(c)) }' ||
        complain "$name depends on the rate: $(number run10 $name) $(number run80 $name) $(number run320 $name)"
done
# Vertical forces follow gravity, horizontal ones lag behind (friction holds them).
checks=$((checks + 1))
awk -v v="$(number run320 vertical_pressure_ratio)" -v h="$(number run320 horizontal_pressure_ratio)" \
    'BEGIN { exit !(v > 0.47 && v < 0.56 && h > v) }' || complain "pressures"

# The same numbers from the snapshots, and tables and figures.
expect 0 'bulk_modulus_core' "$scree" measure run320 --fields stress,fabric,density,elastic --from settle --grid 12x8 --kernel 4 -o one
for name in bulk_modulus_core young_modulus_core strain_cambou_deviation fabric_factor_theory bulk_modulus_fabric_correlation; do
    same "$(number one $name)" "$(number run320 $name)" "the run's own $name"
done
for file in cuts-bulk-modulus.png fabric-bulk-modulus.png invariants.png map-bulk-modulus.png kernel-bulk-modulus.png displacements.png; do
    checks=$((checks + 1))
    [ -s "one/$file" ] || complain "there is no one/$file"
done
# Displacements are arrows, in figures of the run, too; without a comparison there are none.
same "$(number run320 compared_with)" settle "the stage of the earlier state"
expect 0 'displacements.svg' "$scree" plot run320 --only displacements
expect 0 'not at rest.*lengthen stage .change.' "$scree" run change.yaml "${small[@]}" --set measure.compare_with=auto --set stages.settle.duration="10 ms" --set stages.change.duration="10 ms" -o alone
expect 2 'no figure of this name' "$scree" plot alone --only displacements
checks=$((checks + 1))
head -1 one/kernel.csv | grep -q 'stress_change_xx \[Pa\].*gradient_xy \[1\].*bulk_modulus \[Pa\]' || complain "smooth constants"

# An ensemble has bands of the constants, and the dip of the strain with its interval.
expect 0 '' "$scree" run change.yaml "${small[@]}" --set seed=2 -o other
expect 0 'bulk_modulus_core' "$scree" measure run320 other --fields elastic --from settle --no-figures -o both
checks=$((checks + 1))
head -1 both/cuts.csv | grep -q 'bulk_modulus_low \[Pa\],bulk_modulus_high \[Pa\]' || complain "bands"
expect 0 '^[01](\.|$)' "$scree" get both strain_dip_p
for name in cambou liao difference bagi; do
    expect 0 '^-?[01](\.|$)' "$scree" get both strain_dip_${name}_checked
    same "$(head -1 both/strain-dips-$name.csv)" "$(head -1 both/strain-dips.csv)" "dips by $name"
    same "$(number one strain_dip_$name)" "$(number run320 strain_dip_$name)" "the run's own strain_dip_$name"
done
# Of one run the tables by cuts have the same dips under the same names.
for name in "" cambou liao difference bagi; do
    checks=$((checks + 1))
    awk -F, -v told="$(number one "strain_dip${name:+_$name}")" 'NR == 2 { found = $2 }
        END { off = found - told; exit !(told >= 0 && off < 1e-6 && off > -1e-6) }' "one/strain-dips${name:+-$name}.csv" ||
        complain "strain dip $name: $(number one "strain_dip${name:+_$name}"), $(sed -n 2p "one/strain-dips${name:+-$name}.csv")"
done
# The distribution of the coordination number.
same "$(number one coordination_elements_ratio)" "$(number run320 coordination_elements_ratio)" "the run's own"

expect 0 'warning: .*earlier state was not at rest' "$scree" measure run320 --fields elastic --from '#12' --no-figures -o moving
expect 0 'the earlier state not at rest' "$scree" get moving warnings
expect 2 '--fields: .*two states.*--from' "$scree" measure run320 --fields elastic
expect 2 'measure.compare_with: .*stage .*stettle.*settle' "$scree" check change.yaml --set measure.compare_with=stettle
finish
