#!/usr/bin/env bash
# scree theory: closed forms as lines, tables and figures, and what is refused.
# shellcheck source=tests/cli/check.sh
. "$(dirname "$0")/check.sh"

value() { awk -v name="$1" '$1 == name { print $2 }' <<<"$output"; }

# --- a group of verbs: help, man page, completion
expect 2 'theory: .*accepted: theory lattice' "$scree" theory
expect 2 'theory latice: .*accepted: theory lattice' "$scree" theory latice
expect 2 'theory: .*accepted: theory lattice' "$scree" theory --kt 0.5
expect 0 '^Usage: scree theory lattice' "$scree" theory lattice --help
same "$output" "$("$scree" help theory lattice)" "scree help theory lattice against --help"
expect 2 'one argument too many' "$scree" help theory lattice more
expect 2 'one argument too many' "$scree" theory lattice more
expect 0 '^  theory lattice ' "$scree" --help
expect 0 '^.SS scree theory lattice' "$scree" help --man
"$scree" help --completion bash >completion.bash
complete_line() {
    PATH=$(dirname "$scree"):$PATH bash -c '. ./completion.bash; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _scree; echo "${COMPREPLY[*]}"' bash "$@"
}
same "$(complete_line scree the)" theory
same "$(complete_line scree theory la)" 'lattice layer'
same "$(complete_line scree theory wedge --fr)" --friction
expect 0 '^  theory wedge ' "$scree" theory --help
same "$output" "$("$scree" help theory)" "scree help theory against --help"
expect 0 '^  theory layer ' "$scree" theory -h
same "$(complete_line scree theory lattice --ki)" --kind

# --- by hand, in units of k_n, radius and mass: hexagonal, k_t = 0: C11 = 9/8 sqrt 3 k_n / l (Born), nu = 1/3
expect 0 '^stiffness_11 ' "$scree" theory lattice
same "$(value stiffness_11)" 1.299038
same "$(value poisson_ratio)" 0.3333333
same "$(value critical_step)" 1.447203 # sqrt(2 pi / 3)
# M 3.43 for nu_p = 0.35: pi / 4 / 1.35
expect 0 '^largest_ratio' "$scree" theory lattice --kind square --poisson-ratio 0.35
same "$(value largest_ratio)" 0.5817764
# A row: 1 / (1 + 2 k_n / k_p), k_p = pi E / 2 at nu_p = 0
expect 0 '^contact_stiffness' "$scree" theory lattice --kind row --young-modulus 4
same "$(value contact_stiffness)" 0.758547
for kind in row square hexagonal simple_cubic body_centred face_centred; do
    expect 0 '^critical_step' "$scree" theory lattice --kind "$kind" --kt 0.3 --young-modulus 8 --poisson-ratio 0.2 --tangential corrected
done

# --- files
expect 0 '^explicit_step' "$scree" theory lattice --kind simple_cubic --kt 0.3 --young-modulus 8 -o cubic
for file in values.csv dispersion-table.csv dispersion.svg dispersion.png dispersion.gp; do
    [ -s "cubic/$file" ] || complain "no cubic/$file"
done
same "$(head -1 cubic/values.csv)" name,value,unit,meaning
same "$(head -1 cubic/dispersion-table.csv | tr ',' '\n' | wc -l)" 13
expect 0 '^critical_step' "$scree" theory lattice -o cubic
touch file
expect 2 'file' "$scree" theory lattice -o file

# --- refused, with what would be right
expect 2 'kind: .*accepted: hexagonal' "$scree" theory lattice --kind hexagnal
expect 2 'kind: .*simple_cubic' "$scree" theory lattice --kind tetrahedral
expect 2 '--kt: .*0 or more' "$scree" theory lattice --kt -0.1
expect 2 '--poisson-ratio: .*below 0.5' "$scree" theory lattice --poisson-ratio 0.5
expect 2 'radius: .*above 0' "$scree" theory lattice --radius 0
expect 2 '--young-modulus: .*above 0' "$scree" theory lattice --young-modulus -1
expect 2 '--kn: .*no number' "$scree" theory lattice --kn stiff
expect 2 '--plane: .*strain, stress' "$scree" theory lattice --plane both
expect 2 '--kindd: .*--kind' "$scree" theory lattice --kindd row

