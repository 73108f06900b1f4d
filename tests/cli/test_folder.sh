#!/usr/bin/env bash
# The folder of a run: one writer at a time, nothing of others removed, and an end for every way to die.
# shellcheck source=tests/cli/check.sh
. "$(dirname "$0")/check.sh"

# A biaxial test of 40 discs: less than a second; `long`: some seconds.
tiny=(--quick --threads 1 --set particles.count=40 --set 'stages.compress.strain=1 %' --set 'stages.compress.rate=0.5 1/s'
    --set 'stages.confine.friction=0.4' --set 'integrator.step=4e-5 s' --set 'measure.windows=[]' --set output.snapshots=1)
long=("${tiny[@]}" --set 'stages.compress.strain=4 %' --set 'stages.compress.rate=1e-2 1/s' --no-figures)

# begin FOLDER [COMMAND...]: a long run in the background that has a checkpoint, under COMMAND; sets $pid.
begin() {
    local folder=$1
    shift
    "${@:-env}" "$scree" run biaxial -o "$folder" "${long[@]}" 2>"$folder.txt" &
    pid=$!
    wait_for 'confine ended' "$folder/log.txt"
}
# ended FOLDER STATUS: waits for $pid.
ended() {
    wait $pid 2>/dev/null
    same $? "$2" "exit status of the run in $1: $(cat "$1.txt")"
}
sum() { "$scree" get "$1" state_checksum; }

"$scree" run biaxial -o whole -q "${long[@]}" || complain "the uninterrupted run"
[ -e whole/scree.lock ] && complain "a lock is left behind"

# --- while a run goes on nobody else writes into its folder, and is told who does
begin cut
who="the folder 'cut' is in use by scree run, process $pid on host $(uname -n)"
cp cut/case.yaml before.yaml
expect 2 "$who" "$scree" run --restart cut
expect 2 "$who" "$scree" run restitution --force -o cut
expect 2 "$who" "$scree" run biaxial -o cut "${tiny[@]}"
expect 2 "$who" "$scree" plot cut
cmp -s before.yaml cut/case.yaml || complain "--force wrote into the folder of a run that goes on"
# --- a killed process locks nobody out; of two that continue it, one does and one is refused
kill -KILL $pid
ended cut 137
[ -s cut/scree.lock ] || complain "no text of the killed run's lock"
for k in 1 2; do "$scree" run --restart cut --no-figures --threads 1 2>restart$k.txt & pids[k]=$!; done
wait "${pids[1]}"; first=$?
wait "${pids[2]}"; second=$?
same $((first + second)) 2 "one restart ends well, the other is refused: $first and $second"
grep -q 'in use by scree run --restart, process [0-9]* on host' restart[12].txt || complain "no word of who holds the folder"
same "$(sum cut)" "$(sum whole)" "checksum after two restarts at once"
cmp -s cut/series.csv whole/series.csv || complain "series.csv differs after two restarts at once"
[ -e cut/scree.lock ] && complain "the restart left its lock"
# --- a job that is stopped and requeued, again and again
rm -r cut
begin cut
for signal in TERM HUP XCPU; do
    kill "-$signal" $pid
    ended cut 130
    grep -qE "interrupted at step .*by signal $(kill -l $signal) .*--restart cut" cut/log.txt || complain "no line about SIG$signal in log.txt"
    "$scree" run --restart cut --no-figures --threads 1 2>cut.txt &
    pid=$!
    for ((i = 0; i < 1200; i++)); do
        [ "$(grep -c interrupted cut/log.txt)" -eq "$(grep -c restarted cut/log.txt)" ] && break
        sleep 0.05
    done
done
ended cut 0
same "$(sum cut)" "$(sum whole)" "checksum after three interrupts"

# --- --force removes what Scree wrote, all of it, and nothing else
expect 0 'results in out' "$scree" run biaxial -o out "${tiny[@]}"
theirs=(out/series.csv.backup out/run.h5.mycopy out/figures/mine.png out/figures/x.gp out/paraview/mine.vtp out/notes/x.csv
    out/lock out/files.txt.old out/parts/snapshot-000001.h5.mycopy)
mkdir -p out/notes out/parts
for file in "${theirs[@]}"; do echo mine >"$file"; done
ours=$(find out -type f ! -name log.txt | sort)
expect 0 '' "$scree" run restitution -o out --force -q --no-figures
for file in "${theirs[@]}"; do same "$(cat "$file")" mine "$file"; done
gone=0
for file in $ours; do
    [[ " ${theirs[*]} out/files.txt " == *" $file "* ]] || grep -qxF "${file#out/}" out/files.txt || { gone=$((gone + 1)); [ -e "$file" ] && complain "$file of the old run is left"; }
done
[ $gone -gt 20 ] || complain "only $gone files of the old run to look at"
for file in $(find out -type f); do
    [[ " ${theirs[*]} out/files.txt " == *" $file "* ]] || grep -qxF "${file#out/}" out/files.txt || complain "$file is not in files.txt"
done
# A list that somebody has written does not lead out of the folder.
mkdir -p victim && echo mine >victim/x && cp victim/x out/outside
printf '../victim/x\n%s/victim/x\nnotes/x.csv\nfigures/../../victim/x\n' "$PWD" >>out/files.txt
expect 0 '' "$scree" run restitution -o out --force -q --no-figures
same "$(cat victim/x out/notes/x.csv out/outside | sort -u)" mine
# Without a list (an older version): what has a fixed name, and a word about the rest.
expect 0 '^warning: stage 2' "$scree" run biaxial -o old -q "${tiny[@]}"
rm -f old/files.txt
echo mine >old/figures/mine.png
figures=$(ls old/figures | wc -l)
expect 0 "kept no list of its files: $figures in 'old/figures'" "$scree" run restitution -o old --force --no-figures
same "$(ls old/figures | wc -l)" "$figures"
[ -e old/cells.csv ] && complain "cells.csv of an older version is left"

# --- a preparation that fails: its folder is taken by the next call
too_dense=("${tiny[@]}" --set stages.prepare.method=gas --set stages.prepare.solid_fraction=0.9)
expect 2 '40 discs do not fit' "$scree" run biaxial -o failed "${too_dense[@]}"
expect 0 'ended before its first checkpoint is replaced' "$scree" run restitution -o failed --no-figures
expect 2 'holds another run' "$scree" run biaxial -o failed "${too_dense[@]}"
# --- a limit on the size of files is an error like a full disk, and a limit on processor time an interrupt
limited() { (ulimit -f 24; exec "$scree" "$@"); }
expect 4 'File too large' limited run biaxial -o limited --no-figures "${tiny[@]}"
grep -q 'error.*File too large' limited/log.txt || complain "no line about the limit in log.txt"
expect 0 'is replaced' "$scree" run restitution -q -o limited --no-figures
one_second() { (ulimit -S -t 1; exec "$scree" "$@"); }
expect 130 'by signal 24' one_second run biaxial -o processor "${long[@]}" --set 'stages.compress.rate=1e-3 1/s'
# --- nohup stays what it is
begin nohup nohup
kill -HUP $pid
ended nohup 0
finish ""
