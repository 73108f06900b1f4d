#!/usr/bin/env bash
# Members of a sweep: what kills them costs what was not written, one writer each, and the case counts, not its text.
# shellcheck source=tests/cli/check.sh
. "$(dirname "$0")/check.sh"

cat >tiny.yaml <<'END'
name: tiny
case: biaxial
quick: yes
realisations: 2
set: {particles.count: 40, stages.compress.strain: 1 %, stages.compress.rate: 0.5 1/s, stages.confine.friction: 0.4,
  integrator.step: 4e-5 s, measure.windows: [], output.snapshots: 0, output.paraview: no, output.figures: yes}
measures: [peak_stress_ratio]
END
first=members/000-seed=1
second=members/001-seed=2
restarts() { grep -c restarted "$1/$first/log.txt"; }

expect 0 '' "$scree" sweep tiny.yaml -o whole -q --jobs 2
sum=$("$scree" get whole/$first state_checksum)
figures=$(ls whole/$first/figures | wc -l)
[ "$figures" -gt 10 ] || complain "only $figures figures"

# --- a gnuplot that sends its parent a signal, the first time
mkdir fake
real=$(command -v gnuplot)
cat >fake/gnuplot <<END
#!/bin/sh
[ -s "$scratch/signal" ] || exec "$real" "\$@"
signal=\$(cat "$scratch/signal")
rm "$scratch/signal"
kill -\$signal \$PPID
exit 1
END
chmod +x fake/gnuplot
run() { PATH=$scratch/fake:$PATH "$scree" "$@"; }

# --- done is said when figures are drawn, and not before
one=(biaxial -o one -q --quick --threads 1)
while read -r path value; do one+=(--set "$path=$value"); done <<'END'
particles.count 40
stages.compress.strain 1 %
stages.compress.rate 0.5 1/s
stages.confine.friction 0.4
integrator.step 4e-5 s
measure.windows []
output.snapshots 0
output.paraview no
END
echo KILL >signal
expect 137 '^warning: stage 2' run run "${one[@]}"
expect 0 '^finishing$' "$scree" get one status
expect 0 '' "$scree" run --restart one -q
same "$("$scree" get one status) $("$scree" get one state_checksum) $(ls one/figures | wc -l)" "done $sum $figures"
echo TERM >signal
expect 130 'figures were drawn.*--restart one' run run "${one[@]}" --force
expect 0 '^finishing$' "$scree" get one status
grep -q 'interrupted while figures' one/log.txt || complain "no line about the interrupt at the end"

# --- a member that is killed while it draws is finished by the next call
echo KILL >signal
expect 3 'killed by signal 9.*the same command continues it' run sweep tiny.yaml -o drawn --jobs 1
grep -q '^0,.*,interrupted,' drawn/members.csv || complain "members.csv: $(cat drawn/members.csv)"
expect 0 'means in' "$scree" sweep tiny.yaml -o drawn
same "$(restarts drawn) $("$scree" get drawn/$first status) $(ls drawn/$first/figures | wc -l)" "1 done $figures"

# --- one that is killed while it computes goes on from its checkpoint; meanwhile nobody else runs it
long=(--set 'stages.compress.strain=4 %' --set 'stages.compress.rate=1e-2 1/s' --no-figures)
expect 0 '' "$scree" sweep tiny.yaml -o long -q --realisations 1 "${long[@]}"
long_sum=$("$scree" get long/$first state_checksum)
"$scree" sweep tiny.yaml -o cut --jobs 1 --realisations 1 "${long[@]}" 2>cut.txt &
pid=$!
wait_for 'confine ended' cut/$first/log.txt
expect 2 'in use by scree sweep, process '$pid "$scree" sweep tiny.yaml -o cut --realisations 1 "${long[@]}"
expect 2 'in use by scree run, process' "$scree" run --restart cut/$first
expect 0 'still to be run' "$scree" sweep tiny.yaml -o cut --realisations 1 "${long[@]}" --collect
kill -KILL "$(sed 's/.*process \([0-9]*\) .*/\1/' cut/$first/scree.lock)"
wait $pid
same $? 3 "a sweep whose member was killed: $(cat cut.txt)"
# By hand, and the sweep meanwhile
"$scree" run --restart cut/$first -q --threads 1 2>/dev/null &
pid=$!
wait_for restarted cut/$first/log.txt
expect 2 "in use by scree run --restart, process $pid" "$scree" sweep tiny.yaml -o cut --realisations 1 "${long[@]}"
kill -KILL $pid
wait $pid 2>/dev/null
expect 0 'means in' "$scree" sweep tiny.yaml -o cut --realisations 1 "${long[@]}"
same "$(restarts cut) $("$scree" get cut/$first state_checksum)" "2 $long_sum" "a member that was killed twice"
# Without a whole checkpoint it begins anew.
"$scree" sweep tiny.yaml -o cut -f --jobs 1 --realisations 1 "${long[@]}" --set seed=7 2>/dev/null &
pid=$!
wait_for 'seed: 7' cut/$first/case.yaml
wait_for 'confine ended' cut/$first/log.txt
kill -KILL "$(sed 's/.*process \([0-9]*\) .*/\1/' cut/$first/scree.lock)"
wait $pid
for part in cut/$first/parts/checkpoint-*; do truncate -s -1 "$part"; done
expect 0 'means in' "$scree" sweep tiny.yaml -o cut --realisations 1 "${long[@]}" --set seed=7
same "$(restarts cut)" 0 "a member without a whole checkpoint was continued"

# --- the meaning of a case counts: another way to write it, and keys that it does not have yet, are the same case
sed -i -e '/young_modulus/s/3 GPa/3e3 MPa/' -e 's/#.*//' -e '/servo_gain/d' -e '/^gravity/d' whole/$first/case.yaml
touch stamp
expect 0 '2 of 2 members are done' "$scree" sweep tiny.yaml -o whole
[ -n "$(find whole/members -name run.h5 -newer stamp)" ] && complain "a finished member was run again"
sed -i '/young_modulus/s/3e3 MPa/31e2 MPa/' whole/$first/case.yaml
expect 2 'holds a run of another case' "$scree" sweep tiny.yaml -o whole
sed -i '/young_modulus/s/31e2 MPa/3 GPa/; s/poisson_ratio/no_such_key/' whole/$first/case.yaml
expect 2 'holds a run of another case' "$scree" sweep tiny.yaml -o whole
same "$("$scree" get whole/$second status)" "done"
finish ""