# --- piles: R 4.12, 4.13 (22.5, 38.6, 48.6 degrees) and the residuals of all equations
small() { # fails unless the value is below the bound
    awk -v name="$1" -v bound="$2" '$1 == name { found = 1; if (($2 < 0 ? -$2 : $2) > bound) bad = 1 } END { exit bad || !found }' <<<"$output" ||
        complain "$1 = $(value "$1"), not below $2"
}
expect 0 '^dip_core_right' "$scree" theory wedge --phi 28
same "$(value dip_core_right)" 22.49628
same "$(value smooth_core_right)" 38.63363
same "$(value peak_core_right)" 48.63536
same "$(value dip_a1) $(value dip_a2) $(value dip_b1)" "0.7805174 0.3920713 -1.767981"
same "$(value dip_dip)" 0.769371
for name in equilibrium weight closure surface continuity; do small "check_$name" 1e-14; done
expect 0 '^given_dip +0.1796' "$scree" theory wedge --phi 28 --core 35
expect 0 '^dip_axis_shear' "$scree" theory wedge --phi 28,21 -o slopes
same "$(value dip_core_left) $(value dip_core_right)" "20.70153 27.70153"
for name in equilibrium weight closure surface continuity; do small "check_$name" 1e-14; done
for file in vertical horizontal shear mobilised; do
    for ending in -table.csv .svg .png .gp; do [ -s "slopes/$file$ending" ] || complain "no slopes/$file$ending"; done
done
same "$(head -1 slopes/vertical-table.csv)" 'x [m],dip [Pa],smooth [Pa],peak [Pa]'
# Feet of the two slopes, cot(28) and cot(21), and no stress there.
same "$(sed -n '2p' slopes/vertical-table.csv)" '-1.88072647,0,0,0'
same "$(tail -1 slopes/vertical-table.csv)" '2.60508906,0,0,0'
expect 0 '^peak_solutions +0' "$scree" theory wedge --phi 28,21 --axis free
# No kind has a solution about a ray that is far from the vertical.
expect 2 '^scree theory wedge: (--)?axis: no wedge balances about a ray 50 degrees from the vertical .accepted: .*free' "$scree" theory wedge --phi 28 --axis 50
expect 0 '^peak_solutions +1' "$scree" theory wedge --phi 28 --axis 0
expect 0 '^smooth_core_left +44' "$scree" theory wedge --phi 25,21 --friction 30 --state passive
# R 4.30 - 4.32, with mu from the condition of yield at the surface
expect 0 '^eta +0.74' "$scree" theory osl --phi 28 --eta 0.74
same "$(value mu) $(value ratio) $(value tau)" "-0.2979411 1.345441 85.14172"
for name in equilibrium weight closure surface continuity; do small "check_$name" 1e-14; done
expect 0 '^consistency +-0.004' "$scree" theory osl --phi 28 --eta 0.74 --mu -0.31
same "$(value ratio) $(value tau)" "1.344965 84.94906"
expect 0 '^mu +-1.063419' "$scree" theory osl --phi 28 --ratio 1 --tau 76
turned=$(value axis_vertical)
expect 0 '^ratio +1 ' "$scree" theory fpa --phi 28
same "$(value axis_vertical)" "$turned"
expect 0 '^consistency' "$scree" theory osl --phi 28 --tau 80
small consistency 1e-14
expect 0 '^dip ' "$scree" theory bcc --phi 28
small dip 1e-14
expect 0 '^axis_vertical +0.797149 ' "$scree" theory ife --phi 28
small check_equilibrium 1e-9
small check_closure 1e-14
# SI: rho g H times the same number
expect 0 '^axis_vertical +10047' "$scree" theory ife --phi 28 --density 4000 --gravity 9.81 --height 0.3212

