#!/usr/bin/env bash
# Everything that can be wrong gets one clear message and the right exit status, and nothing is lost.
# shellcheck source=tests/cli/check.sh
. "$(dirname "$0")/check.sh"

"$scree" new biaxial >good.yaml
# case_with SED-SCRIPT: the good case, changed, in bad.yaml
case_with() { sed -E "$1" good.yaml >bad.yaml; }
# refused PATTERN: check and run both refuse bad.yaml with the same message, and no folder is made.
refused() {
    timed expect 2 "$1" "$scree" check bad.yaml
    expect 2 "$1" "$scree" run bad.yaml -o never
    [ -e never ] && complain "a refused case left a folder behind"
    rm -rf never
}

# --- command line
timed expect 2 'chekc.*\(accepted: check\)' "$scree" chekc
timed expect 2 '--thread: there is no such option \(accepted: --threads\)' "$scree" run --thread 2
timed expect 2 'accepted: .*--quick' "$scree" run --wibble good.yaml
timed expect 2 '--output: its value is missing \(accepted: DIR\)' "$scree" run good.yaml -o
timed expect 2 '--quick: this option takes no value' "$scree" run good.yaml --quick=yes
timed expect 2 "CASE: this argument is missing" "$scree" run
timed expect 2 "DIR: this argument is missing" "$scree" get
timed expect 2 "'b' is one argument too many" "$scree" plot a b
for number in 0 -1 x 2x 99999999999999999999 ''; do
    timed expect 2 "is not a number of threads \(accepted: a number from 1 to" "$scree" run good.yaml -o never --threads "$number"
done
timed expect 2 'no built-in case.*\(accepted: biaxial\)' "$scree" new biaxal
timed expect 2 'no file and no built-in case.*\(accepted: biaxial\)' "$scree" run biaxal -o never
timed expect 2 '--set does not go with it' "$scree" run --restart out --set a=1
timed expect 2 'takes no case' "$scree" run --restart out good.yaml
timed expect 2 'accepted: bash' "$scree" help --completion tcsh
timed expect 2 'no such verb.*accepted: run' "$scree" help rum

# --- keys and values: file:line:column: key: message (accepted: ...)
line=$(grep -n '^seed: 1' good.yaml | cut -d: -f1)
case_with 's/^seed: 1/sed: 1/'
refused "^bad\.yaml:$line:1: sed: .*'seed'"
case_with 's/^seed: 1/seed: 1\nseed: 2/'
refused "^bad\.yaml:$((line + 1)):1: seed: "
case_with 's/radius_min: .*/radius_min: 3 kPa/'
refused '^bad\.yaml:[0-9]+:[0-9]+: particles\.radius_min: '
case_with 's/radius_min: .*/radius_min: -0.5 mm/'
refused '^bad\.yaml:[0-9]+:[0-9]+: particles\.radius_min: '
case_with 's/^  step: .*/  step: 1 s/'
refused '^bad\.yaml:[0-9]+:[0-9]+: integrator\.step: .*critical'
case_with 's/^seed: 1/sed: 1/; s/radius_min: .*/radius_min: 3 kPa/; s/every: 250/evry: 250/'
refused 'evry'
same "$(grep -cE '^bad\.yaml:[0-9]+:[0-9]+: ' <<<"$output")" 3 "all problems of a case at once"
timed expect 2 'friktion.*friction' "$scree" check good.yaml --set materials.0.friktion=0.3
timed expect 2 'particles\.count' "$scree" check good.yaml --set particles.count=many
timed expect 2 'set' "$scree" check good.yaml --set nonsense
timed expect 2 'materials' "$scree" check good.yaml --set materials.7.friction=0.3
timed expect 2 'radius_min' "$scree" run good.yaml -o never --set 'particles.radius_min=3 kPa'

# --- files that are no case
: >bad.yaml
refused 'bad\.yaml'
head -c 4096 /dev/urandom >bad.yaml
refused 'bad\.yaml'
head -c 10485760 /dev/zero | tr '\0' 'a' >bad.yaml
refused 'bad\.yaml'
yes 'seed: 1' | head -c 10485760 >bad.yaml
refused 'bad\.yaml'
timed expect 2 "nothing\.yaml.*No such file" "$scree" check nothing.yaml
mkdir folder.yaml
timed expect 4 "folder\.yaml" "$scree" check folder.yaml

