#!/usr/bin/env bash
# scree stability and scree moduli: numbers that belong together, where a specimen is taken from, what is refused.
# shellcheck source=tests/cli/check.sh
. "$(dirname "$0")/check.sh"
small=(periodic-shear --quick --set particles.count=100)
value() { awk -v name="$1" '$1 == name { print $2 }' <<<"$output"; }
holds() {
    checks=$((checks + 1))
    awk "BEGIN { exit !($1) }" || complain "not so: $1"
}

# --- stability
expect 0 '^critical_step +[0-9.e-]+ +s ' "$scree" stability "${small[@]}" --at deform
rigid=$(value critical_step)
holds "$rigid > 0 && $rigid < $(value critical_step_undamped) && $(value step) < $rigid"
holds "$(value contacts) > 100 && $(value step_of_extremes) > 0"
[ -z "$(value spectral_radius)" ] || complain 'rigid particles have a spectral radius'
again=$output
same "$("$scree" stability "${small[@]}" --at deform)" "$again" 'the same specimen twice'
expect 0 '^spectral_radius ' "$scree" stability "${small[@]}" --at deform --young-modulus 1e8 --poisson-ratio 0.3
ratio=$(value spectral_radius) most=$(value largest_ratio)
holds "$ratio > 0 && $ratio < 1 && ($(value stiffness_ratio) / $ratio - $most)^2 < 1e-8 * $most^2"
# Slip governs, which this form leaves to rigid particles.
for name in explicit_step relaxed_step implicit_step; do holds "($(value "$name") / $rigid - 1)^2 < 1e-4"; done
# Ten times as soft as the limit: no explicit step.
soft=$(awk "BEGIN { print 1e8 * $ratio / 10 }")
expect 0 '^explicit_step +0 ' "$scree" stability "${small[@]}" --at deform --young-modulus "$soft" --poisson-ratio 0.3
holds "($(value spectral_radius) / 10 - 1)^2 < 1e-8 && $(value relaxed_step) > 0.7 * $rigid"

# Where nothing is free to move no step is critical, and a case says so before it runs.
cat >held.yaml <<'END'
name: held
materials: [{name: disc, young_modulus: 200 GPa, poisson_ratio: 0.35, density: 2000 kg/m3, friction: 0, normal_stiffness: 7e10 N/m, stiffness_ratio: 0}]
contact: {law: linear}
particles: {material: disc, count: 3, distribution: equal, radius: 1 mm, thickness: 1 m}
boundary: {periodic: x}
selections: [{select: all, name: row}]
loads: [{load: prescribed, selection: row, velocity_x: 0, velocity_y: 0, spin_z: 0}]
stages:
  - {stage: prepare, method: bodies, width: 5.97 mm, bodies: [{position: [0.5 mm, 1 mm]}, {position: [2.49 mm, 1 mm]}, {position: [4.48 mm, 1 mm]}]}
  - {stage: relax, boundary: none, duration: 1 us}
END
for form in none=0 explicit=0 relaxed=0 explicit=0.5; do
    held=(held.yaml --set contact.deformation="${form%=*}" --set materials.disc.stiffness_ratio="${form#*=}")
    expect 0 '^critical_step +inf ' "$scree" stability "${held[@]}"
    [ "${form%=*}" = none ] || expect 0 '^explicit_step +inf ' "$scree" stability "${held[@]}"
done
for name in $("$scree" list | awk '{ print $1 }'); do
    expect 0 '^# time needed ' "$scree" check "$name" --quick
done

# --- above a limit: values, limits, and ways out
expect 3 'spectral radius of the strains is 1.18[0-9]*; k_n/E is 0.7 m, and may be 0.5877[0-9]* m with this step: take stiffer .*relaxed or implicit' "$scree" run ddem-stability -q -o above --set materials.disc.young_modulus=1e11
expect 2 'critical step of this case, 1.41e-08 s, and may be unstable; give 7e-09 s, or auto, or less damping \(2.45e-07 s without dashpots\)' "$scree" run ddem-stability -q -o above --set materials.disc.damping_ratio=5
"$scree" run ddem-stability -q -o above --set integrator.step='400 ns' 2>&1 | grep -q 'less damping' && complain 'dashpots that are not there'
expect 2 'young_modulus: .0. is too small' "$scree" check ddem-stability --set materials.disc.young_modulus=0
grep -q 'poisson_ratio' <<<"$output" && complain 'a Poisson ratio that is right is refused'

