#!/usr/bin/env bash
# demo.sh SCREE FOLDER: runs the biaxial test of cases/ into FOLDER, replacing an older demo there, and says where its
# figures are and what its main numbers are.
set -eu
scree=$1
folder=$2
cases=$(cd "$(dirname "$0")/../cases" && pwd)
"$scree" run "$cases/biaxial.yaml" -o "$folder" --force

value() { LC_ALL=C printf '%.4g' "$("$scree" get "$folder" "$1")"; }
echo
printf '%-52s %s\n' \
    'quasistatic coefficient phi' "$(value phi)" \
    'inertial number (quasistatic: below 1e-3)' "$(value inertial_number)" \
    'kinetic over elastic energy (below 0.1)' "$(value kinetic_over_elastic)" \
    'size coefficient psi' "$(value psi)" \
    'peak of axial over lateral stress' "$(value peak_stress_ratio)" \
    'the same over the last fifth of the strain' "$(value final_stress_ratio)" \
    'largest dilation of the volume' "$(value max_volumetric_dilation)" \
    'energy that is unaccounted for, over all energy' "$(value energy_residual)" \
    'stress of plates against stress of contacts' "$(value stress_disagreement)" \
    'checksum of the final state' "$("$scree" get "$folder" state_checksum)"
echo
echo "Figures (as SVG and PNG):"
printf '    %s\n' "$folder"/figures/*.png