# --- output folders
mkdir used && touch used/summary.json
timed expect 2 "'used' holds another run.*--force" "$scree" run good.yaml -o used
mkdir notes && echo mine >notes/paper.txt
timed expect 2 "'notes' holds other files \('paper.txt'\).*--force" "$scree" run good.yaml -o notes
timed expect 2 "'good.yaml' is a file" "$scree" run good.yaml -o good.yaml
timed expect 2 "'good.yaml' is a file" "$scree" run good.yaml -o good.yaml/below
timed expect 2 'root of the file system' "$scree" run good.yaml -o / --force
timed expect 2 'empty' "$scree" run good.yaml -o ''
timed expect 2 'bytes, at most' "$scree" run good.yaml -o "$(head -c 5000 /dev/zero | tr '\0' x)"
timed expect 4 'File name too long' "$scree" run good.yaml -o "$(head -c 300 /dev/zero | tr '\0' x)"
timed expect 4 'cannot make the folder' "$scree" run good.yaml -o /proc/scree-out
same "$(cat notes/paper.txt)" mine

# --- results that are not there
timed expect 4 "no run in 'nowhere'" "$scree" get nowhere phi
timed expect 4 "nowhere" "$scree" plot nowhere
timed expect 2 "there is no folder 'nowhere'" "$scree" run --restart nowhere
mkdir begun && cp good.yaml begun/case.yaml
timed expect 2 "no checkpoint in 'begun'" "$scree" run --restart begun
head -c 1000 /dev/urandom >begun/run.h5
timed expect 4 'begun/run\.h5' "$scree" run --restart begun
mkdir damaged && printf '{\n "phi": ' >damaged/summary.json
timed expect 4 '^damaged/summary\.json:2:' "$scree" get damaged
printf '{"phi": 1.5, "psi": 2}\n' >damaged/summary.json
timed expect 2 "'phy' in 'damaged' \(accepted: phi\)" "$scree" get damaged phi phy psii
same "$(wc -l <<<"$output")" 2 "all wrong names, and no values"

# shellcheck disable=SC2317 # called through expect
# --- standard output that does not take what is printed
to_full() { "$scree" "$@" >/dev/full; }
closed() { "$scree" "$@" >&-; }
# A pipe whose reader has gone away before the program starts.
broken() {
    mkfifo pipe
    exec 3<>pipe 4>pipe 3>&-
    "$scree" "$@" >&4
}
timed expect 4 'cannot write standard output: No space' to_full new biaxial
timed expect 4 'No space' to_full check good.yaml
timed expect 4 'cannot write standard output: Bad file' closed list
timed expect 4 '' broken --help
timed expect 2 'this file exists.*--force' "$scree" new biaxial -o good.yaml
timed expect 4 'No space' "$scree" new biaxial -o /dev/full --force
timed expect 4 'cannot write' "$scree" new biaxial -o nowhere/file

# --- a full disk: the run ends with a message, and what was there before stays
full_disk() {
    if mkdir -p disk && mount -t tmpfs -o size=128k tmpfs disk 2>/dev/null; then
        expect 4 'No space left' "$scree" run good.yaml -o disk/out --quick --set particles.count=600 --no-figures
        head -c 1M /dev/zero >disk/filler 2>/dev/null
        expect 4 'No space left' "$scree" new biaxial -o disk/my.yaml
        umount disk
    else
        # Without the right to mount: a limit on the size of files stands for the full disk.
        limited() { (trap '' XFSZ; ulimit -f 48; "$scree" "$@"); }
        expect 4 'too large' limited run good.yaml -o limited --quick --set particles.count=600 --no-figures
    fi
}
full_disk

# --- colours and rewritten lines only on a terminal
"$scree" run bad.yaml -o never 2>plain.txt
grep -q $'\033' plain.txt && complain "escape sequences in a file"
finish "the slowest error took $slowest ms"
