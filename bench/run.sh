#!/bin/bash
# All benchmarks of a build folder: bench/run.sh BUILD. LAMMPS (`lmp`, Debian package lammps) runs beside ours, in turn,
# when it is installed. Figures vary from run to run; only ratios measured in turn mean anything.
set -euo pipefail
build=${1:?usage: bench/run.sh BUILD}
folder=$build/bench/peers
mkdir -p "$folder"
peer=()
if command -v lmp >/dev/null; then peer=(--peer lmp --folder "$folder"); else echo "lmp is not installed: no peer"; fi

for bench in "$build"/bench/bench_*; do
  [ -x "$bench" ] && [ -f "$bench" ] || continue
  echo "== $(basename "$bench")"
  case $bench in
  *bench_biaxial | *bench_spheres) "$bench" "${peer[@]}" ;;
  *) "$bench" ;;
  esac
done