# --- loads
expect 0 '^bonded_peak_over +1.268' "$scree" theory layer --nu 0.3 --base bonded -o layer
small check_equilibrium 1e-9
small check_base 1e-8
small check_force 1e-6
for file in vertical horizontal shear base; do [ -s "layer/$file.png" ] || complain "no layer/$file.png"; done
expect 0 '^smooth_peak_over +1.444' "$scree" theory layer --base smooth
# Plane stress with nu is plane strain with nu / (1 + nu).
expect 0 '^bonded_peak' "$scree" theory layer --nu 0.25 --plane stress
same "$(value bonded_peak)" "$("$scree" theory layer --nu 0.2 | awk '$1 == "bonded_peak" { print $2 }')"
expect 0 '^half_space_peak +1273' "$scree" theory flamant --force 300 --depth 0.15

# --- refused
expect 2 '--phi: .*angle of repose' "$scree" theory ife
expect 2 '--phi: .*left,right' "$scree" theory wedge --phi 28,
expect 2 '--phi: .*below 90' "$scree" theory bcc --phi 90
expect 2 '--phi: .*below 90' "$scree" theory wedge --phi 28,-3
expect 2 '--phi: .*0.5 to 85.5 degrees' "$scree" theory ife --phi 88
expect 2 '--phi: .*0.5 to 85.5 degrees' "$scree" theory ife --phi 0.1
expect 2 '--phi: .*symmetric' "$scree" theory osl --phi 28,21 --eta 0.7
expect 2 '--height: .*above 0' "$scree" theory fpa --phi 28 --height 0
expect 2 '--eta: .*real characteristics.*larger eta' "$scree" theory osl --phi 28 --eta -0.5 --mu 0.2
expect 2 '--eta: .*same side' "$scree" theory osl --phi 28 --eta -0.1 --mu -1
expect 2 '--eta: .*flatter than the slope' "$scree" theory osl --phi 28 --eta 1.2 --mu 3
expect 2 '--mu: eta and mu say the same as K and tau' "$scree" theory osl --phi 28 --mu 0.1 --tau 3
expect 2 '--mu: both characteristics run to the same side .*accepted: eta above 0; this is eta = -[0-9.]+, mu = 3' "$scree" theory osl --phi 28 --mu 3
expect 2 '--tau: both characteristics run to the same side .*accepted: eta above 0; this is eta = -[0-9.]+, mu = ' "$scree" theory osl --phi 28 --tau 45
expect 2 '--ratio: .*K above 0' "$scree" theory osl --phi 28 --ratio -1 --tau 80
expect 2 '--ratio: .*tau' "$scree" theory osl --phi 28 --ratio 1.3
expect 2 '--eta: .*which relation' "$scree" theory osl --phi 28
expect 2 '--eta: .*one of these pairs' "$scree" theory osl --phi 28 --eta 0.7 --tau 80
expect 2 '--friction: .*larger slope' "$scree" theory wedge --phi 28 --friction 20
expect 2 '--core: .*no pile' "$scree" theory wedge --phi 28 --core 80
expect 2 '--core: .*below 90' "$scree" theory wedge --phi 28 --core 0
expect 2 '--axis: .*below 90' "$scree" theory wedge --phi 28 --axis 90
expect 2 '--axis: .*no number' "$scree" theory wedge --phi 28 --axis up
expect 2 '--nu: .*at most 0.5' "$scree" theory layer --nu 0.6
expect 2 '--base: .*accepted: bonded' "$scree" theory layer --base bondd
expect 2 '--thickness: .*above 0' "$scree" theory layer --thickness -1
expect 2 '--force: .*above 0' "$scree" theory flamant --force 0
expect 2 '--depth: .*above 0' "$scree" theory flamant --depth 0
expect 2 '--eta: ' "$scree" theory bcc --phi 28 --eta 1

finish 'closed forms'
