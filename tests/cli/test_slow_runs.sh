#!/usr/bin/env bash
# Slow runs of irregular bonded specimens against the static solutions of `scree moduli`: 0.2 %, of which the waves that the drive leaves are most (0.02 to 0.05 % here).
# shellcheck source=tests/cli/check.sh
. "$(dirname "$0")/check.sh"

# near NAME FOUND EXPECTED
near() {
    checks=$((checks + 1))
    awk -v a="$2" -v b="$3" 'BEGIN { d = a - b; if (d < 0) d = -d; exit !(d <= 2e-3 * b) }' || complain "$1: $2, not $3"
}
value() { awk -v name="$1" '$1 == name { print $2 }' <<<"$moduli"; }

# --- between plates: the outermost discs move towards each other, sides free; E over the area between the outermost surfaces
for form in none explicit; do
    expect 0 '^' "$scree" run ddem-irregular --quick -q --no-figures --force -o press --set contact.deformation=$form --set loads.low.velocity_y='0.5 mm/s' --set loads.high.velocity_y='-0.5 mm/s' --set stages.press.duration='1 ms'
    near "E, $form" "$("$scree" get press axial_young_modulus)" "$("$scree" get press static_axial_young_modulus)"
    near "nu, $form" "$("$scree" get press axial_poisson_ratio)" "$("$scree" get press static_axial_poisson_ratio)"
done
moduli=$("$scree" moduli press)
near 'the same by the verb' "$(value uniaxial_young_modulus_y)" "$("$scree" get press static_axial_young_modulus)"
# A square lattice: nine columns of twenty discs, k_n / 19 a column, 38 mm from centre to centre and 18 mm wide.
moduli=$("$scree" moduli ddem-uniaxial --set contact.deformation=none)
near 'E of columns' "$(value uniaxial_young_modulus_y)" 7e10
near 'E of rows' "$(value uniaxial_young_modulus_x)" 7e10

# --- a periodic cell: strained along y
cat >cell.yaml <<'END'
name: cell
seed: 3
materials: [{name: disc, young_modulus: 200 GPa, poisson_ratio: 0.35, density: 2000 kg/m3, friction: 0, normal_stiffness: 7e10 N/m, stiffness_ratio: 0.5, damping_ratio: 0}]
particles: {shape: disc, material: disc, count: 200, distribution: uniform, radius_min: 0.3 mm, radius_max: 0.5 mm, thickness: 1 m}
contact: {law: linear, deformation: explicit}
loads: [{load: background_damping, translation: 0.2, rotation: 0.2}]
integrator: {step: 20 ns}
boundary: {periodic: xy}
stages:
  - {stage: prepare, method: dense, solid_fraction: 91 %, aspect_ratio: 1}
  - {stage: bond, gap_tolerance: 10 um, overlap_tolerance: 40 um}
  - {stage: deform, velocity_gradient: {yy: -0.2 1/s}, strain: 5e-5, rise_time: 20 us}
  - {stage: relax, duration: 0.1 ms}
measure: {samples: 50, cells: no}
output: {snapshots: 1, figures: no, paraview: no}
END
for kind in none=0.5 explicit=0 explicit=0.5 relaxed=0.5 implicit=0.5; do
    expect 0 '^' "$scree" run cell.yaml -q --force -o cell --set contact.deformation="${kind%=*}" --set materials.disc.stiffness_ratio="${kind#*=}"
    moduli=$("$scree" moduli cell)
    # Of the last row: the cell comes to rest in the last stage.
    strain=$(awk -F, 'NR == 1 { for (k = 1; k <= NF; k++) if ($k == "volumetric_strain [1]") column = k } END { print $column }' cell/series.csv)
    near "C22, $kind" "$("$scree" get cell stress_axial_contacts | awk -v e="$strain" '{ print $1 / e }')" "$(value stiffness_yyyy)"
    near "C12, $kind" "$("$scree" get cell stress_lateral_contacts | awk -v e="$strain" '{ print $1 / e }')" "$(value stiffness_xxyy)"
done
finish 'slow runs'
