#!/usr/bin/env bash
# Runs that go on behind a stage of another run: the bits and rows of a run from the begin, what is refused, and sweeps
# whose members share a sample.
# shellcheck source=tests/cli/check.sh
. "$(dirname "$0")/check.sh"

"$scree" new biaxial | sed '/^quick:/,$d; s/strain: 12 %/strain: 0.5 %/; s|rate: 1e-2 1/s|rate: 1e-1 1/s|; s/count: 2000/count: 60/
    s/windows: .*/windows: []/; s/samples: 400/samples: 10/; s/paraview: yes/paraview: no/; s/unbalanced_limit: 1e-3/unbalanced_limit: 1e-2/' >first.yaml
{ sed '/^measure:/,$d' first.yaml; printf '  - {stage: compress, name: further, strain: 0.5 %%, rate: 2e-1 1/s, friction: 0.2}\n'
    sed -n '/^measure:/,$p' first.yaml; } >longer.yaml
run() { "$scree" run "$@" -q --no-figures >/dev/null 2>&1 || complain "scree run $* failed"; }
snapshots() { "$scree" check "$1" | grep -c '^[^ ]* *snapshot\|snapshot [0-9]'; }

run first.yaml -o first
run longer.yaml -o whole
run longer.yaml --after first -o behind
for result in state_checksum snapshot_count time peak_stress_ratio; do
    "$scree" get whole $result >/dev/null 2>&1 && same "$("$scree" get behind $result)" "$("$scree" get whole $result)" $result
done
same "$(md5sum <behind/series.csv)" "$(md5sum <whole/series.csv)" "rows"
same "$(snapshots behind)" "$(snapshots whole)" snapshots
expect 0 'behind stage compress of first' head -1 behind/log.txt
# from an earlier stage, where a later one differs
run first.yaml --after whole -o confined --set stages.compress.friction=0.1
run first.yaml -o alone --set stages.compress.friction=0.1
same "$("$scree" get confined state_checksum)" "$("$scree" get alone state_checksum)" "behind confine"
expect 0 'behind stage confine of whole .stages.2.friction differs' head -1 confined/log.txt
# goes on after a kill like any run
run --restart behind --from latest
same "$("$scree" get behind state_checksum)" "$("$scree" get whole state_checksum)" "restarted"

# behind a sample without a loading of its own, found by a search
sed '/stage: compress/,/^measure:/{/^measure:/!d}' first.yaml >sample.yaml
grep -q 'stage: compress' sample.yaml && complain "the sample is loaded"
search=$("$scree" bisect sample.yaml -q --no-figures -o find --key stages.confine.friction --from 0.05 --to 0.4 --measure coordination \
    --target 3.6 --tolerance 0.05 2>/dev/null) || complain "no search: $search"
rest=$(sed -n 's/^scree run CASE //p' <<<"$search")
# shellcheck disable=SC2086 # words
run first.yaml $rest -o found
expect 0 'behind stage confine of find/runs/' head -1 found/log.txt

before=$(md5sum first/run.h5)
expect 2 "'first' holds the run to go on behind" "$scree" run longer.yaml --after first -o first --force
expect 2 'the case has no stage behind those' "$scree" run first.yaml --after first -o other
expect 2 'is one of another sample: seed differs; only stages' "$scree" run longer.yaml --set seed=9 --after first -o other
expect 2 'particles.count differs' "$scree" run longer.yaml --set particles.count=61 --after first -o other
expect 2 'reference_velocity comes out as .* give contact.reference_velocity' \
    "$scree" run longer.yaml --set stages.further.rate=4e-1 --set stages.compress.rate=0.2 --after first -o other
expect 2 'nothing/case.yaml' "$scree" run longer.yaml --after nothing -o other
expect 2 'restart.*--after does not go with it' "$scree" run --restart first --after first
same "$(md5sum first/run.h5)" "$before" "the first run"
[ -e other ] && complain "a folder of a run that was refused"

# --- a sweep
cat >sweep.yaml <<'END'
name: shared
case: first.yaml
realisations: 2
share: confine
vary: [{key: stages.compress.friction, values: [0.1, 0.3]}]
measures: [time]
END
expect 0 '' "$scree" sweep sweep.yaml -o shared -q --no-figures --jobs 2
sed '/share/d' sweep.yaml >plain.yaml
expect 0 '' "$scree" sweep plain.yaml -o plain -q --no-figures --jobs 2
for member in plain/members/*/; do
    same "$("$scree" get "shared/${member#plain/}" state_checksum)" "$("$scree" get "$member" state_checksum)" "$member"
done
same "$(grep -l 'behind stage confine' shared/members/*/log.txt | wc -l)" 2 "members that share a sample"
# one member alone takes the sample that is there
rm -r shared/members/003*
expect 0 '' "$scree" sweep sweep.yaml -o shared -q --no-figures --member 3
expect 0 'behind stage confine of .*002' head -1 shared/members/003*/log.txt
sed 's/share: confine/share: confined/' sweep.yaml >wrong.yaml
expect 2 "wrong.yaml:4:8: share: the case has no stage 'confined' .accepted: confine" "$scree" sweep wrong.yaml -o other
sed 's/share: confine/share: compress/' sweep.yaml >wrong.yaml
expect 2 "no stage comes behind 'compress'" "$scree" sweep wrong.yaml -o other
finish
