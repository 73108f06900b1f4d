#!/usr/bin/env bash
# A pile is poured: the same bits with one thread and two, and after a kill in mid-pour; its results, table and figures;
# what is wrong with sources is said with its place.
# shellcheck source=tests/cli/check.sh
. "$(dirname "$0")/check.sh"

small=(--set particles.count=40 --set sources.spout.interval="20 ms" --set output.paraview=no --set output.checkpoint_steps=5000)
expect 0 'results in one' "$scree" run pour-discs "${small[@]}" --threads 1 -o one
expect 0 '' "$scree" run pour-discs "${small[@]}" --threads 2 --quiet --no-figures -o two
wanted=$("$scree" get one state_checksum)
same "$("$scree" get two state_checksum)" "$wanted" "two threads"

# Killed as soon as there is a checkpoint in mid-pour.
kill_and_continue() {
    local folder=$1 run
    shift
    "$scree" run "$@" --quiet --no-figures -o "$folder" >/dev/null 2>&1 &
    run=$!
    for ((i = 0; i < 1200; i++)); do
        ls "$folder"/parts/checkpoint-00000[3-9].h5 >/dev/null 2>&1 && break
        sleep 0.02
    done
    kill -KILL "$run" 2>/dev/null
    wait "$run" 2>/dev/null
    expect 0 'checkpoint' "$scree" check "$folder"
    expect 0 '' "$scree" run --restart "$folder" --quiet
}
kill_and_continue killed pour-discs "${small[@]}"
same "$("$scree" get killed state_checksum)" "$wanted" "killed in mid-pour"

# The same of polygons, whose outlines and contacts of areas come back.
polygons=(pile-point --quick --set particles.count=12 --set sources.spout.interval="20 ms" --set output.paraview=no
    --set output.figures=no --set output.checkpoint_steps=5000)
expect 0 '' "$scree" run "${polygons[@]}" --quiet -o angular
kill_and_continue angular-killed "${polygons[@]}"
same "$("$scree" get angular-killed state_checksum)" "$("$scree" get angular state_checksum)" "polygons killed in mid-pour"

same "$("$scree" get one grains)" 40 "grains of the pile"
checks=$((checks + 1))
awk -v ratio="$("$scree" get one weight_ratio)" -v left="$("$scree" get one angle_of_repose_left)" \
    -v right="$("$scree" get one angle_of_repose_right)" -v mean="$("$scree" get one angle_of_repose)" \
    'BEGIN { exit !(ratio > 0.999 && ratio < 1.001 && mean > 5 && mean < 60 && (mean - (left + right) / 2) ^ 2 < 1e-12) }' ||
    complain "weight ratio or angles"
for file in outline.csv figures/pile.png figures/pile-outline.png figures/pile-growth.png figures/forces-end.png; do
    checks=$((checks + 1))
    [ -s "one/$file" ] || complain "there is no $file"
done
head -1 one/outline.csv | grep -q '^x \[m\],height \[m\],heap \[1\]$' || complain "head of outline.csv"

# Sources that are wrong: the place in the file, the key, what to do.
"$scree" new pour-discs >good.yaml
line=$(grep -n 'source: point' good.yaml | cut -d: -f1)
sed 's/^stages:/  - source: point\n    name: again\n    place: [1 mm, 15 cm]\n    interval: 40 ms\n\nstages:/' good.yaml >bad.yaml
expect 2 "^bad\.yaml:[0-9]+:[0-9]+: sources\.1\.source: .*in the same place as sources\.0.*give it another place" "$scree" check bad.yaml
sed 's/place: \[0, 15 cm\]/place: [0, 1 mm]/' good.yaml >bad.yaml
expect 2 "^bad\.yaml:$line:.*sources\.0.*: source 'spout' is in wall 'plate'.*move the source or the wall" "$scree" run bad.yaml -o wrong
sed 's/place: \[0, 15 cm\]/place: [0, 12 mm]/; s/unbalanced_limit: 1e-4/patience: 50 ms/' good.yaml >bad.yaml
expect 3 "the pile has reached the source, or a funnel has clogged; raise the source" "$scree" run bad.yaml -o blocked
expect 0 'stopped' "$scree" get blocked status

finish
