#!/usr/bin/env bash
# Runs of bonded lattices, deformable, against closed forms: C11, C12, C44 within 1e-3, which is the strain of the stage (5e-5, engineering against
# logarithmic), where its last sample lies (1e-4), and the lag of the strains (3e-4).
# shellcheck source=tests/cli/check.sh
. "$(dirname "$0")/check.sh"

value() { awk -v name="$1" '$1 == name { print $2 }' <<<"$theory"; }
# near NAME FOUND EXPECTED: within 1e-3 of the largest stiffness
near() {
    checks=$((checks + 1))
    awk -v a="$2" -v b="$3" -v most="$(value stiffness_11)" 'BEGIN { d = a - b; if (d < 0) d = -d; exit !(d <= 1e-3 * most) }' || complain "$1: $2, not $3"
}
# compare KIND KN FORM OPTION...
compare() {
    local kind=$1 kn=$2 form=$3
    shift 3
    theory=$("$scree" theory lattice --kind "$kind" --kn "$kn" --kt 0.5 --radius 1e-3 --density 2000 --young-modulus 2e11 --poisson-ratio 0.3 --tangential "$form")
    expect 0 '^' "$scree" run "$case" -q --force -o out --set contact.deformation=explicit --set contact.tangential="$form" --set materials.0.poisson_ratio=0.3 --set materials.0.stiffness_ratio=0.5 "$@"
    local at='{ print $1 / 5e-5 }'
    near "$kind C11" "$("$scree" get out stress_axial_contacts | awk "$at")" "$(value stiffness_11)"
    near "$kind C12" "$("$scree" get out stress_lateral_contacts | awk "$at")" "$(value stiffness_12)"
    near "$kind C44" "$("$scree" get out stress_shear_contacts | awk "$at")" "$(value stiffness_44)"
}

case=ddem-lattices-3d
compare simple_cubic 7e7 as_published
same "$(value stiffness_44)" 8.75e+09 # no contact opens: particles keep their shape
compare simple_cubic 7e7 corrected
compare body_centred 7e7 as_published --set stages.prepare.method=body_centred --set particles.count=128 --set stages.prepare.width='9.24 mm' --set stages.prepare.depth='9.24 mm'
compare face_centred 7e7 as_published --set stages.prepare.method=face_centred --set particles.count=128
flat=(--set dimension=2 --set particles.shape=disc --set particles.thickness='1 m' --set boundary.periodic=xy --set materials.0.normal_stiffness='7e10 N/m'
    --set stages.squeeze.velocity_gradient='{yy: -0.2 1/s}' --set stages.shear.velocity_gradient='{xy: 0.2 1/s}')
case=poisson-limit
compare hexagonal 7e10 as_published "${flat[@]}" --set stages.prepare.method=hexagonal --set stages.prepare.width='12 mm' --set particles.count=48
compare square 7e10 as_published "${flat[@]}" --set stages.prepare.method=square --set stages.prepare.width='12 mm' --set particles.count=36

# --- a cell needs no confinement when bonds hold what is in it, and nothing else is let off
"$scree" new ddem-lattices-3d >my.yaml
expect 0 'method: cubic' "$scree" check my.yaml
sed '/stage: bond/d' my.yaml >loose.yaml
expect 2 'stages.1.stage: a confine stage must come before: deform keeps its pressure' "$scree" check loose.yaml
finish 'runs of lattices'
