#!/usr/bin/env bash
# scree sweep, scree report and scree reproduce: what is run, resumed, survived and written.
# shellcheck source=tests/cli/check.sh
. "$(dirname "$0")/check.sh"

# Members of less than a second each.
cat >tiny.yaml <<'END'
# Friction of a tiny sample
name: tiny
title: Friction
case: biaxial
quick: yes
realisations: 2
set:
  particles.count: 40
  stages.compress.strain: 1 %
  stages.compress.rate: 0.5 1/s
  stages.confine.friction: 0.4
  integrator.step: 4e-5 s
  measure.windows: []
  output.snapshots: 0
  output.paraview: no
  output.figures: no
vary:
  - {key: materials.0.friction, values: [0.2, 0.5]}
measures: [peak_stress_ratio, steps]
curves: [{y: stress_ratio}]
END

# --- what it amounts to, without running
expect 0 '^003-friction=0.5-seed=2: scree run biaxial --quick .*--set materials.0.friction=0.5 --set seed=2$' \
    "$scree" sweep tiny.yaml --dry-run
same "$("$scree" sweep tiny.yaml -n 2>/dev/null | wc -l)" 4
same "$("$scree" sweep tiny.yaml -n --realisations 3 2>/dev/null | wc -l)" 6
[ -e out ] && complain "--dry-run made a folder"
sed 's/friction, v/fraction, v/' tiny.yaml >wrong.yaml
expect 2 'wrong.yaml:18:[0-9]+: materials.0.fraction: .*did you mean .materials.0.friction.' "$scree" sweep wrong.yaml
expect 0 '^4 members: [0-9.e-]+ s of processor time, each on one thread; the longest [0-9.e-]+ s, at most [0-9.]+ MB each$' \
    "$scree" sweep tiny.yaml --dry-run
expect 2 'does not go with' "$scree" sweep tiny.yaml --dry-run --collect
expect 2 'no number of jobs|not a number of jobs' "$scree" sweep tiny.yaml --jobs 0
expect 2 'a number from 0 to 3' "$scree" sweep tiny.yaml --member 4
expect 2 'there is no file and no built-in sweep of this name' "$scree" sweep nothing.yaml
expect 2 '^biaxal-boundaries: .*\(accepted: biaxial-boundaries\)$' "$scree" sweep biaxal-boundaries
mkdir restitution
expect 0 'scree run' "$scree" sweep restitution --dry-run
rmdir restitution
expect 2 '^hopper: this is a case, not a sweep: ' "$scree" sweep hopper
"$scree" new hopper >a-case.yaml
expect 2 '^a-case.yaml: this is a case, not a sweep: ' "$scree" sweep a-case.yaml
grep -v '^scree:' a-case.yaml >bare-case.yaml
expect 2 '^bare-case.yaml: this is a case, not a sweep: ' "$scree" sweep bare-case.yaml

# --- members draw where the sweep says so
grep -v 'output.figures' tiny.yaml >silent.yaml
expect 0 '4 members: ' "$scree" sweep silent.yaml --dry-run --set particles.count=30
expect 0 'means in' "$scree" sweep silent.yaml -o silent --jobs 2 --realisations 1
[ -n "$(ls silent/members/000-friction=0.2-seed=1/figures 2>/dev/null)" ] && complain 'a member has figures that nobody asked for'
[ -s silent/figures/peak_stress_ratio-over-friction.svg ] || complain 'the sweep has no figures'

# --- a whole sweep, then nothing left to do
expect 0 'means in s/table.csv' "$scree" sweep tiny.yaml -o s --jobs 2
for file in s/members.csv s/table.csv s/sweep.json s/curves/stress_ratio-over-axial_strain.csv \
    s/figures/stress_ratio-over-axial_strain.png s/figures/peak_stress_ratio-over-friction.svg \
    s/members/003-friction=0.5-seed=2/summary.json; do
    [ -s "$file" ] || complain "no $file"
done
same "$(head -1 s/members.csv)" \
    'member,folder,point,realisation,seed,materials.0.friction [1],status,wall_time [s],peak_stress_ratio,steps'
