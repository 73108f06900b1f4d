#!/usr/bin/env bash
# Averages of small piles: tables, values and figures; the same dip as the run's own; an ensemble; strains between two
# snapshots; what cannot be measured is said with its option and the way out.
# shellcheck source=tests/cli/check.sh
. "$(dirname "$0")/check.sh"

small=(--set particles.count=60 --set sources.spout.interval="20 ms" --set output.paraview=no --set output.figures=no)
for seed in 1 2; do
    expect 0 '|not at rest' "$scree" run pour-discs "${small[@]}" --set seed=$seed --threads 1 --quiet -o pile$seed
done

# One pile: everything there is.
expect 0 'kernel_residual' "$scree" measure pile1 --fields density,coordination,stress,fabric,inertia,velocity \
    --grid 12x8 --kernel 3 --cuts 2 -o one
for file in values.csv cuts.csv map.csv kernel.csv forces.csv friction.csv rose.csv dips.csv summary.json \
    cuts-pressure-scaled.png map-stress-vertical.png kernel-stress-shear.png kernel-residual.png force-distribution.png rose.png chains.png; do
    checks=$((checks + 1))
    [ -s "one/$file" ] || complain "there is no one/$file"
done
same "$(wc -l <one/cuts.csv)" 83 "rows of two cuts of 41 places"
same "$(wc -l <one/map.csv)" 97 "rows of the map"
# The same numbers, added up in another order of the grains.
for pair in "dip dip" "element_grains dip_element"; do
    checks=$((checks + 1))
    awk -v a="$("$scree" get one "${pair% *}")" -v b="$("$scree" get pile1 "${pair#* }")" \
        'BEGIN { exit !(a > 0 && (a / b - 1) ^ 2 < 1e-18) }' || complain "the run's own $pair"
done
same "$("$scree" get one grains)" 60 "grains"
same "$("$scree" get one warnings)" "elements hold 6 grains, fewer than 30" "warnings"
same "$("$scree" get pile1 warnings)" "elements of the dip hold 6 grains, fewer than 30" "warnings of the run's own dip"
expect 0 'warning elements of the dip hold 6 grains, fewer than 30: it is noise; .*scree measure' cat pile1/log.txt
checks=$((checks + 1))
awk -v plate="$("$scree" get one outside_force_ratio)" -v row="$("$scree" get one bottom_row_ratio)" \
    -v residual="$("$scree" get one kernel_residual)" -v run="$("$scree" get pile1 weight_ratio)" \
    'BEGIN { exit !(plate > 0.999 && plate < 1.001 && row > 0.98 && row < 1.02 && residual < 1e-9 && (plate - run) ^ 2 < 1e-16) }' ||
    complain "plate, lowest row or residual"
# The residual of the balance of forces as a map: its largest value is that of the summary.
checks=$((checks + 1))
awk -F, -v whole="$("$scree" get one kernel_residual)" 'NR == 1 { for (k = 1; k <= NF; k++) if ($k == "residual [1]") r = k; next }
    { if ($r > most) most = $r } END { exit !(r && most > 0 && (most / whole - 1) ^ 2 < 1e-12) }' one/kernel.csv || complain "residuals of one/kernel.csv"
# A map of more places than lines can be told apart still has lines, of which one stands for several places.
expect 0 'holds 2 grains' "$scree" measure pile1 --element 2 --grid 100x50 --cuts 15 -o fine
checks=$((checks + 1))
lines=$(grep 'stroke-width:0.9' fine/map-stress-vertical.svg | grep -o 'M ' | wc -l)
[ "$lines" -gt 300 ] && [ "$lines" -le 1500 ] || complain "$lines lines on a map of 100 x 50"
# Of many cuts seven are drawn, from the lowest to the highest.
same "$(head -1 fine/cuts-stress-vertical.csv | grep -o 'height [0-9.]*' | tr '\n' ' ')" \
    "height 0 height 0.13 height 0.33 height 0.47 height 0.6 height 0.8 height 0.93 " "cuts of 15 that are drawn"
grep -q '(7 of 15 cuts)' fine/cuts-stress-vertical.gp || complain "the title does not say that cuts are left out"
# Elements of 6 grains are few, and said to be.
expect 0 'warning: pile1: an element holds 6 grains, fewer than 30' "$scree" measure pile1 --no-figures -o few

# An ensemble: bands, and an interval of the dip.
expect 0 'height +dip +interval' "$scree" measure pile1 pile2 --cuts 0,0.4 --no-figures -o both
head -1 both/cuts.csv | grep -q 'stress_yy_low \[Pa\]' || complain "no bands in both/cuts.csv"
same "$("$scree" get both runs)" 2 runs
# Cuts have an order of their own: the dip is that of the lowest one, wherever it is named.
expect 0 'height +dip +interval' "$scree" measure pile1 pile2 --cuts 0.4,0 --no-figures -o back
checks=$((checks + 1))
cmp -s both/cuts.csv back/cuts.csv && cmp -s both/dips.csv back/dips.csv || complain "the order in which cuts are named matters"
grep -q 'warning: bands and intervals of 2 runs are too narrow: give 5 or more' <<<"$output" || complain "nothing is said of bands of two runs"
same "$("$scree" get both warnings)" "elements hold 6 grains, fewer than 30; bands of 2 runs are too narrow" "warnings of two runs"
expect 2 "no result 'dip_low' in 'pile1': it is one of several runs, of which .scree measure RUN RUN RUN -o DIR. tells it; then .scree get DIR dip_low" \
    "$scree" get pile1 dip_low
expect 2 "no result 'dip_height' in 'pile1': it is one of several runs" "$scree" get pile1 dip dip_height
expect 2 "no result 'dips' in 'pile1' .accepted: dip" "$scree" get pile1 dips
checks=$((checks + 1))
awk -v low="$("$scree" get both dip_low)" -v dip="$("$scree" get both dip)" -v high="$("$scree" get both dip_high)" -v p="$("$scree" get both dip_p)" \
    'BEGIN { exit !(low <= dip && dip <= high && p >= 0.25 && p <= 1) }' || complain "interval or p of the dip"
same "$("$scree" get one dip_low)" nan "one pile has no interval"
# Where the pressure is least and largest, from the apex.
number() { "$scree" get "$1" "$2" 2>&1; }
checks=$((checks + 1))
awk -v l="$(number both pressure_minimum_place_low)" -v h="$(number both pressure_minimum_place_high)" \
    -v d="$(number both pressure_minimum_depth)" -v s="$(number both pressure_minimum_share)" \
    -v m="$(number both pressure_maximum_place)" \
    'BEGIN { exit !((s == 0 || l <= h) && d >= 0 && d < 1 && s ~ /^[01]/ && s <= 1 && m ~ /^-?0/) }' || complain "the least pressure"
same "$(number one pressure_maximum_place | grep -c '^-*[0-9]')$(number one pressure_minimum_share | grep -c 'no result')" 11 "of one pile"

# Elements of growing size, their figures, and the scatter of several runs; a part of the grains in an element; threads.
expect 0 'rve_fabric_grains' "$scree" measure pile1 pile2 pile1 --sizes 2,4,8,300 --from "#15" --element "10 %" --mirror -o sizes
for file in sizes.csv scatter.csv sizes-stress.png sizes-strain.png sizes-fabric.png sizes-scatter.png; do
    checks=$((checks + 1))
    [ -s "sizes/$file" ] || complain "there is no sizes/$file"
done
same "$(tail -1 sizes/sizes.csv | cut -d, -f1,7)" "300,nan" "a size that does not fit"
same "$("$scree" get sizes element_grains)" 6 "a tenth of the grains"
expect 0 'rve_fabric_grains' "$scree" measure pile1 pile2 pile1 --sizes 2,4,8,300 --from "#15" --element "10 %" --mirror --threads 3 --no-figures -o threads
for file in cuts.csv sizes.csv scatter.csv values.csv; do expect 0 '' cmp sizes/$file threads/$file; done
checks=$((checks + 1))
awk -F, 'NR == 1 { for (k = 1; k <= NF; k++) { if ($k == "place [1]") p = k; if ($k == "stress_yy [Pa]") s = k; if ($k == "stress_xy [Pa]") t = k } next }
    { yy[NR] = $s; xy[NR] = $t; n = NR } END { for (k = 2; k <= 42; k++) if (yy[k] != yy[44 - k] || xy[k] != -xy[44 - k]) exit 1 }' sizes/cuts.csv ||
    complain "cuts of a run and its mirror image are not symmetric"

# Strains between two snapshots of a relaxing pile; a mean over snapshots.
expect 0 'grains' "$scree" measure pile1 --from "#15" --no-figures -o moved
head -1 moved/cuts.csv | grep -q 'cambou_xx.*liao_xy.*bagi_yy' || complain "no strains in moved/cuts.csv"
expect 0 'mean over 3 snapshots' "$scree" measure pile1 --at mean:3 --no-figures -o mean

# What cannot be.
expect 2 '--element: .* larger than the sample.*take a smaller one' "$scree" measure pile1 --element 5000
expect 2 '--element: an element of 10 m .* larger than the sample.*take a smaller one' "$scree" measure pile1 --element '10 m'
# A length is a length, and not as many grains.
expect 0 '^element_side +0\.005 ' "$scree" measure pile1 --element '5 mm' --no-figures -o few
expect 2 '--element: an element of 1 m .*larger than the sample' "$scree" measure pile1 --element '1 m'
expect 2 "--fields: there is no field 'stres'.*density" "$scree" measure pile1 --fields stres
expect 2 '--cuts: .*relative heights' "$scree" measure pile1 --cuts 0.5,1.5
expect 2 '--grid: .*100x50' "$scree" measure pile1 --grid 10
expect 2 '--kernel: .*mean diameters' "$scree" measure pile1 --kernel -1
expect 2 '--axis: ' "$scree" measure pile1 --axis nowhere
expect 2 '--points: .*odd' "$scree" measure pile1 --points 40
expect 2 '--at: .*no snapshot of .nostage.*end.*pour' "$scree" measure pile1 --at nostage
expect 2 '--at: the run does not reach .1e.06 s.' "$scree" measure pile1 --at '1e6 s'
time=$("$scree" measure pile1 --at '#8' --no-figures 2>/dev/null | awk '$1 == "time" { print $2 }')
expect 0 "time +$time" "$scree" measure pile1 --at "$time s" --no-figures
expect 2 '--from: ' "$scree" measure pile1 --at mean:2 --from start
expect 2 '--at: there is no grain to average over.*another snapshot' "$scree" measure pile1 --at start
expect 2 "--from: 'pour' is the snapshot of --at: nothing has moved.*an earlier one" "$scree" measure pile1 --from pour --at pour
expect 2 '--grid: a sample in the plane has no third direction .accepted: points along x and y' "$scree" measure pile1 --grid 4x5x6 --no-figures
expect 0 'warning: ./pile1/: this run is named twice' "$scree" measure pile1 pile2 ./pile1/ --no-figures -o twice
expect 2 'no grain is in both' "$scree" measure pile1 --from start
expect 4 'cannot open|no such' "$scree" measure nothing
expect 2 "--sizes: '20,10' says no sizes.*that grow" "$scree" measure pile1 --sizes 20,10
expect 2 "--element: '150 %' is no part.*10 %" "$scree" measure pile1 --element "150 %"
expect 2 "only the wedges have two slopes" "$scree" measure pile1 pile2 pile1 --fit osl --two-slopes --no-figures -o none
expect 0 'warning: pile1: not at rest: .* of the mean contact force' "$scree" measure pile1 --at "#8" --no-figures -o moving
"$scree" get moving warnings | grep -q 'not at rest, unbalanced ratio' || complain "a run that is not at rest is not said to be"
# A gas has no contacts.
expect 0 '' "$scree" run rotating-drum --quick --set particles.count=40 --set stages.settle.duration="1 ms" --set stages.turn.duration="1 ms" \
    --set output.paraview=no --set output.figures=no --threads 1 --quiet -o gas
expect 2 '--at: there are no contacts.*another snapshot' "$scree" measure gas --at start
# Densities and velocities need none.
expect 0 'warning: gas: there are no contacts' "$scree" measure gas --at start --fields density,velocity --grid 6x4 -o apart
same "$("$scree" get apart warnings)" "elements hold 4 grains, fewer than 30; no contacts" "warnings of a gas"
checks=$((checks + 1))
[ -s apart/map-density.png ] && ! grep -q nan apart/map.csv || complain "no densities of a gas: $(head -3 apart/map.csv)"
# One run has no interval, and says so.
expect 0 'one run has no interval and no p: give the folders of several piles' "$scree" measure pile1 --no-figures -o few
[ -e nothing ] && complain "a folder was made of a run that is not there"
# A sweep that asks for averages over its members makes the same, and its report takes and shows them.
cat >averaged.yaml <<'END'
name: averaged
case: pour-discs
realisations: 2
set: {particles.count: 60, sources.spout.interval: 20 ms, output.paraview: no, output.figures: no}
ensemble: {cuts: "0,0.4", fit: osl}
quick_realisations: 6
END
sed 's/0,0.4/0,4/' averaged.yaml >bad.yaml
expect 2 "bad.yaml:5:19: ensemble.cuts: .*says no heights of cuts" "$scree" sweep bad.yaml -n
expect 0 'ensemble: ensemble\.fit: .*three piles or more' "$scree" sweep averaged.yaml -o averaged --jobs 2
same "$(grep -c 'seed=1: an element holds 6 grains' <<<"$output")" 1 "a warning beside theories that cannot be fitted: $output"
same "$(grep -c "realisations" <<<"$output")" 0 "two members have intervals: $output"
expect 0 'ensemble: averages over one member have no intervals: give more .realisations.' "$scree" sweep averaged.yaml -o single --realisations 1
expect 0 'ensemble: averaged/members/000-seed=1: an element holds 6 grains' "$scree" sweep averaged.yaml -o averaged --jobs 2
expect 0 '' cmp averaged/ensemble/all/cuts.csv both/cuts.csv
expect 0 '' cmp averaged/ensemble/all/dips.csv both/dips.csv
cat >statements.yaml <<'END'
source: "Mine (Q)"
cases:
  - case: averaged
    meaning: What it is.
    statements:
      - {id: plate, statement: s, source: Q, given: 1, value: averaged.ensemble_outside_force_ratio, criterion: within 1 %, kind: check}
END
expect 0 '' "$scree" report averaged -s statements.yaml -o page.md
grep -qE '^\| plate .*\| 1 \[1, 1\] \| 2 of 2 \| \*\*undecided\*\* .*fewer than 6 samples' page.md || complain "report of an ensemble: $(grep '^| plate' page.md)"
# Six decide, two do not, whatever their interval: the quick form counts.
mkdir forms
cp -r averaged forms/full
expect 0 '005-seed=6: done' "$scree" sweep averaged.yaml --quick -o forms/quick --jobs 2
expect 0 '' "$scree" report forms -s statements.yaml -o forms.md
grep -qE '^\| plate .*\| 2 of 2 \| \(undecided\) \| full' forms.md || complain "two of the full form: $(grep '^| plate' forms.md)"
grep -qE '^\| plate .*\| 6 of 6 \| \*\*agrees\*\* \| quick' forms.md || complain "six of the quick form: $(grep '^| plate' forms.md)"
grep -qF '(page-figures/averaged-all-full.png)' page.md && [ -s page-figures/averaged-all-full.png ] || complain "no figure in the report"

# Theories are fitted to three piles or more: BCC is the smooth wedge, and OSL the wedge with a free core.
expect 2 "three piles or more.*give the folders of several piles" "$scree" measure pile1 --fit bcc --no-figures -o none
expect 2 "three piles or more" "$scree" measure pile1 pile2 --fit bcc --no-figures -o none
expect 2 "no theory 'bbc'" "$scree" measure pile1 pile2 --fit osl,bbc --no-figures -o none
expect 0 '|not at rest' "$scree" run pour-discs "${small[@]}" --set seed=3 --threads 1 --quiet -o pile3
expect 0 'fit_osl_eta' "$scree" measure pile1 pile2 pile3 --fit bcc,osl,wedge -o fit
grep -q -- '-nan' <<<"$output" && complain "a number that is none has a sign"
for file in fits.csv fit-points.csv fits-vertical.png mohr-coulomb.png; do
    checks=$((checks + 1))
    [ -s "fit/$file" ] || complain "there is no fit/$file"
done
checks=$((checks + 1))
awk -v a="$("$scree" get fit fit_bcc_chi_square)" -v b="$("$scree" get fit fit_wedge_smooth_chi_square)" \
    -v c="$("$scree" get fit fit_osl_chi_square)" -v d="$("$scree" get fit fit_wedge_core_chi_square)" \
    'BEGIN { exit !(a > 0 && (a / b - 1) ^ 2 < 1e-12 && (c / d - 1) ^ 2 < 1e-8 && c < a) }' || complain "theories that are one and the same fit differently"

finish
