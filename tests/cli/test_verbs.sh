#!/usr/bin/env bash
# What every verb does when all is well.
# shellcheck source=tests/cli/check.sh
. "$(dirname "$0")/check.sh"

# A biaxial test that runs in a few seconds.
small=(--quick --set particles.count=100 --set 'stages.compress.strain=1 %' --set 'stages.compress.rate=5e-2 1/s'
    --set 'measure.windows=[]' --no-figures)

# --- help, all from one table
verbs=(list new check stability moduli "theory lattice" "theory ife" "theory bcc" "theory fpa" "theory osl" "theory wedge" "theory flamant" "theory layer" run sweep reproduce report get measure export plot help)
expect 0 'Usage: scree VERB' "$scree" --help
for verb in "${verbs[@]}"; do grep -qE "^  $verb " <<<"$output" || complain "--help does not name $verb"; done
expect 2 'Usage: scree VERB' "$scree"
expect 0 '^scree [0-9]+\.[0-9]+\.[0-9]+ \((gcc|clang) .*kernels for ' "$scree" --version
for verb in "${verbs[@]}"; do
    expect 0 "^Usage: scree $verb" "$scree" "$verb" --help
    same "$output" "$("$scree" help "$verb")" "scree help $verb against scree $verb --help"
    expect 0 "^Usage: scree $verb" "$scree" "$verb" -h
done
longest=$({ "$scree" --help; for verb in "${verbs[@]}"; do "$scree" "$verb" --help; done; } | awk '{ if (length > n) n = length } END { print n }')
[ "$longest" -le 80 ] || complain "the help has a line of $longest letters"
expect 0 '^\.TH SCREE 1' "$scree" help --man
for verb in "${verbs[@]}"; do grep -q "^.SS scree $verb" <<<"$output" || complain "the man page does not have $verb"; done
expect 0 'case|key|material' "$scree" help --case-reference

# --- the instruction set can be forced; results do not show it
best=$("$scree" --version | sed -nE 's/.*x86-64-(v[234]).*/\1/p')
expect 0 'SCREE_ISA' "$scree" --help
expect 0 'SCREE_ISA' "$scree" help --man
if [ -n "$best" ]; then
    expect 0 'x86-64-v2' env SCREE_ISA=v2 "$scree" --version
    expect 0 "x86-64-$best" env SCREE_ISA=auto "$scree" --version
    [ "$best" = v4 ] || expect 2 "SCREE_ISA: .*'v4': this processor does not have it; its best is $best" env SCREE_ISA=v4 "$scree" list
fi
expect 2 "SCREE_ISA: .*'v5': " env SCREE_ISA=v5 "$scree" list
expect 0 biaxial env SCREE_ISA= "$scree" list

# --- completion, in the shell it is for
"$scree" help --completion bash >completion.bash
complete_line() {
    PATH=$(dirname "$scree"):$PATH bash -c '. ./completion.bash; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _scree; echo "${COMPREPLY[*]}"' bash "$@"
}
same "$(complete_line scree ch)" check
same "$(complete_line scree run --no)" --no-figures
same "$(complete_line scree new biaxial-b)" biaxial-boundaries
same "$(complete_line scree help --com)" --completion
touch some.yaml other.txt
same "$(complete_line scree check s)" some.yaml
same "$(complete_line scree check ot)" ''
same "$(complete_line scree run biaxial --set materials.0.rest)" materials.0.restitution=
same "$(complete_line scree check biaxial --set stages.compress.rat)" stages.compress.rate=
same "$(complete_line scree check hopper --set walls.floor.poi)" walls.floor.point=
same "$(complete_line scree check biaxial --set particles.radius_)" 'particles.radius_min= particles.radius_max='

# --- list, new, check
expect 0 '^biaxial +[A-Z]' "$scree" list
expect 0 '^name: biaxial' "$scree" new biaxial
same "$output" "$(cat "${SCREE_SOURCE_DIR:?}/cases/biaxial.yaml")" "scree new against the file it was made from"
expect 0 '' "$scree" new biaxial -o my.yaml
expect 0 '^# phi +[0-9]' "$scree" check my.yaml
resolved=$output
expect 0 '^# time step +.*of the critical step' "$scree" check biaxial
printf '%s\n' "$resolved" >resolved.yaml
expect 0 '^# psi' "$scree" check resolved.yaml
same "$(grep -v '^#' <<<"$output")" "$(grep -v '^#' <<<"$resolved")" "a resolved case, resolved again"
expect 0 'friction: 0?\.3\b' "$scree" check my.yaml --set materials.0.friction=0.3
expect 0 '^# particles +600' "$scree" check my.yaml --quick
expect 0 '^# time needed +[0-9].*, on one thread$' "$scree" check my.yaml --quick
expect 0 '^# time needed .*, if no particle sleeps$' "$scree" check pile-point --quick --set 'stages.pour.sleep_window=5 ms'
for part in stepping output figures; do expect 0 "^#   $part +[0-9]" "$scree" check my.yaml --quick; done
expect 0 '^# memory +[0-9.]+ MB$' "$scree" check rotating-drum
expect 0 '^#   figures +0 s$' "$scree" check periodic-shear --set output.figures=no
expect 0 '^# inertial number +[0-9]' "$scree" check my.yaml --quick
expect 0 '^# warning +stage 2 \(compress\): inertial number 0\.0[0-9]+, above 0\.001: .*a rate of 0\.01' "$scree" check my.yaml --set 'stages.compress.rate=0.5 1/s'

