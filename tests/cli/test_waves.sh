#!/usr/bin/env bash
# Waves: the shape that a selection is brought into, receivers, speeds, dispersion relations of lattices, restart in mid-wave, what is refused.
# shellcheck source=tests/cli/check.sh
. "$(dirname "$0")/check.sh"

# column FILE NAME ROW: value of a column in row ROW (1: the first), END: the last
column() {
    awk -F, -v name="$2" -v row="$3" 'NR == 1 { for (i = 1; i <= NF; i++) { split($i, p, " "); if (p[1] == name) c = i } next } { v = $c } NR == row + 1 { print v; found = 1; exit } END { if (!found) print v }' "$1"
}
# near NAME FOUND EXPECTED TOLERANCE (absolute)
near() {
    checks=$((checks + 1))
    awk -v a="$2" -v b="$3" -v t="$4" 'BEGIN { d = a - b; if (d < 0) d = -d; exit !(d <= t) }' || complain "$1: $2, not $3"
}

# --- lattices against their closed form: 0.5 % of each frequency
# lattice NAME POINTS OPTION...: of at least so many waves
lattice() {
    local name=$1 least=$2 points
    shift 2
    expect 0 '^' "$scree" run balls.yaml --quick -q --force --no-figures -o lattice "$@"
    points=$("$scree" get lattice dispersion_points)
    near "$name: largest deviation" "$("$scree" get lattice dispersion_deviation)" 0 5e-3
    checks=$((checks + 1))
    [ "$points" -ge "$least" ] || complain "$name: only $points waves with a clear frequency"
}
"$scree" new lattice-waves >balls.yaml
lattice 'hexagonal, deformable' 26
lattice 'hexagonal, rigid' 26 --set contact.deformation=none
lattice 'hexagonal, corrected' 26 --set contact.tangential=corrected
lattice 'square, k_t = k_n' 12 --set stages.prepare.method=square --set measure.wave_layers=16 --set materials.0.stiffness_ratio=1 --set contact.tangential=corrected
lattice 'hexagonal, across the rows' 12 --set stages.prepare.width='8 mm' --set measure.wave_axis=y --set measure.wave_layers=16 \
    --set selections.front.axis=y --set contact.deformation=none
sed -i 's/, thickness: 1 m//; s/prepare, method: hexagonal/prepare, method: cubic, depth: 8 mm/' balls.yaml
spheres=(--set dimension=3 --set particles.shape=sphere --set boundary.periodic=xyz --set materials.0.normal_stiffness='7e7 N/m')
lattice 'simple cubic' 12 "${spheres[@]}" --set particles.count=256 --set measure.wave_layers=16
lattice 'face-centred cubic' 20 "${spheres[@]}" --set stages.prepare.method=face_centred --set particles.count=256 --set measure.wave_layers=32
lattice 'body-centred cubic' 20 "${spheres[@]}" --set stages.prepare.method=body_centred --set particles.count=288 --set stages.prepare.width='37 mm' --set stages.prepare.depth='7 mm' --set measure.wave_layers=32

# --- a selection is brought into the shape of the case, A (cos(2 pi x / L) + 1), and of the source's misprint
small=(-q --no-figures --force --set stages.travel.duration='0.2 us' --set measure.wave_from=pull --set measure.wave_every=1)
receivers='[{name: A, place: [1 mm, 1 mm]}, {name: B, place: [4 mm, 1 mm]}, {name: C, place: [8 mm, 1 mm]}]'
"$scree" new ddem-waves | awk '/^  receivers:/ { print "  receivers: '"$receivers"'"; skip = 1; next } skip && /^    -/ { next } { skip = 0; print }' >shape.yaml
cat >formula.awk <<'A'
BEGIN { pi = atan2(0, -1); printf "%.9g", 1e-5 * (cos(2 * pi * x / 0.01 + phase) + offset) }
A
for form in '0 1' '1 0'; do
    read -r phase offset <<<"$form"
    expect 0 '^' "$scree" run shape.yaml "${small[@]}" -o shape --set loads.0.phase="$phase rad" --set loads.0.offset="$offset"
    # 0.2 us of 10 ns are 20 records behind the first; then all stand until 1 us.
    for name in A B; do
        x=$(awk -F, -v name=$name '$1 == name { print $3 }' shape/receiver-places.csv)
        near "place of $name, phase $phase" "$(column shape/receivers.csv ${name}_x 80)" "$(awk -v x="$x" -v phase="$phase" -v offset="$offset" -f formula.awk)" 2e-10
        near "$name stands" "$(column shape/receivers.csv ${name}_y 80)" 0 1e-12
    done
    near "C is held" "$(column shape/receivers.csv C_x 80)" 0 1e-12
