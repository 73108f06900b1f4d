#!/usr/bin/env bash
# Finite elements beside a run: results of two discs and of a bar where ccx is installed, what is said where it is not, and what is refused.
# shellcheck source=tests/cli/check.sh
. "$(dirname "$0")/check.sh"

# near NAME FOUND EXPECTED TOLERANCE (relative)
near() {
    checks=$((checks + 1))
    awk -v a="$2" -v b="$3" -v t="$4" 'BEGIN { d = a - b; if (d < 0) d = -d; exit !(d <= t * (b < 0 ? -b : b)) }' || complain "$1: $2, not $3"
}
discs=("$scree" run two-discs-fem -q --no-figures --force --set measure.fem_elements=1 --set measure.fem_steps=4)
mkdir nothing

# --- without the program: a warning, and no results of it
expect 0 'no finite elements: ccx is not installed \(Debian package calculix-ccx\)' env PATH="$scratch/nothing" "${discs[@]}" -o without
expect 2 'fem_approach' "$scree" get without fem_approach
cat >needy.yaml <<'Y'
sweep: 1
case: two-discs-fem
needs: no-such-program
quick: yes
Y
expect 2 "needs the program 'no-such-program', which is not installed" "$scree" sweep needy.yaml -o needy
expect 0 "two-discs-fem: not run: it needs the program 'ccx'" env PATH="$scratch/nothing" "$scree" reproduce --only two-discs-fem -o reproduced
expect 0 'fem-approach .*not run' cat reproduced/reproduction.md

# --- what is refused
expect 2 'measure.finite_elements: they are compared with an elastic test' "$scree" check biaxial --set measure.finite_elements=bar
expect 2 'measure.finite_elements: two discs are wanted, and the case has 180 particles' "$scree" check ddem-uniaxial --set measure.finite_elements=discs
expect 2 'the particles are rigid: say fem_young_modulus' "$scree" run two-discs-fem -q -o rigid --set contact.deformation=none
expect 2 'measure.fem_damping' "$scree" check two-discs-fem --set measure.fem_damping='1 us'

# --- with it
if command -v ccx >/dev/null; then
    expect 0 '^' "${discs[@]}" -o discs
    # Coarse mesh, four increments: 0.5 % and 3 % of the closed forms.
    near 'approach' "$("$scree" get discs fem_approach)" "$("$scree" get discs fem_approach_theory)" 5e-3
    near 'widening' "$("$scree" get discs fem_widening)" "$("$scree" get discs fem_widening_theory)" 3e-2
    # Mean strains of the discs: 2 f R / (pi R^2) over E, times the diameter; and nu of it across.
    near 'mean strain' "$("$scree" get discs average_approach)" 6.366198e-8 1e-5
    near 'mean strain across' "$("$scree" get discs average_widening)" 2.228169e-8 1e-5
    for file in fem.inp fem.dat fem.log fem-force.csv fem-axis.csv; do [ -s "discs/$file" ] || complain "no $file"; done
    for file in fem.frd fem.12d spooles.out; do [ ! -e "discs/$file" ] || complain "$file is left"; done
    expect 0 '^fem-axis.csv$' cat discs/files.txt
    expect 0 '^' "$scree" run ddem-uniaxial -q --no-figures -o bar --set measure.finite_elements=bar --set measure.fem_elements=3 --set measure.fem_steps=60 --set measure.fem_damping='2 us'
    # E and nu of the run itself: what is left is the curve between 40 and 80 % of the load.
    near 'E of the run' "$("$scree" get bar fem_young_modulus)" "$("$scree" get bar axial_young_modulus)" 1e-9
    near 'density' "$("$scree" get bar fem_density)" 1570.796327 1e-6
    near 'strain at the end' "$("$scree" get bar fem_strain_ratio)" 1 5e-3
    near 'lateral strain' "$("$scree" get bar width_strain)" "$("$scree" get bar fem_lateral_strain)" 1e-2
    # A solver that fails leaves the run as it is, and says why.
    printf '#!/bin/sh\necho "*ERROR in nothing: it is a test"\n' >nothing/ccx
    chmod +x nothing/ccx
    expect 0 'no finite elements: CalculiX .* ERROR in nothing: it is a test' env PATH="$scratch/nothing:/bin" "${discs[@]}" -o failed
    expect 2 'fem_approach' "$scree" get failed fem_approach
fi
finish