# --- a folder of the name, such as that of its run, hides no built-in case
mkdir pour-discs
expect 0 '^# particles' "$scree" check pour-discs --quick
rmdir pour-discs

# --- run: a file of the name wins over the built-in case
expect 0 'results in out' "$scree" run biaxial -o out --threads 2 "${small[@]}"
for file in case.yaml summary.json series.csv run.h5 log.txt; do [ -s "out/$file" ] || complain "no out/$file"; done
same "$("$scree" get out case)" biaxial
sed 's/^name: .*/name: mine/' my.yaml >biaxial
expect 0 '^warning: stage 2 \(compress\): inertial number' "$scree" run biaxial -q --output=mine --threads=1 "${small[@]}"
same "$("$scree" get mine case)" mine
same "$("$scree" get mine state_checksum)" "$("$scree" get out state_checksum)" "checksum with one thread and with two"
if [ -n "$best" ]; then
    expect 0 '^warning: stage 2 \(compress\): inertial number' env SCREE_ISA=v2 "$scree" run my.yaml "${small[@]}" -o old --quiet
    same "$("$scree" get old state_checksum)" "$("$scree" get out state_checksum)" "checksum with x86-64-v2 and with $best"
    same "$("$scree" get old version | grep -o 'v[234]')" v2 "version in the summary"
fi
# What is meant for a closed stream does not end up in the file that got its number.
"$scree" run biaxial -omine -f -t1 "${small[@]}" 2>&- || complain "a run without standard error"
foreign=$(grep -vcE '^[0-9]{4}-[0-9-]+T[0-9:]+Z ' mine/log.txt)
same "$foreign" 0 "lines in log.txt that the log did not write"

# --- get
expect 0 '^[-0-9.e]+$' "$scree" get out phi
expect 0 '^psi [-0-9.e]+$' "$scree" get out phi psi
same "$(wc -l <<<"$output")" 2
expect 0 '^quasistatic no' "$scree" get out quasistatic inertial_number
expect 0 '^inertial_number 0\.00' "$scree" get out quasistatic inertial_number
expect 0 'warning stage 2 \(compress\): inertial number' cat out/log.txt
expect 0 '^state_checksum +[0-9a-f]{16}$' "$scree" get out
same "$(wc -l <<<"$output")" "$(python3 -c 'import json; print(len(json.load(open("out/summary.json"))))' 2>/dev/null || grep -c '^  "' out/summary.json)"

# --- springs that keep their displacement are given energy in a flow; the log says so, and the way out
flow=(--quick --no-figures --threads 1 --set particles.count=60 --set stages.prepare.width=12mm
    --set stages.prepare.depth=12mm --set stages.relax.duration=0.15s --set output.paraview=no)
expect 0 'contact.tangential_history=rescaled' "$scree" run hopper -o kept "${flow[@]}" \
    --set contact.tangential_history=displacement
expect 0 'results in rescaled' "$scree" run hopper -o rescaled "${flow[@]}" --set contact.tangential_history=rescaled
grep -q 'given to tangential springs' <<<"$output" && complain "rescaled springs are warned of: $output"
awk -v kept="$("$scree" get kept stiffness_share)" -v less="$("$scree" get rescaled stiffness_share)" \
    'BEGIN { exit !(kept > 0.01 && less < 0) }' || complain "stiffness_share of kept and rescaled springs"

