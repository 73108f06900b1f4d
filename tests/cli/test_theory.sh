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
same "$(complete_line scree theory l)" lattice
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
expect 2 'stiffness_ratio: .*0 or more' "$scree" theory lattice --kt -0.1
expect 2 'poisson_ratio: .*below 0.5' "$scree" theory lattice --poisson-ratio 0.5
expect 2 'radius: .*above 0' "$scree" theory lattice --radius 0
expect 2 'young_modulus: .*above 0' "$scree" theory lattice --young-modulus -1
expect 2 '--kn: .*no number' "$scree" theory lattice --kn stiff
expect 2 '--plane: .*strain, stress' "$scree" theory lattice --plane both
expect 2 '--kindd: .*--kind' "$scree" theory lattice --kindd row

finish 'closed forms'
