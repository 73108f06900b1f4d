#!/usr/bin/env bash
# site.sh FOLDER: the documentation as pages for a browser (docs/conf.py), made anew; a link that leads nowhere is an error.
# Status 77 where Sphinx, MyST or the theme are not installed: the packages are in debian-packages-site.txt.
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
folder=$1
generator=$(command -v sphinx-build || true)
python=$(sed -n '1s/^#! *//p' "${generator:-/dev/null}")
if ! ${python:-false} -c 'import myst_parser, sphinx_rtd_theme' 2>/dev/null; then
    echo "not installed: $(paste -sd ' ' "$root/cmake/debian-packages-site.txt") (sudo apt-get install ...)" >&2
    exit 77
fi
rm -rf "$folder"
sphinx-build -q -n -W --keep-going -j auto -b html -c "$root/docs" -d "$folder/.doctrees" "$root" "$folder"
rm -rf "$folder/.doctrees"
echo "$folder/index.html"