# --- plot
expect 0 '\.svg$' "$scree" plot out
while read -r path; do [ -s "$path" ] || complain "plot names $path, which is not there"; done <<<"$output"
drawn=$(sed -nE 's/^out\/figures\/(.*)\.svg$/\1/p' <<<"$output")
expect 0 '^stress-ratio +\* [a-z]' "$scree" plot out --list
same "$(grep -E '^[^ ]+ +\* ' <<<"$output" | cut -d ' ' -f 1)" "$drawn" "the usual figures of plot --list against those that plot draws"
[ "$(wc -l <<<"$drawn")" -le 10 ] || complain "more than ten figures: $drawn"
listed=$(cut -d ' ' -f 1 <<<"$output")
expect 0 '\.svg$' "$scree" plot out --all
same "$(sed -nE 's/^out\/figures\/(.*)\.svg$/\1/p' <<<"$output")" "$listed" "the figures of plot --list against those of plot --all"
same "$(complete_line scree plot out --only stress-)" stress-ratio
rm -r out/figures
expect 0 'figures' "$scree" plot out --only packing-end,stress-ratio
same "$output" $'out/figures/stress-ratio.svg\nout/figures/packing-end.svg'
same "$(ls out/figures | tr '\n' ' ')" 'packing-end.png packing-end.svg stress-ratio.csv stress-ratio.gp stress-ratio.png stress-ratio.svg '
# The long side of a PNG is in its bytes 17 to 24.
sides() { od -An -tu1 -j16 -N8 "$1" | awk '{ print $1 * 16777216 + $2 * 65536 + $3 * 256 + $4, $5 * 16777216 + $6 * 65536 + $7 * 256 + $8 }'; }
expect 0 'figures' env SCREE_PIXELS=640 "$scree" plot out --only packing-end,stress-ratio
same "$(sides out/figures/stress-ratio.png)" "640 400" 'sides of a chart'
same "$(sides out/figures/packing-end.png | tr ' ' '\n' | sort -n | tail -n 1)" 640 'long side of a scene'
for wrong in 199 20001 1e3 much; do
    expect 2 "SCREE_PIXELS: .*'$wrong': expected a whole number of pixels, 200 to 20000" env SCREE_PIXELS=$wrong "$scree" list
done
expect 2 "^scree plot: stress-ration: .*\(accepted: stress-ratio\)$" "$scree" plot out --only packing-end,stress-ration
expect 2 '^scree plot: --only: does not go with --list' "$scree" plot out --only stress --list
expect 2 'shear-ratio: .*no figure of this name' "$scree" plot out --only shear-ratio # of periodic cells

expect 0 'solid-fraction-profile.svg$' "$scree" plot out --only solid-fraction-profile,contact-rose
awk -F, -v whole="$("$scree" get out solid_fraction)" 'NR > 1 { sum += $1; rows++ } END { exit !(rows > 4 && sum / rows > 0.92 * whole && sum / rows < 1.08 * whole) }' \
    out/figures/solid-fraction-profile.csv || complain "mean of the profile of the solid fraction against that of the sample"

# --- plot: without the font of figures, in each way to a figure
printf '<?xml version="1.0"?>\n<fontconfig><cachedir>%s/fonts</cachedir></fontconfig>\n' "$PWD" >no-fonts.xml
no_fonts='warning: figures have no text, for no font is installed \(Debian package fonts-dejavu-core\)'
for way in "--only stress-ratio" "--y height" "--scene displacement" "--movie displacement"; do
    # shellcheck disable=SC2086 # words
    expect 0 "$no_fonts" env FONTCONFIG_FILE="$PWD/no-fonts.xml" "$scree" plot out $way
done
expect 0 "$no_fonts" env FONTCONFIG_FILE="$PWD/no-fonts.xml" "$scree" run out/case.yaml -o no-fonts

# --- plot: charts and scenes of one's own
expect 0 '^out/figures/stress_axial_plates-stress_lateral_applied-over-axial_strain-compress.svg$' \
    "$scree" plot out --x axial_strain --y stress_axial_plates,stress_lateral_applied --stage compress
