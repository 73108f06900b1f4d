#!/usr/bin/env bash
# Installs the Debian packages that Scree needs and that are missing, as root or through sudo. Where neither is possible
# (or with --check, always) it prints the one command to run and stops with status 1. On other systems than Debian it
# leaves the matter to CMake. --reproduce: what published experiments are compared with; --site: what makes the pages of `make site`;
# --mpi: what the preset mpi builds with, and its tests look into files with.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
command -v dpkg-query >/dev/null || exit 0
list=debian-packages.txt
[ "${1-}" = --reproduce ] && list=debian-packages-reproduce.txt
[ "${1-}" = --mpi ] && list=debian-packages-mpi.txt
[ "${1-}" = --site ] && list=debian-packages-site.txt
missing=()
while read -r package; do
    dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'install ok installed' || missing+=("$package")
done <"$here/$list"
[ ${#missing[@]} -eq 0 ] && exit 0

say_how() {
    if [ "$list" = debian-packages-reproduce.txt ]; then
        echo "Going on without: ${missing[*]} (sudo apt-get install ${missing[*]}). What needs it is not run." >&2
        exit 0
    fi
    echo "Scree needs packages that are not installed. Run this once, then try again:" >&2
    echo "    sudo apt-get install -y --no-install-recommends ${missing[*]}" >&2
    exit 1
}
[ "${1-}" = --check ] && say_how
as_root=()
if [ "$(id -u)" -ne 0 ]; then
    sudo -n true 2>/dev/null || say_how
    as_root=(sudo)
fi
echo "Installing: ${missing[*]}"
export DEBIAN_FRONTEND=noninteractive
install=("${as_root[@]}" apt-get install -y -q --no-install-recommends "${missing[@]}")
"${install[@]}" >/dev/null 2>&1 && exit 0
"${as_root[@]}" apt-get update -q >/dev/null || true
"${install[@]}" >/dev/null || say_how
