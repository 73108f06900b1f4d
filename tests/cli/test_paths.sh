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

expect 2 'strain_rate' "$scree" run oedometer "${small[@]}" --set "stages.load.stress={yy: 1 kPa}" -o no

finish
