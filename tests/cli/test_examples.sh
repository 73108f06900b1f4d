#!/usr/bin/env bash
# The examples in C, built against the library as `make install` leaves it, shared and static; what they print.
# shellcheck source=tests/cli/check.sh
. "$(dirname "$0")/check.sh"
build=$(dirname "$scree")
examples=${SCREE_SOURCE_DIR:?}/examples/c

unset MAKEFLAGS MAKELEVEL MFLAGS
DESTDIR=$scratch/stage cmake --install "$build" --prefix /opt/scree >install.txt || complain "cmake --install"
pc=$(find "$scratch/stage" -name scree.pc)
export PKG_CONFIG_PATH=${pc%/*}
lib=$(dirname "$PKG_CONFIG_PATH")
read -ra flags < <(pkg-config --cflags scree)
read -ra shared < <(pkg-config --libs scree)
read -ra all < <(pkg-config --static --libs scree)
static=()
for flag in "${all[@]}"; do [ "$flag" = -lscree ] && static+=("$lib/libscree.a") || static+=("$flag"); done
warnings=(-Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror)
# A library built with a sanitizer needs its run time in the program too.
sanitizer=()
nm "$lib/libscree.a" 2>/dev/null | grep -q '__asan_init' && sanitizer=("-fsanitize=address,undefined")
nm "$lib/libscree.a" 2>/dev/null | grep -q '__tsan_init' && sanitizer=(-fsanitize=thread)
compiler=${CC:-cc}
[ ${#sanitizer[@]} -gt 0 ] && "$scree" --version | grep -q clang && compiler=clang

# example NAME: builds it twice and leaves what it prints in NAME.txt; for a newcomer it stays on one screen.
example() {
    expect 0 '' "$compiler" -std=c17 "${warnings[@]}" "${sanitizer[@]}" "${flags[@]}" "$examples/$1.c" -o "$1_shared" "${shared[@]}" -lm
    expect 0 '' "$compiler" -std=c17 "${warnings[@]}" "${sanitizer[@]}" "${flags[@]}" "$examples/$1.c" -o "$1_static" "${static[@]}" -lm
    expect 0 . env LD_LIBRARY_PATH="$lib" "./$1_shared"
    printf '%s\n' "$output" >"$1.txt"
    expect 0 . "./$1_static"
    same "$output" "$(cat "$1.txt")" "$1, static against shared"
    [ "$(wc -l <"$examples/$1.c")" -le 60 ] || complain "$1.c has more than 60 lines"
}
# holds WHAT FILE PROGRAM: awk finds nothing wrong, and prints nothing.
holds() {
    checks=$((checks + 1))
    local wrong
    wrong=$(awk "$3" "$2")
    [ -z "$wrong" ] || complain "$1: $wrong"
}

# Two discs of 2 mm x pi mm2 x 1000 kg/m3 and 0.2 N/m: 2 mm cos(w t), w^2 = 2 k / m.
example own_force
[ "$(grep -c stretched own_force.txt)" -ge 10 ] || complain "own_force: $(cat own_force.txt)"
holds "a spring of its own" own_force.txt '
    BEGIN { m = 1000 * 3.14159265 * 1e-6 * 2e-3; w = sqrt(2 * 0.2 / m) }
    /stretched/ { x = 2 * cos(w * $1); if ((x - $5) ^ 2 > 0.01 ^ 2) print $1 " s: " $5 " mm, not " x }
    /balance/ { if (!($NF < 1e-9)) print }'
# A loaded sample has more contacts along its load, and less than half of them bear more than the mean.
example own_measure
holds "anisotropy" own_measure.txt '
    { gsub(",", ""); a[$1] = $5; d[$1] = $7; if (!($2 > 50 && $9 > 25 && $9 < 60)) print }
    END { if (NR != 3 || !(a["compress"] > 0.15 && a["compress"] > 2 * a["confine"])) print "anisotropy " a["confine"] ", " a["compress"]
          if (!(d["compress"] > 70 && d["compress"] < 110)) print "towards " d["compress"] }'
# More damping, less of the speed comes back; little damping, nearly all of it.
example study
holds "restitution" study.txt '
    NR > 1 { if (!($2 > 0 && $2 < last + (NR == 2))) print; last = $2; n++ } NR == 2 { if (!($2 > 0.85)) print }
    END { if (n != 5) print n " rows" }'
finish ""
