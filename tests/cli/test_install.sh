#!/usr/bin/env bash
# `make install` into a scratch prefix, and a program built against what was installed: static and shared, C and C++.
# shellcheck source=tests/cli/check.sh
. "$(dirname "$0")/check.sh"
build=$(dirname "$scree")

# The make variables of an outer `make test` would change what is installed here.
unset MAKEFLAGS MAKELEVEL MFLAGS
DESTDIR=$scratch/stage cmake --install "$build" --prefix /opt/scree >install.txt || complain "cmake --install"
prefix=$scratch/stage/opt/scree
for file in bin/scree include/scree/scree.h share/man/man1/scree.1 share/bash-completion/completions/scree; do
    [ -s "$prefix/$file" ] || complain "$file is not installed"
done
same "$("$prefix/bin/scree" list)" "$("$scree" list)" "the installed program"

# --- the Python package, where there is one
if package=$(find "$prefix/lib" -path '*/dist-packages/scree/__init__.py') && [ -n "$package" ]; then
    packages=${package%/scree/__init__.py}
    [ -f "$packages/scree/py.typed" ] || complain "py.typed is not installed"
    python=$([ -x /usr/bin/python3 ] && echo /usr/bin/python3 || echo python3)
    if "$python" -c 'import numpy' 2>/dev/null && ! nm "$build/libscree.a" 2>/dev/null | grep -qE '__(asan|tsan)_init'; then
        expect 0 "^$prefix/" env PYTHONPATH="$packages" PYTHONDONTWRITEBYTECODE=1 "$python" -c \
            'import scree; scree.Simulation(scree.Case("biaxial", quick=True), 1).step(1); print(scree.library_path)'
    fi
fi

# --- pkg-config, from wherever the folder lies now
pc=$(find "$prefix" -name scree.pc)
export PKG_CONFIG_PATH=${pc%/*}
lib=$(dirname "$PKG_CONFIG_PATH")
same "$(pkg-config --modversion scree)" "$("$scree" --version | cut -d ' ' -f 2)" "version of pkg-config"
cat >user.c <<'END'
#include <scree/scree.h>
int main(void)
{
    scree_simulation *s = NULL;
    scree_case *c = NULL;
    scree_problems *problems = NULL;
    scree_error error;
    bool done = false;
    const char *text = scree_template_text("biaxial");
    const char *small[] = {"particles.count=50"};
    scree_case_options options = {small, 1, true};
    if (!text || scree_case_parse(text, __builtin_strlen(text), "biaxial", &options, &c, &problems)) return 1;
    if (scree_simulation_create(c, 1, &s, &error) || scree_simulation_advance(s, 10, &done, &error)) return 2;
    printf("%016llx\n", (unsigned long long)scree_simulation_checksum(s));
    scree_simulation_free(s);
    scree_case_free(c);
    return 0;
}
END
read -ra flags < <(pkg-config --cflags scree)
read -ra shared < <(pkg-config --libs scree)
read -ra static < <(pkg-config --static --libs scree)
warnings=(-Wall -Wextra -Wpedantic -Wconversion -Werror)
# A library built with a sanitizer needs its run time in the program too.
sanitizer=()
nm "$lib/libscree.a" 2>/dev/null | grep -q '__asan_init' && sanitizer=("-fsanitize=address,undefined")
nm "$lib/libscree.a" 2>/dev/null | grep -q '__tsan_init' && sanitizer=(-fsanitize=thread)
compiler=${CC:-cc}
[ ${#sanitizer[@]} -gt 0 ] && "$scree" --version | grep -q clang && compiler=clang
expect 0 '' "$compiler" -std=c17 "${warnings[@]}" "${sanitizer[@]}" "${flags[@]}" user.c -o user_shared "${shared[@]}"
expect 0 '^[0-9a-f]{16}$' env LD_LIBRARY_PATH="$lib" ./user_shared
checksum=$output
readelf -d user_shared | grep -q 'libscree\.so\.0' || complain "not linked with libscree.so.0"
rest=()
for flag in "${static[@]}"; do [ "$flag" = -lscree ] && rest+=("$lib/libscree.a") || rest+=("$flag"); done
expect 0 '' "$compiler" -std=c17 "${warnings[@]}" "${sanitizer[@]}" "${flags[@]}" user.c -o user_static "${rest[@]}"
expect 0 "^$checksum\$" ./user_static
if command -v c++ >/dev/null; then
    expect 0 '' c++ -x c++ -std=c++17 -Wall -Wextra -Wpedantic -Werror "${flags[@]}" -fsyntax-only user.c
fi

# --- the man page, with whatever can draw it
page=$prefix/share/man/man1/scree.1
if command -v mandoc >/dev/null; then
    expect 0 'for granular matter' mandoc -T ascii "$page"
    checks=$((checks + 1))
    errors=$(mandoc -T lint -W error "$page" 2>&1)
    [ -z "$errors" ] || complain "mandoc: $errors"
fi
if command -v man >/dev/null && command -v groff >/dev/null; then
    expect 0 'EXIT STATUS' env MANWIDTH=80 man -P cat -l "$page"
    errors=$(groff -man -Tutf8 -ww "$page" 2>&1 >/dev/null)
    [ -z "$errors" ] || complain "groff: $errors"
fi
finish ""
