#!/usr/bin/env bash
# scree bisect, and sweeps whose members search: a limit is found by runs, a search goes on where it was interrupted, what is wrong is refused at its place.
# shellcheck source=tests/cli/check.sh
. "$(dirname "$0")/check.sh"
holds() {
    checks=$((checks + 1))
    awk "BEGIN { exit !($1) }" || complain "not so: $1"
}

# A row of four discs in line.
cat >row.yaml <<'END'
name: row
materials: [{name: steel, young_modulus: 200 GPa, poisson_ratio: 0.35, density: 2000 kg/m3, friction: 0, normal_stiffness: 7e10 N/m, stiffness_ratio: 0, damping_ratio: 0}]
particles: {shape: disc, material: steel, count: 4, distribution: equal, radius: 1 mm, thickness: 1 m}
contact: {law: linear}
integrator: {step: 100 ns}
selections: [{select: layer, name: right, axis: x, end: high}]
loads: [{load: prescribed, selection: right, force_x: {from: 0 N, to: 1 kN, begin: 0 s, end: 10 us}}]
stages:
  - {stage: prepare, method: square, width: 2 mm}
  - {stage: bond, gap_tolerance: 1 um}
  - {stage: relax, duration: 200 us, boundary: none}
measure: {cells: no, stability: yes}
output: {paraview: no, snapshots: 0}
END
sed -i 's/width: 2 mm/width: 8 mm/' row.yaml

# --- the limit by runs is that of the operator: 2 / w, w^2 = (2 + sqrt 2) k / m for four in a row
search=(bisect row.yaml --key integrator.step --from 200ns --to 500ns --measure kinetic --below 1 --above=-1)
expect 0 '^integrator.step: stands at 3\.' "$scree" "${search[@]}" -o step --tolerance 0.005 --quiet
limit=$("$scree" get step limit) told=$("$scree" get step limit_step)
holds "($limit / $told - 1)^2 < 0.005^2"
exact=$(awk 'BEGIN { m = 2000 * 3.14159265358979 * 1e-6; print 2 / sqrt((2 + sqrt(2)) * 7e10 / m) }')
holds "($told / $exact - 1)^2 < 1e-6^2"
# --- a target: the friction that confines to a solid fraction, and a test that begins there
"$scree" new biaxial | sed '/^quick:/,$d; /stage: compress/,/rate:/d; s/count: 2000/count: 60/; s/windows: .*/windows: []/
    s/paraview: yes/paraview: no/; s/unbalanced_limit: 1e-3/unbalanced_limit: 1e-2/' >confine.yaml
target=(bisect confine.yaml --key stages.confine.friction --from 0.01 --to 0.5 --measure solid_fraction --quiet --no-figures)
expect 0 '^scree run CASE --set stages.confine.friction=0[.][0-9]* --after find/runs/' "$scree" "${target[@]}" --target 0.83 --tolerance 0.003 -o find
holds "($("$scree" get find solid_fraction) / 0.83 - 1)^2 <= 0.003^2"
nearest=$(printf 'find/runs/%02d' "$("$scree" get find limit_nearest)")
same "$("$scree" get "$nearest" solid_fraction)" "$("$scree" get find solid_fraction)" 'results are those of the nearest run'
same "$("$scree" get "$nearest" confine_friction)" "$("$scree" get find limit)" 'and so is the value'
expect 2 'is 0.8.* at the ends, .*: 0.95 is not between them' "$scree" "${target[@]}" --target 0.95 -o far
expect 2 'target: a target goes without bounds' "$scree" "${target[@]}" --target 0.83 --below 1 -o bad
holds "$("$scree" get step limit_stands) < $limit && $limit < $("$scree" get step limit_fails)"
same "$(tail -n +2 step/bisection.csv | wc -l)" "$("$scree" get step limit_runs)" 'a row for each run'
same "$("$scree" get step status)" done
"$scree" "${search[@]}" -o step --tolerance 0.005 --quiet --curve kinetic >curve.txt 2>&1
[ -s step/figures/runs.svg ] || complain "no figure of the runs: $(cat curve.txt)"
expect 2 'no column .kinetics.' "$scree" "${search[@]}" --curve kinetics -o bad --quiet

# --- what is there is not run again; half of it is continued
before=$(cd step && find runs -name summary.json -exec md5sum {} + | sort)
expect 0 '^integrator.step: stands at 3\.' "$scree" "${search[@]}" -o step --tolerance 0.005 --quiet
same "$(cd step && find runs -name summary.json -exec md5sum {} + | sort)" "$before" 'runs of a search that is over'
rm -r step/runs/05
expect 0 '^integrator.step: stands at 3\.' "$scree" "${search[@]}" -o step --tolerance 0.005 --quiet
same "$("$scree" get step limit)" "$limit" 'the limit of a search that went on'
expect 2 'holds another case' "$scree" "${search[@]}" -o step --set particles.count=3 --quiet

# --- refused
expect 2 'stand at both ends' "$scree" "${search[@]}" --from 100ns --to 110ns -o both --quiet
expect 2 'no run has a number .speed.' "$scree" "${search[@]}" --measure speed -o bad --quiet
expect 2 'is no number: only between numbers' "$scree" "${search[@]}" --key contact.law -o bad --quiet
expect 2 "'2 kg'" "$scree" "${search[@]}" --to '2 kg' -o bad --quiet
expect 2 'has to be' "$scree" bisect row.yaml --key integrator.step --from 1ns --to 2ns --measure kinetic -o bad --quiet
expect 2 'this option is missing' "$scree" bisect row.yaml --from 1ns --to 2ns --measure kinetic --below 1 -o bad --quiet
[ -e bad ] && complain 'a search that was refused has left a folder'

# --- a step above the estimated critical one: refused, and run with a warning
expect 2 'guard.stability: warn' "$scree" run row.yaml -o over --set integrator.step=350ns --quiet
expect 0 'above the estimated critical one' "$scree" run row.yaml -o over --set integrator.step=300ns --set guard.stability=warn --no-figures

# --- a sweep of searches
cat >sweep.yaml <<'END'
name: steps
case: row.yaml
vary: [{key: materials.steel.density, values: [2000, 8000]}]
bisect: {key: integrator.step, between: [200 ns, 1 us], tolerance: 2 %, measure: kinetic, below: 1, above: -1}
measures: [limit, limit_step]
END
expect 0 '^000-.*scree bisect row.yaml .*--key integrator.step --from .200 ns. --to .1 us.' "$scree" sweep sweep.yaml -n
expect 0 '' "$scree" sweep sweep.yaml -o sweep --quiet --jobs 1
# Four times the mass, twice the step.
holds "$(awk -F, 'NR == 2 { a = $4 } NR == 3 { print ($4 / a / 2 - 1)^2 < 0.02^2 }' <(cut -d, -f1-4 sweep/table.csv))"
sed 's/measure: kinetic/measure: speed/' sweep.yaml >bad.yaml
expect 2 'bad.yaml:4:.*bisect.measure' "$scree" sweep bad.yaml -n
sed 's/key: integrator.step/key: contact.law/' sweep.yaml >bad.yaml
expect 2 'bad.yaml:4:.*bisect.key' "$scree" sweep bad.yaml -n
sed 's/\[200 ns, 1 us\]/[200 ns]/' sweep.yaml >bad.yaml
expect 2 'bad.yaml:4:.*bisect.between' "$scree" sweep bad.yaml -n
finish