# --- moduli
expect 0 '^young_modulus +[0-9.e+]+ +Pa ' "$scree" moduli "${small[@]}" --at deform
stiff=$(value young_modulus)
holds "$stiff > 0 && $stiff < $(value voigt_young_modulus) && $(value asymmetry) < 1e-6"
holds "($(value fabric_xx) + $(value fabric_yy) - 1)^2 < 1e-8"
holds "($stiff / (2 * (1 - $(value poisson_ratio))) / $(value bulk_modulus) - 1)^2 < 1e-8"
expect 0 '^young_modulus ' "$scree" moduli "${small[@]}" --at deform --young-modulus 1e8
holds "$(value young_modulus) < $stiff"

# A square lattice between plates: C_xxxx = k_n / t, C_xyxy = k_t / (2 t), with the overlap of 10 kPa, 1e-4 of k_n.
cat >box.yaml <<'END'
name: box
materials: [{name: glass, young_modulus: 1 GPa, density: 2500 kg/m3, friction: 0.4, normal_stiffness: 1e7 N/m, stiffness_ratio: 0.5}]
contact: {law: linear}
particles: {material: glass, count: 100, distribution: equal, radius: 1 mm, thickness: 1 m}
measure: {windows: []}
stages:
  - {stage: prepare, method: square, aspect_ratio: 1}
  - {stage: confine, pressure: 10 kPa, boundary: plates}
  - {stage: relax, duration: 1 ms, boundary: plates}
END
expect 0 '^stiffness_xxxx ' "$scree" moduli box.yaml --at relax
holds "($(value stiffness_xxxx) / 1e7 - 1)^2 < 1e-6 && ($(value stiffness_xyxy) / 2.5e6 - 1)^2 < 1e-6"

# --- limits before a run: exact where the specimen stands before the first step, of lattices where it comes later; and its fastest mode
expect 0 '^# k_n / E +0.35 m, explicit strains bear 0\.5[0-9]+ m at this step, 0\.59[0-9]+ m at a small one' "$scree" check ddem-stability
expect 0 '^# critical step +[0-9.]+ us, of the specimen, rigid particles' "$scree" check bond-tension --quick
sed 's/^  - {stage: relax.*/  - {stage: bond}\n&/' box.yaml >later.yaml
expect 0 '^# limits +not known yet' "$scree" check later.yaml
grep -qE '^# (limits|k_n / E)' <("$scree" check box.yaml) && complain 'limits where nothing is bonded'
expect 0 '^ratio_at_step ' "$scree" stability ddem-stability -o mode.png
[ -s mode.svg ] && [ -s mode.png ] || complain 'no figure of the fastest mode'

# --- the folder of a run, which stays as it is
expect 0 '' "$scree" run "${small[@]}" --no-figures --quiet --set 'stages.deform.strain=0.1 %' --set 'measure.windows=[]' -o out
before=$(cd out && find . -type f -exec md5sum {} + | sort)
expect 0 '^critical_step +[0-9.e-]+ +s ' "$scree" stability out
expect 0 '^young_modulus ' "$scree" moduli out
same "$(cd out && find . -type f -exec md5sum {} + | sort)" "$before" 'the folder after its specimen was looked at'

# --- refused
expect 2 "no stage 'defrom'; did you mean 'deform'" "$scree" stability "${small[@]}" --at defrom
expect 2 'periodic in all directions, or fills a box' "$scree" moduli minimal-shear-circle --quick
expect 2 'between -1 and 0.5' "$scree" stability "${small[@]}" --young-modulus 1e8 --poisson-ratio 0.5
expect 2 'alone' "$scree" stability "${small[@]}" --poisson-ratio 0.3
expect 2 'is no number' "$scree" stability "${small[@]}" --young-modulus soft
expect 2 'read as it stands' "$scree" stability out --at deform
# --- figures of broken bonds where some broke
expect 0 '^' "$scree" run ddem-uniaxial --quick -q -o whole
expect 0 'energy-time' ls whole/figures
[[ "$output" != *broken-bonds* && "$output" != *cracks* ]] || complain "a chart of bonds of which none broke"
expect 0 '^' "$scree" run ddem-failure --quick -q -o broken --set particles.count=60 --set stages.press.duration='0.3 ms'
if (($("$scree" get broken bonds_broken_shear) > 0)); then expect 0 'broken-bonds.*cracks' bash -c 'echo $(ls broken/figures)'; else complain "no bond broke"; fi
finish 'specimens'