data=out/figures/stress_axial_plates-stress_lateral_applied-over-axial_strain-compress.csv
same "$(head -1 "$data")" '"axial strain (%)","stress axial plates","stress lateral applied"'
rows=$(awk -F, -v stage="$(sed -n 1p out/series.csv | tr , '\n' | grep -n '^stage ' | cut -d: -f1)" '$stage == 2' out/series.csv | wc -l)
same "$(($(wc -l <"$data") - 1))" "$rows" "rows of the chart against those of the stage"
expect 0 'height-over-time.svg$' "$scree" plot out --y height
same "$(($(wc -l <out/figures/height-over-time.csv)))" "$(($(wc -l <out/series.csv)))" "rows of a chart of all stages"
expect 0 'over-time.svg$' "$scree" plot out --y height,height
same "$(grep -o 'linewidth [0-9]* ' out/figures/height-height-over-time.gp | sort | uniq -c | tr -s ' \n' ' ')" ' 1 linewidth 2 1 linewidth 5 ' "a line that hides another"
expect 2 "^scree plot: --y: .*no column .hight. \(accepted: height, and others" "$scree" plot out --y hight
expect 2 "^scree plot: --x: .*no column .axial_strai. \(accepted: axial_strain, " "$scree" plot out --y height --x axial_strai
expect 2 "^scree plot: --y: .*another: 'coordination' \(accepted: m\)$" "$scree" plot out --y height,coordination
expect 2 "^scree plot: --stage: .*'shear' \(accepted: a number, .*, compress\)$" "$scree" plot out --y height --stage shear
expect 2 '^scree plot: --x: needs --y' "$scree" plot out --x time
expect 2 '^scree plot: --only: does not go with --y' "$scree" plot out --y height --only stress
expect 0 '^out/figures/scene-speed-000000.svg$' "$scree" plot out --scene speed --at start
expect 0 '^out/figures/scene-displacement_y-[0-9]*.svg$' "$scree" plot out --scene displacement_y
[ -s "${output%.svg}.png" ] || complain "the scene has no PNG"
last=$output
expect 0 'svg$' "$scree" plot out --scene displacement_y --at compress
same "$output" "$last" "the end of the last stage against the end"
expect 0 'svg$' "$scree" plot out --scene displacement_y --at '1 %'
same "$output" "$last" "the strain at the end against the end"
expect 0 'scene-forces' "$scree" plot out --scene forces --at confine
expect 2 "^scree plot: --scene: .*no field 'sped' \(accepted: speed\)$" "$scree" plot out --scene sped
expect 2 "^scree plot: --scene: .*no field 'velocity_z'" "$scree" plot out --scene velocity_z # of spheres
expect 2 "^scree plot: --at: the run does not reach '9 %' \\(accepted: 0 % to [0-9.]+ %\\)\$" "$scree" plot out --scene speed --at '9 %'
expect 2 "^scree plot: --at: the run does not reach '3600 s' \\(accepted: 0 s to " "$scree" plot out --scene speed --at '1 h'
expect 2 "^scree plot: --at: .*no snapshot of 'peek'" "$scree" plot out --scene speed --at peek
expect 2 '^scree plot: --section: discs cannot be cut' "$scree" plot out --scene speed --section
expect 2 '^scree plot: --at: needs --scene' "$scree" plot out --at end

# --- movies: as many frames as snapshots, all of one size; without ffmpeg the frames alone
mkdir -p empty # no program is there
expect 0 '^scree plot: warning: ffmpeg is not installed, so there are the frames alone: ' env PATH=empty "$scree" plot out --movie displacement
frames=(out/figures/movie-displacement/frame-*.png)
[ "${#frames[@]}" -gt 2 ] || complain "too few frames: ${frames[*]}"
for frame in "${frames[@]}"; do od -An -tx1 -j16 -N8 "$frame"; done | sort -u >sizes.txt
same "$(wc -l <sizes.txt)" 1 "sizes of the frames of a movie"
same "$(for frame in "${frames[@]}"; do cksum <"$frame"; done | sort -u | wc -l)" "${#frames[@]}" "frames that differ"
touch "out/figures/movie-displacement/frame-$(printf %06d ${#frames[@]}).png" # of a longer movie
expect 0 'movie-displacement' "$scree" plot out --movie displacement
same "$(ls out/figures/movie-displacement | wc -l)" "${#frames[@]}" "frames of the same movie again"
if command -v ffmpeg >/dev/null; then [ -s out/figures/movie-displacement.mp4 ] || complain "no movie"; fi
expect 2 "^scree plot: --movie: .*no field 'sped' \(accepted: speed\)$" "$scree" plot out --movie sped
expect 2 '^scree plot: --at: does not go with --movie' "$scree" plot out --movie speed --at end

# --- a run that is interrupted or killed and continued ends where an uninterrupted one does
long=("${small[@]}" --threads 1 --set 'stages.compress.strain=2 %')
"$scree" run biaxial -o whole -q "${long[@]}" || complain "the uninterrupted run"

# stop_and_continue SIGNAL STATUS PATTERN FILE: sends the signal when the pattern shows in the file.
stop_and_continue() {
    local pid status
    rm -rf cut
    "$scree" run biaxial -o cut "${long[@]}" 2>cut.txt &
    pid=$!
    wait_for "$3" "$4"
    kill "-$1" $pid
    wait $pid 2>/dev/null
    status=$?
    same "$status" "$2" "exit status after SIG$1"
    expect 0 'results in cut' "$scree" run --restart cut --no-figures --threads 2
    same "$("$scree" get cut state_checksum)" "$("$scree" get whole state_checksum)" "restart after SIG$1"
    cmp -s cut/series.csv whole/series.csv || complain "series.csv differs after SIG$1 and a restart"
}
stop_and_continue INT 130 '^[0-9]*,0\.2' cut/series.csv
grep -q 'scree run --restart cut' cut.txt || complain "the interrupted run does not say how to continue: $(cat cut.txt)"
stop_and_continue TERM 130 'confine ended' cut/log.txt
stop_and_continue KILL 137 'confine ended' cut/log.txt
# A run that has ended stays as it is.
expect 0 'results in whole' "$scree" run --restart whole --no-figures --threads 1
same "$("$scree" get cut state_checksum)" "$("$scree" get whole state_checksum)" "restart of a finished run"
finish ""
