#!/usr/bin/env bash
# The commands of the tutorials, all of them, in their small form: the comment "small: ARGUMENTS" above a block adds
# arguments to its commands that run something (run, bisect, sweep). What pages name has to be there afterwards.
# shellcheck source=tests/cli/check.sh
. "$(dirname "$0")/check.sh"

pages=$SCREE_SOURCE_DIR/docs/tutorials
cp "$pages"/*.yaml "$pages"/*.csv .
PATH=$(dirname "$scree"):$PATH
export PATH

# commands PAGE: its blocks of shell commands, the small form applied.
commands() {
    awk '/^<!-- small:/ { small = $0; sub(/^<!-- small: */, "", small); sub(/ *-->$/, "", small); next }
        /^```sh$/ { block = 1; next } /^```/ { block = 0 }
        block { print $0 ($2 ~ /^(run|bisect|sweep)$/ ? " " small : "") }' "$1"
}

for page in "$pages"/*.md; do
    name=$(basename "$page" .md)
    [ "$name" = README ] && continue
    grep -q "($name.md)" "$pages/README.md" || complain "the index does not have $name"
    commands "$page" >"$name.sh"
    [ "$(grep -c '^scree' "$name.sh")" -ge 1 ] || complain "$name has no commands"
    awk '/^```sh$/ { n = 0; block = 1; next } /^```/ { block = 0 } block && /^scree/ && ++n > 3 { exit 1 }' "$page" ||
        complain "$name has more than three commands a task"
    bash -eu "$name.sh" >"$name.txt" 2>&1 || complain "$name: $(tail -n 5 "$name.txt")"
done
for file in $(grep -L "^reproduction:" ./*.yaml); do
    [ "$(grep -c . "$pages/$file")" -le 10 ] || complain "$file has more than ten lines of case"
done

for file in sand/figures/stress-ratio.png sand/figures/sizes.png own/figures/scene-coordination-000000.png hopper/figures/outflow.png \
    hopper/figures/scene-speed-*.png drum/figures/surface-angle.png drum/figures/scene-velocity_x-section-*.png \
    mu-of-i/table.csv mu-of-i/figures/mu-over-inertial_number.png friction/figures/stress_ratio-over-axial_strain.png \
    drained/figures/path-p-q.png cyclic/figures/path-p-q.png run/figures/kinetic-elastic_normal-over-axial_strain-compress.png \
    with-contacts/cuts.csv by-overlaps/values.csv repose/bisection.csv; do
    [ -s "$file" ] || complain "no $file"
done
[ -s run/figures/movie-speed.mp4 ] || [ -s run/figures/movie-speed/frame-000000.png ] || complain "no movie"
awk -v r="$("$scree" get sand peak_stress_ratio)" 'BEGIN { exit !(r > 1.2 && r < 6) }' || complain "peak of sand"
awk -v s="$("$scree" get find solid_fraction)" 'BEGIN { exit !(s > 0.81 && s < 0.84) }' || complain "solid fraction of find"
awk -v e="$("$scree" get find void_ratio)" 'BEGIN { exit !(e > 0.2058 && e < 0.2142) }' || complain "void ratio of find"
same "$("$scree" get own particles)" "$(($(wc -l <packing.csv) - 1))" "grains of the table"
awk -v r="$("$scree" get own peak_stress_ratio)" 'BEGIN { exit !(r > 1.2 && r < 3) }' || complain "peak of own grains"
awk -v r="$("$scree" get hopper beverloo_ratio)" 'BEGIN { exit !(r > 0.7 && r < 1.7) }' || complain "outflow over Beverloo"
# the slopes beside the outflow are the rate and Beverloo's
awk -F, -v r="$("$scree" get hopper beverloo_ratio)" 'NR == 2 { for (k = 3; k <= 6; k++) from[k] = $k }
    NR == 3 { d = ($4 - from[4]) / ($3 - from[3]) / (($6 - from[6]) / ($5 - from[5])) / r - 1 } END { exit !(d * d < 1e-10) }' \
    hopper/figures/outflow.csv || complain "Beverloo beside the outflow: $(head -n 3 hopper/figures/outflow.csv)"
# a shear test shows mu and its steady mean, and no ratio of axial to lateral stress
# cycles at constant volume have no peak, no shear, and no volumetric strain
same "$("$scree" get cyclic peak_stress_ratio)" nan "peak of cycles"
for name in volumetric-strain shear-ratio fluctuations-00-00 fluctuations-00-00.1; do
    [ -e "cyclic/figures/$name.svg" ] && complain "cycles at constant volume have a figure $name"
done
[ -e shear/figures/stress-ratio.svg ] && complain "a shear test has a chart of the stress ratio"
awk -F, -v m="$("$scree" get shear mu)" -v e="$("$scree" get shear mu_error)" -v f="$("$scree" get shear mu_from)" \
    'NR == 2 { a = $3 / 100 - f; b = $4 - m; c = e + 0 > 0 ? $6 - m - e : NF - 4 } END { exit !(NR > 2 && a * a + b * b + c * c < 1e-14) }' \
    shear/figures/shear-ratio.csv || complain "mean of mu: $(head -n 2 shear/figures/shear-ratio.csv)"
awk -v a="$("$scree" get drum surface_angle)" 'BEGIN { exit !(a > 15 && a < 40) }' || complain "angle of the drum"
same "$(grep -cE '^\| mu-at-.*(agrees|differs|undecided)' mu.md)" 5 "verdicts on mu(I)"
# pandas and numpy are not among the packages that Scree needs
awk '/^```python$/ { on = 1; next } /^```/ { on = 0 } on' "$pages/figures.md" >figures.py
if [ -e "$(dirname "$scree")/libscree.so" ] && python3 -c 'import numpy, pandas' 2>/dev/null; then
    expect 0 stress_ratio env PYTHONPATH="$(dirname "$scree")/python" python3 figures.py
fi
# the density of the tests is that of the search
for name in drained undrained cyclic; do
    awk -v a="$("$scree" get find solid_fraction)" -v b="$("$scree" get $name solid_fraction_at_start)" \
        'BEGIN { d = a - b; exit !(d * d < 1e-8) }' || complain "$name begins at another density"
done
awk -F, 'NR == 1 { for (k = 1; k <= NF; k++) if ($k == "mu") m = k; next } !($m > 0.1 && $m < 1) { wrong = 1 } END { exit wrong || NR != 6 }' \
    mu-of-i/table.csv || complain "mu of the sweep: $(cat mu-of-i/table.csv)"
finish
