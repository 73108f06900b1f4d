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

# --- between plates: the outermost discs move towards each other, sides free; E over the area between the outermost surfaces,
# which with half of the discs is that of the case over the root of two
for form in none explicit; do
    expect 0 '^' "$scree" run ddem-irregular --quick -q --no-figures --force -o press --set particles.count=200 --set measure.elastic_area='0.01002 m2' --set contact.deformation=$form --set loads.low.velocity_y='0.5 mm/s' --set loads.high.velocity_y='-0.5 mm/s' --set stages.press.duration='1 ms'
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

# --- between smooth plates all around
# pressed RUN: bulk modulus of its last row, mean over the axes, with the areas between the outermost surfaces
pressed() {
    "$scree" export "$1" --stage press -o "$1.dump" >/dev/null
    awk -v dimension="$2" '
        FNR == NR && /^ITEM: ATOMS/ { for (k = 3; k <= NF; k++) at[$k] = k - 2; atoms = 1; delete low; delete high; next }
        FNR == NR && /^ITEM/ { atoms = 0 }
        FNR == NR && atoms { for (axis in letter) {
            x = $at[letter[axis]]; r = $at["radius"]
            if (!(axis in low) || x - r < low[axis]) low[axis] = x - r
            if (!(axis in high) || x + r > high[axis]) high[axis] = x + r } }
        FNR == NR { next }
        FNR == 1 { n = split($0, name, ","); for (k = 1; k <= n; k++) { sub(" .*", "", name[k]); column[name[k]] = k } next }
        { for (k in column) value[k] = $column[k] }
        END {
            for (axis in letter) {
                area = 1
                for (other in letter) if (other != axis) area *= high[other] - low[other]
                force = value[last[axis] "_exerted_force_" letter[axis]] - value[first[axis] "_exerted_force_" letter[axis]]
                sum += force / 2 / area; strain += value[gauge[axis] "_strain"] }
            sum /= dimension; if (sum < 0) sum = -sum; if (strain < 0) strain = -strain
            printf "%.9g\n", sum / strain }
        BEGIN {
            split("x y z", letter, " "); if (dimension == 2) delete letter[3]
            split("left low front", first, " "); split("right high back", last, " "); split("width height depth", gauge, " ")
            if (dimension == 3) { first[2] = "front"; last[2] = "back"; gauge[2] = "depth"; first[3] = "low"; last[3] = "high"; gauge[3] = "height" }
        }' "$1.dump" FS=, "$1/series.csv"
}
for form in none explicit; do
    expect 0 '^' "$scree" run ddem-isotropic --quick -q --no-figures --force -o flat --set particles.count=200 --set contact.deformation=$form --set stages.press.duration='1 ms' \
        --set loads.low.velocity_y='0.5 mm/s' --set loads.high.velocity_y='-0.5 mm/s' --set loads.left.velocity_x='0.5 mm/s' --set loads.right.velocity_x='-0.5 mm/s'
    near "K of discs, $form" "$(pressed flat 2)" "$("$scree" get flat static_pressed_bulk_modulus)"
done
moduli=$("$scree" moduli flat)
near 'K by the verb' "$(value pressed_bulk_modulus)" "$("$scree" get flat static_pressed_bulk_modulus)"
moduli=$("$scree" moduli ddem-uniaxial --set contact.deformation=none)
near 'K of rows and columns' "$(value pressed_bulk_modulus)" 3.5e10
cat >packing.yaml <<'END'
name: ball
dimension: 3
seed: 3
materials: [{name: bead, young_modulus: 200 GPa, poisson_ratio: 0.25, density: 2000 kg/m3, friction: 0, normal_stiffness: 5e7 N/m, stiffness_ratio: 0.3, damping_ratio: 0}]
particles: {shape: sphere, material: bead, count: 250, radius_min: 0.5 mm, radius_max: 1 mm}
contact: {law: linear, deformation: explicit}
measure:
  samples: 50
  cells: no
  moduli: yes
END
cat >stages.yaml <<'END'
stages:
  - {stage: prepare, method: dense, solid_fraction: 64 %, aspect_ratio: 1, size_penalty: 0.3}
  - {stage: bond, gap_tolerance: 5 um, overlap_tolerance: 1 mm, tensile_strength: 1e30 N, shear_strength: 1e30 N}
output: {snapshots: 1, figures: no, paraview: no}
END
# `select: side` goes by the outline, the operator by the distance from the faces: in space some bodies are of one alone, which is 0.3 % of K.
faces() {
    awk -v axis="$1" -v end="$2" '
        /^ITEM: ATOMS/ { for (k = 3; k <= NF; k++) at[$k] = k - 2; count = 0; sum = 0; delete place; next }
        /^ITEM/ { at["id"] = 0 }
        at["id"] { id[++count] = $at["id"] - 1; place[count] = end * $at[axis] + $at["radius"]; sum += $at["radius"] }
        END {
            for (k = 1; k <= count; k++) if (k == 1 || place[k] > most) most = place[k]
            for (k = 1; k <= count; k++) if (most - place[k] < 0.9 * sum / count) printf "%s%d", found++ ? ", " : "", id[k] }' packing.dump
}
cat packing.yaml stages.yaml >packed.yaml
expect 0 '^' "$scree" run packed.yaml -q -o packed
"$scree" export packed -o packing.dump >/dev/null
{
    cat packing.yaml
    echo '  gauges: [{name: height, between: high, and: low, along: z}, {name: width, between: right, and: left, along: x}, {name: depth, between: back, and: front, along: y}]'
    echo 'selections:'
    while read -r name axis end; do echo "  - {select: ids, name: $name, ids: [$(faces "$axis" "$end")]}"; done <<<$'low z -1\nhigh z 1\nleft x -1\nright x 1\nfront y -1\nback y 1'
    echo 'loads:'
    echo '  - {load: background_damping, translation: 0.2, rotation: 0.2}'
    while read -r name axis rate; do echo "  - {load: prescribed, name: $name, selection: $name, from: press, velocity_$axis: $rate mm/s}"; done <<<$'low z 1\nhigh z -1\nleft x 1\nright x -1\nfront y 1\nback y -1'
    sed '/stage: bond/a\  - {stage: relax, name: press, boundary: none, duration: 0.3 ms}' stages.yaml
} >ball.yaml
for form in none explicit; do
    expect 0 '^' "$scree" run ball.yaml -q --force -o ball --set contact.deformation=$form
    near "K of spheres, $form" "$(pressed ball 3)" "$("$scree" get ball static_pressed_bulk_modulus)"
done
finish 'slow runs'
