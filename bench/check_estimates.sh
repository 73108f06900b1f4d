#!/bin/bash
# What `scree check` promises against what runs take: bench/check_estimates.sh SCREE [NAME...]. Runs every built-in case
# in its quick form, a restless 200,000 discs and 50,000 spheres with all output, or those given, with one thread: some
# minutes. Times are processor times (user and system, of the drawing programs too), so that other work on the machine
# disturbs little; memory is the largest resident set. Needs GNU time. Wanted: time within a factor of 1.5, memory of 1.2.
set -euo pipefail
scree=$(realpath "${1:?usage: bench/check_estimates.sh SCREE [NAME...]}")
shift
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
[ $# -gt 0 ] && names=("$@") || { mapfile -t names < <("$scree" list | awk '{print $1}'); names+=(discs-200000 spheres-50000); }

# A packing between plates, a few steps and much output: write_large DIMENSION SHAPE COUNT DURATION.
write_large() {
    cat <<YAML
scree: 1
name: large
dimension: $1
materials: [{name: quartz, young_modulus: 3 GPa, density: 2.675e8 kg/m3, friction: 0.45, restitution: 0.2}]
particles: {shape: $2, material: quartz, count: $3, radius_min: 0.5 mm, radius_max: 1 mm}
contact: {law: hertz_mindlin}
integrator: {scheme: velocity_verlet, step: 2e-5 s}
stages: [{stage: prepare, aspect_ratio: 2}, {stage: relax, boundary: plates, duration: $4}]
measure: {samples: 10}
output: {snapshots: 4}
YAML
}
write_large 2 disc 200000 "20 ms" >"$scratch/discs-200000.yaml"
write_large 3 sphere 50000 "5 ms" >"$scratch/spheres-50000.yaml"


printf '| case | time, estimate (s) | run (s) | estimate over run | memory, estimate (MB) | run (MB) | estimate over run |\n'
printf '|---|---|---|---|---|---|---|\n'
for name in "${names[@]}"; do
    what=("$name" --quick)
    [ -f "$scratch/$name.yaml" ] && what=("$scratch/$name.yaml")
    "$scree" check "${what[@]}" >"$scratch/check"
    /usr/bin/time -f '%U %S %M' -o "$scratch/time" "$scree" run "${what[@]}" --threads 1 --quiet --force -o "$scratch/run" >/dev/null
    read -r user system resident < <(tail -n 1 "$scratch/time")
    awk -v name="$name" -v user="$user" -v kernel="$system" -v resident="$resident" '
        /^# time needed / { line = $0; sub(/^# time needed */, "", line); sub(/,.*/, "", line); n = split(line, w, " ")
            for (i = 1; i < n; i += 2) time += w[i] * (w[i+1] == "d" ? 86400 : w[i+1] == "h" ? 3600 : w[i+1] == "min" ? 60 : w[i+1] == "s" ? 1 : 1e-3) }
        /^# memory / { memory = $3 * ($4 == "GB" ? 1000 : $4 == "MB" ? 1 : 1e-3) }
        END { run = user + kernel; held = resident * 1.024e-3
            printf "| `%s` | %.3g | %.3g | %.2f | %.4g | %.4g | %.2f |\n", name, time, run, time / run, memory, held, memory / held }' "$scratch/check"
done
