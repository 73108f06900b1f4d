#!/usr/bin/env bash
# Paths in stress and strain, and steady shear, as a user runs them: small forms of the built-in cases, what they keep,
# what `scree get` says, the figures.
. "$(dirname "$0")/check.sh"

column() { awk -F, -v name="$2" -v stage="$3" 'NR == 1 { for (k = 1; k <= NF; k++) { split($k, part, " "); at[part[1]] = k } next }
    $at["stage"] == stage { print $at[name] }' "$1/series.csv"; }
range() { column "$@" | awk 'NR == 1 { low = high = $1 } { if ($1 < low) low = $1; if ($1 > high) high = $1 } END { print low, high }'; }
# within NAME LOW HIGH VALUE
within() {
    checks=$((checks + 1))
    awk -v x="$4" -v low="$2" -v high="$3" 'BEGIN { exit !(x + 0 == x && x >= low && x <= high) }' || complain "$1 is $4, not in $2 .. $3"
}
small=(--quick --quiet --set particles.count=100 --set output.paraview=no)

expect 0 '' "$scree" run periodic-shear "${small[@]}" --no-figures --set stages.deform.strain=40% -o s
expect 0 '.' "$scree" get s mu mu_error mu_from inertial_number quasistatic
within mu 0.15 0.45 "$("$scree" get s mu)"
within mu_error 1e-3 0.1 "$("$scree" get s mu_error)"
mean=$(column s mu 2 | awk '{ sum += $1 } END { print sum / NR }')
within "mean of the column mu" 0.1 0.5 "$mean"
expect 2 'peak_stress_ratio' "$scree" get s peak_stress_ratio

expect 0 '' "$scree" run undrained-cyclic "${small[@]}" --set stages.load_path.cycles=1 \
    --set "stages.load_path.reverse_stress=15 kPa" -o u
read -r low high < <(range u void_ratio 2)
same "$(printf %.8f "$low")" "$(printf %.8f "$high")" "the void ratio changes at constant volume"
read -r low high < <(range u q 2)
within "largest q" 13e3 25e3 "$high"
within "least q" -25e3 -13e3 "$low"
for figure in path-p-q path-strain; do [ -s "u/figures/$figure.png" ] || complain "there is no figure $figure"; done

expect 0 '' "$scree" run oedometer "${small[@]}" --no-figures --set stages.load.strain=0.5% --set stages.unload.strain=0.1% -o o
read -r low high < <(range o strain_xx 3)
same "$low $high" "0 0" "lateral strain between plates that stand"
read -r low high < <(range o strain_yy 3)
within "strain at which unloading begins" 0.00499 0.00501 "$high"
within "strain at its end" 0.00399 0.00401 "$low"
# Charts go through both stages, and so does the peak, which lies where the strain turns.
expect 0 'stress-ratio.svg' "$scree" plot o --only stress-ratio
expect 0 'volumetric-strain.svg' "$scree" plot o --only volumetric-strain
for chart in stress-ratio volumetric-strain; do
    read -r most last < <(awk -F, 'NR > 1 { if ($1 > most) most = $1; last = $1 } END { print most, last }' o/figures/$chart.csv)
    within "largest strain of $chart" 0.499 0.501 "$most"
    within "last strain of $chart" 0.399 0.401 "$last"
done
read -r most last < <(awk -F, 'NR > 1 { if ($2 > most) most = $2; last = $2 } END { print most, last }' o/figures/volumetric-strain.csv)
within "volumetric strain, compression positive" 0.2 0.6 "$most"
within "its end, behind both stages" 0.15 "$most" "$last"
expect 0 'path-p-q' "$scree" plot s --only path-p-q
grep -q 'shear stress (kPa)' s/figures/path-p-q.gp || complain "the stress path of a sheared sample has no shear stress"

expect 2 'strain_rate' "$scree" run oedometer "${small[@]}" --set "stages.load.stress={yy: 1 kPa}" -o no

# --- bonds hold what no stress is asked of
cat >bonded.yaml <<'END'
name: bonded
materials: [{name: disc, young_modulus: 200 GPa, poisson_ratio: 0.35, density: 2000 kg/m3, friction: 0, normal_stiffness: 7e10 N/m, stiffness_ratio: 0.5, damping_ratio: 0}]
particles: {shape: disc, material: disc, count: 100, distribution: uniform, radius_min: 0.3 mm, radius_max: 0.5 mm, thickness: 1 m}
contact: {law: linear}
loads: [{load: background_damping, translation: 0.2, rotation: 0.2}]
integrator: {step: 20 ns}
stages:
  - {stage: prepare, method: dense, solid_fraction: 91 %, aspect_ratio: 1}
  - {stage: bond, gap_tolerance: 10 um, overlap_tolerance: 40 um}
  - {stage: load_path, name: press, boundary: plates, strain_rate: {xx: -0.2 1/s, yy: -0.2 1/s}, time: 0.1 ms}
output: {snapshots: 1, figures: no, paraview: no}
END
expect 0 '^' "$scree" run bonded.yaml --quiet -o b
within 'energy balance' 0 1e-6 "$("$scree" get b energy_residual)"
within 'pressure' 1e6 3e6 "$(column b p 2 | tail -1)"
# Plates that go away leave a sample at rest, whose balance is round-off.
sed 's/rate: {xx: -0.2 1.s, yy: -0.2 1/rate: {xx: 100 1\/s, yy: 100 1/; s/time: 0.1 ms/time: 20 us/' bonded.yaml >away.yaml
expect 0 '^' "$scree" run away.yaml --quiet -o away
for keep in 'volume' 'lateral_strain'; do
    sed "s/strain_rate: {.*}, time/strain_rate: {yy: -0.2 1\/s}, keep: $keep, time/" bonded.yaml >kept.yaml
    expect 0 'press' "$scree" check kept.yaml
done
sed 's/, yy: -0.2 1.s}/}, stress: {yy: 1 kPa}/' bonded.yaml >half.yaml
expect 2 'half.yaml:10:13: stages.2.stage: a confine stage must come before: load_path begins with its pressure' "$scree" check half.yaml

finish