done

# --- restart in mid-wave: the same bits
expect 0 '^' "$scree" run ddem-waves -q --no-figures --set stages.travel.duration='30 us' --set measure.wave_every=3 -o whole
"$scree" run ddem-waves -q --no-figures --set stages.travel.duration='30 us' --set measure.wave_every=3 -o part &
run=$!
wait_for 'stage relax (pull) ended' part/log.txt
sleep 0.3
kill -INT $run
wait $run
same $? 130 'status of the run that was interrupted in mid-wave'
[ "$(wc -l <whole/receivers.csv)" -eq 1002 ] || complain "$(wc -l <whole/receivers.csv) lines in receivers.csv, not 1002"
expect 0 '^' "$scree" run --restart part -q --no-figures
same "$("$scree" get whole state_checksum)" "$("$scree" get part state_checksum)" 'checksum after a restart'
cmp -s whole/receivers.csv part/receivers.csv || complain 'receivers.csv after a restart'

# --- displacements go the shortest way, also of bodies that have crossed a face of the cell
sed 's/select: layer, name: front, axis: x, end: low/select: all, name: front/; s/velocity_x: 1 mm\/s, velocity_y: 1 mm\/s/velocity_x: 60 m\/s/; s/wave_layers: 32/receivers: [{name: A, place: [31 mm, 1 mm]}, {name: B, place: [16 mm, 1 mm]}]/' \
    "$SCREE_SOURCE_DIR/cases/lattice-waves.yaml" >drift.yaml
expect 0 '^' "$scree" run drift.yaml --quick -q --no-figures -o drift
for name in A B; do near "$name drifts" "$(column drift/receivers.csv ${name}_x END)" 6e-3 2e-5; done

# --- figures
expect 0 'wave-receivers.svg' "$scree" plot whole --only wave-receivers
expect 0 'dispersion.svg' "$scree" plot lattice --only dispersion

# --- refused
refused() { expect 2 "$1" "$scree" check "${@:2}"; }
expect 2 "measure.receivers.0.place: .*outside of the sample: the nearest particle is" "$scree" run shape.yaml -q --force -o out --set measure.receivers.A.place='[30 mm, 1 mm]'
expect 2 "measure.receivers.1.place: .*nearest to the same particle as 'A'" "$scree" run shape.yaml -q --force -o out --set measure.receivers.B.place='[1 mm, 1 mm]'
expect 2 'measure.wave_layers: .*has no particle: take fewer' "$scree" run lattice-waves -q --force -o out --set measure.wave_layers=4000
refused 'measure.wave_from: .*travel' shape.yaml --set measure.wave_from=travvel
refused 'measure.wave_from: .*takes no steps' shape.yaml --set measure.wave_from=bond
refused 'measure.wave_axis: there is no z' shape.yaml --set measure.wave_axis=z
refused 'measure.wave_layers: .*at least 4 layers' shape.yaml --set measure.wave_layers=3
refused 'measure.receivers.1.name: receivers.0 has the name' shape.yaml --set measure.receivers.1.name=A
refused "loads.0.wavelength" shape.yaml --set loads.0.wavelength=0
refused 'loads.0.axis: there is no z' shape.yaml --set loads.0.axis=z
refused 'loads.2.profile: not used without a velocity' lattice-waves --set loads='[{load: prescribed, selection: front, velocity_x: 0}, {load: prescribed, name: b, selection: front, from: waves, force_y: 1 N}, {load: prescribed, name: c, selection: front, from: waves, torque_z: 1 N m, profile: cosine, wavelength: 1 mm}]'
finish 'waves'