same "$(grep -c ',done,' s/members.csv)" 4
same "$(wc -l <s/table.csv)" 3
peaks=($("$scree" get s/members/000-friction=0.2-seed=1 peak_stress_ratio) $("$scree" get s/members/002-friction=0.2-seed=2 peak_stress_ratio))
# 12.7062: Student's t for one degree of freedom, four decimals; half = t |a - b| / 2.
awk -F, -v a="${peaks[0]}" -v b="${peaks[1]}" 'NR == 2 { d = a - b; if (d < 0) d = -d; half = 12.7062 * d / 2; m = (a + b) / 2
    ok = ($4 - m)^2 < 1e-20 && ($7 - m - half)^2 < 1e-8 * half^2 && $8 == 2; exit !ok }' s/table.csv || complain "mean or interval: $(sed -n 2p s/table.csv)"
# Each line of a relation is named.
sed 's/^curves.*/relations: [{x: steps, y: peak_stress_ratio}]/; s/^realisations: 2/realisations: 1/
    s,^  - {key: materials.*,&\n  - {key: stages.compress.rate\, values: [0.5 1/s\, 0.6 1/s]},' tiny.yaml >lines.yaml
expect 0 'means in lines/table.csv' "$scree" sweep lines.yaml -o lines --jobs 2
for friction in 0.2 0.5; do
    grep -q "friction $friction" lines/figures/peak_stress_ratio-over-steps.gp || complain "no line is called friction $friction"
done
grep -q 'set logscale y' lines/figures/peak_stress_ratio-over-steps.gp && complain "a relation has a logarithmic axis"
sed -i 's/y: peak_stress_ratio}/y: peak_stress_ratio, log_y: yes}/' lines.yaml
expect 0 'means in lines/table.csv' "$scree" sweep lines.yaml -o lines --collect
grep -q 'set logscale y' lines/figures/peak_stress_ratio-over-steps.gp || complain "no relation has a logarithmic axis"
touch stamp
expect 0 '4 of 4 members are done' "$scree" sweep tiny.yaml -o s
[ -n "$(find s/members -name run.h5 -newer stamp)" ] && complain "a finished member was run again"
same "$("$scree" get s/members/000-friction=0.2-seed=1 seed)" 1

# --- results do not depend on how it is run
sums() { for k in "$1"/members/0*/; do "$scree" get "$k" state_checksum; done; }
expect 0 '' "$scree" sweep tiny.yaml -o one -q --jobs 1 --threads 2 --no-figures
same "$(sums one)" "$(sums s)" "checksums with one job and with two"
expect 0 '' cmp one/curves/stress_ratio-over-axial_strain.csv s/curves/stress_ratio-over-axial_strain.csv
[ -e one/figures/stress_ratio-over-axial_strain.png ] && complain "figures in spite of --no-figures"

# --- a closed form beside the simulation, and one measure over another
expect 0 '' "$scree" sweep restitution --quick -o r -q --jobs 2
for file in restitution-over-damping_time.png relaxation_time-over-restitution.svg; do
    [ -s "r/figures/$file" ] || complain "no r/figures/$file"
    grep -q 'closed form' "r/figures/${file%.*}.gp" || complain "no closed form in $file"
done
[ -e r/figures/restitution_theory-over-damping_time.png ] && complain "a closed form has a figure of its own"
awk -F, 'NR > 1 && ($5 / $11 - 1)^2 > 1e-6 { exit 1 }' r/table.csv || complain "restitution is not that of the closed form: $(cat r/table.csv)"
sed 's/friction, values/friction, quick_values: [0.1, 0.3], names: [a, b], values/' tiny.yaml >quick.yaml
expect 0 '^001-b-seed=1: .*friction=0.3' "$scree" sweep quick.yaml --dry-run
sed '/^quick: yes/d; s/^measures/quick_set: {particles.count: 50}\nfull_set: {particles.count: 70}\nmeasures/' tiny.yaml >forms.yaml
expect 0 '^000-.*--set particles.count=70' "$scree" sweep forms.yaml --dry-run
expect 0 '^000-.*--quick .*--set particles.count=50' "$scree" sweep forms.yaml --dry-run --quick
"$scree" sweep forms.yaml --dry-run --quick | grep -q 'count=70' && complain "full_set in the quick form"
"$scree" sweep forms.yaml --dry-run | grep -q 'count=50' && complain "quick_set in the full form"
sed 's/, names: .a, b.//' quick.yaml >wrong.yaml
expect 2 "'quick_values' need" "$scree" sweep wrong.yaml --dry-run
sed 's/^curves.*/relations: [{x: steps, y: peak_stress}]/' tiny.yaml >wrong.yaml
expect 2 "'peak_stress' is none of the measures" "$scree" sweep wrong.yaml --dry-run

# --- more realisations beside those that are there
expect 0 '4 of 6 members are done' "$scree" sweep tiny.yaml -o one --realisations 3 --no-figures
same "$(grep -c ',done,' one/members.csv)" 6
expect 0 '2 folders .*do not belong to this sweep' "$scree" sweep tiny.yaml -o one --collect --no-figures

# --- another case is not mixed in
expect 2 'holds a run of another case.*--force' "$scree" sweep tiny.yaml -o one --set measure.samples=90
expect 0 'means in' "$scree" sweep tiny.yaml -o one --set measure.samples=90 --force --no-figures
grep -q "samples: 90" one/members/000-friction=0.2-seed=1/case.yaml || complain "--force did not run the other case"
expect 2 'holds a run' "$scree" sweep tiny.yaml -o s/members/000-friction=0.2-seed=1

# --- failed members: the others are run, the status says so, and only --retry runs them again
cat >failing.yaml <<'END'
name: failing
case: biaxial
quick: yes
set: {particles.count: 40, stages.compress.strain: 1 %, stages.compress.rate: 0.5 1/s, measure.windows: [], output.paraview: no,
  stages.confine.friction: 0.4, integrator.step: 4e-5 s}
vary:
  - name: guard
    alternatives:
      - {name: strict, set: {guard.overlap: 1e-9 %}}
      - {name: usual}
measures: [steps, restitution]
END
expect 3 '000-strict-seed=1: failed \(exit status 3\): .*' "$scree" sweep failing.yaml -o f --no-figures
grep -q '1 of 2 members have failed' <<<"$output" || complain "no word of the failure: $output"
grep -q "none of the 1 members that are done has a value of 'restitution'" <<<"$output" || complain "no word of the measure that nobody has: $output"
sed 's/restitution/stepps/' failing.yaml >wrong.yaml
expect 2 "^wrong.yaml:11:19: measures.1: no run has a result 'stepps'; did you mean 'steps'?" "$scree" sweep wrong.yaml -o never
sed 's/restitution/drum_work/' failing.yaml >wrong.yaml
expect 2 "^wrong.yaml:11:19: measures.1: nothing in the cases is called so, and no run has a result 'drum_work'" "$scree" sweep wrong.yaml -o never
sed 's/restitution/state_checksum/' failing.yaml >wrong.yaml
expect 2 "^wrong.yaml:11:19: measures.1: a text has no mean: 'state_checksum'" "$scree" sweep wrong.yaml -o never
[ -e never ] && complain "a refused sweep left a folder"
same "$(cut -d, -f6,7 f/members.csv | sed 's/,.*//' | tail -2 | tr '\n' ' ')" 'strict usual '
grep -q '^0,.*,failed,' f/members.csv || complain "members.csv does not have the failed member"
head -1 f/table.csv | grep -q 'steps.n,steps.of' || complain "table.csv does not say of how many"
grep -q '^0,strict,strict,nan,nan,nan,nan,0,1,' f/table.csv || complain "table.csv hides the failed member: $(cat f/table.csv)"
grep -q '^1,usual,usual,[0-9]' f/table.csv || complain "table.csv does not have the mean of the others"
touch stamp
expect 3 '1 of 2 members are done, 1 have failed, 0 to run' "$scree" sweep failing.yaml -o f --no-figures
[ -n "$(find f/members -name log.txt -newer stamp)" ] && complain "a failed member was run without --retry"
expect 3 'failed' "$scree" sweep failing.yaml -o f --no-figures --retry
[ -n "$(find f/members -name log.txt -newer stamp)" ] || complain "--retry ran nothing"
expect 3 'has failed' "$scree" sweep failing.yaml -o f --member 0

# --- a member that is killed fails by itself; an interrupt stops all with checkpoints, and the same call goes on
long=(--set 'stages.compress.strain=4 %' --set 'stages.compress.rate=1e-2 1/s' --no-figures)
expect 0 '' "$scree" sweep tiny.yaml -o whole -q "${long[@]}"
# Ctrl-C goes to all processes of the terminal's group, here that of a session of its own.
setsid "$scree" sweep tiny.yaml -o cut --jobs 2 "${long[@]}" 2>cut.txt &
pid=$!
wait_for 'confine ended' cut/members/001-friction=0.5-seed=1/log.txt
kill -INT -- -$pid
wait $pid 2>/dev/null
same $? 130 "status of an interrupted sweep"
grep -q 'interrupted with [0-3] of 4 members done; the same command goes on' cut.txt || complain "after the interrupt: $(cat cut.txt)"
grep -q 'interrupted at step' cut/members/*.txt || complain "no member stopped after a checkpoint"
pgrep -f "$scratch/cut/members" >/dev/null && complain "a member goes on after the interrupt"
expect 0 'means in' "$scree" sweep tiny.yaml -o cut "${long[@]}"
grep -q 'restarted' cut/members/*/log.txt || complain "the interrupted member was not continued"
same "$(sums cut)" "$(sums whole)" "checksums after an interrupt"
grep -q '"sweep": "tiny"' cut/sweep.json || complain "a report would not know the members of an interrupted sweep"
# One that dies with the sweep is continued too.
rm -r cut
"$scree" sweep tiny.yaml -o cut --jobs 1 "${long[@]}" 2>/dev/null &
pid=$!
wait_for 'confine ended' cut/members/000-friction=0.2-seed=1/log.txt
kill -KILL $pid
wait $pid 2>/dev/null
wait_for 'interrupted at step' cut/members/000-friction=0.2-seed=1.txt # its process was asked to stop
sleep 0.2
expect 0 'means in' "$scree" sweep tiny.yaml -o cut "${long[@]}"
same "$(sums cut)" "$(sums whole)" "checksums after the sweep was killed"

# --- a job array: the script runs one member, and collecting comes after
expect 0 'sbatch array.sh' "$scree" sweep tiny.yaml -o array --no-figures --slurm array.sh
grep -q '^#SBATCH --array=0-3$' array.sh || complain "array.sh: $(cat array.sh)"
[ -e array ] && complain "--slurm ran something"
for k in 0 1 2 3; do SLURM_ARRAY_TASK_ID=$k bash array.sh 2>/dev/null || complain "task $k"; done
[ -e array/table.csv ] && complain "a task collected"
expect 0 'means in array' "$scree" sweep tiny.yaml -o array --no-figures --collect
same "$(sums array)" "$(sums s)" "checksums of the job array"

# --- the report: statements that nothing was run for, and one that something was
expect 0 'Findings: \*\*0 agree, 0 differ, 0 are undecided\*\*, 0 were not measured, [0-9]+ were not run' "$scree" report s
expect 0 '' "$scree" report s -o page.md
"$scree" report s | cmp -s - page.md || complain "the page is not the same each time"
# Members of a sweep stand for a published case when they have its name.
sed 's/^name: tiny/name: triaxial/' tiny.yaml | sed '/^vary/,$d' >triaxial.yaml
expect 0 '' "$scree" sweep triaxial.yaml -o pages/triaxial -q --no-figures
expect 0 '^\| triaxial-dilation .*\| \*\*(agrees|differs|undecided)\*\* \| quick \|' "$scree" report pages
expect 0 '^\| triaxial \| quick \| 1, 2 \| 0, 0 \| [^|]+ \| 0.4 \| 0\.[0-9]+ - 0\.[0-9]+ \| ' "$scree" report pages
sed 's/^name: triaxial/name: rotation-length/' triaxial.yaml >rotation-length.yaml
expect 0 '' "$scree" sweep rotation-length.yaml -o pages/rotation-length -q --no-figures
expect 0 "^\| rotation-reach .* \| - \| .* \| \*\*not measured\*\* \| quick \| no result 'rotation_reach'" "$scree" report pages
expect 0 '^\| triaxial-dilation .*\| 2 of 2 \|' "$scree" report pages/triaxial
expect 4 'cannot read the folder' "$scree" report nowhere

# --- reproduce: what has no case is not available, and the page is written all the same
expect 2 'there is no built-in sweep of this name' "$scree" reproduce --only nothing
expect 0 'biaxial-timescales ' "$scree" list --sweeps
# Quick forms that judge nothing are left out (nothing is run into a folder that cannot be), unless they are asked for.
expect 4 '^rotation-velocity: left out: it judges nothing in the quick form; --only rotation-velocity runs it$' "$scree" reproduce -o /dev/null/x
grep -q '^--- rotation-velocity$' <<<"$output" && complain "what judges nothing is run"
grep -q '^--- rotation-length$' <<<"$output" || complain "what judges something is left out"
expect 4 '^--- rotation-velocity$' "$scree" reproduce -o /dev/null/x --only rotation-velocity
expect 4 '^--- rotation-velocity$' "$scree" reproduce --full -o /dev/null/x
grep -q 'left out' <<<"$output" && complain "a full form is left out"
finish ""
