#!/usr/bin/env bash
# scree report on made-up runs: which row counts, what the headline counts, several sources, and wrong tables.
# shellcheck source=tests/cli/check.sh
. "$(dirname "$0")/check.sh"

# sweep FOLDER NAME QUICK POINT: its members from lines "seed status solid build value" on standard input.
sweep() {
    local folder=$1 name=$2 quick=$3 point=$4 members='' comma='' seed status solid build value
    mkdir -p "$folder"
    while read -r seed status solid build value; do
        members="$members$comma{\"folder\": \"$seed\", \"point\": 0, \"seed\": $seed, \"status\": \"$status\"}"
        comma=', '
        [ "$status" = done ] || continue
        mkdir -p "$folder/members/$seed"
        echo "{\"status\": \"done\", \"commit\": \"$build\", \"particles\": 9, \"confine_friction\": 0.2, \"coordination_at_start\": 3.5," \
            "\"solid_fraction_at_start\": $solid, \"r\": $value}" >"$folder/members/$seed/summary.json"
    done
    echo "{\"sweep\": \"$name\", \"quick\": $quick, \"points\": [{\"name\": \"$point\"}], \"members\": [$members]}" >"$folder/sweep.json"
}
row() { grep -E "^\| $1 " page.md; }

sweep runs/full mine false '' <<'END'
1 done 0.81 aaa 2.0
2 done 0.82 aaa 2.1
3 failed 0 x 0
4 done 0.83 bbb 2.2
5 missing 0 x 0
END
sweep runs/quick mine true '' <<'END'
1 done 0.81 aaa 1.0
2 done 0.82 aaa 1.1
END
cat >mine.yaml <<'END'
# My source
source: "Mine (Q)"
cases:
  - case: mine
    meaning: What it is.
    statements:
      - {id: large, statement: "It is | large", source: Q 1, given: above 1, value: mine.r, criterion: greater than 1, kind: finding}
      - {id: huge, statement: It is huge, source: Q 2, given: above 9, value: mine.r, criterion: greater than 9, kind: finding,
         explanation: It is not.}
      - {id: ours, statement: It is there, source: ours, given: 2, value: mine.r, criterion: within 50 %, kind: check}
      - {id: more, statement: It is new, source: ours, given: x, value: mine.r, criterion: less than 2.1, kind: beyond, form: full,
         reason: because.}
      - {id: other, statement: It is not there, source: Q 3, given: x, value: mine.other, criterion: less than 2, kind: finding}
END
# A name that no run has is misspelt, or this table is about another program.
expect 2 "mine.yaml:13:[0-9]+: other: there is no result 'other'" "$scree" report runs --statements mine.yaml
sed -i '/id: other/d' mine.yaml
expect 0 '' "$scree" report runs --statements mine.yaml -o page.md
# 2.1 with deviation 0.1: 4.3027 x 0.1 / sqrt 3 = 0.2484; 90 %: 2.92 x 0.1 / sqrt 3 = 0.1686.
row large | head -1 | grep -qF '| finding | It is \| large | Q 1 | above 1 | greater than 1 | 2.1 [1.852, 2.348] | 3 of 5 | **agrees** | full | builds differ: aaa, bbb; 1 failed |' ||
    complain "full form: $(row large)"
row large | tail -1 | grep -qF '|  |  |  |  |  | 1.05 [0.4147, 1.685] | 2 of 2 | (undecided) | quick |  |' || complain "quick form: $(row large)"
row ours | head -1 | grep -qF '2.1 [1.931, 2.269] | 3 of 5 | **agrees** | full' || complain "90 %: $(row ours)"
same "$(row more | wc -l)" 1 "rows of a statement about the full form"
grep -qF -- '- huge: It is not.' page.md || complain "no explanation"
grep -qF -- '- more, full form only: because.' page.md || complain "no reason"
grep -qF 'Mine (Q). Findings: **1 agree, 1 differ, 0 are undecided**, 0 were not measured, 0 were not run. Own checks: 1 agree,' page.md ||
    complain "headline: $(grep Findings page.md)"
grep -qF 'Beyond the source: 0 agree, 0 differ, 1 undecided,' page.md || complain "headline: $(grep Findings page.md)"
grep -qF '| mine | full | 1, 2, 4 | 1, 1 | aaa, bbb | 0.2 | 0.81 - 0.83 | 3.5 |' page.md || complain "runs: $(grep '| mine ' page.md)"
# The page is read back: what it has of more realisations than the folders hold stays, byte for byte, and is counted.
cp page.md whole.md
expect 0 '1 cases stay as page.md had them' "$scree" report runs/quick --statements mine.yaml -o page.md
cmp -s page.md whole.md || complain "a page changed without its runs: $(diff page.md whole.md)"
expect 0 '' "$scree" report runs --statements mine.yaml -o page.md
cmp -s page.md whole.md || complain "the same page is not written twice: $(diff page.md whole.md)"
# Words of the table that have changed are told beside rows that stay, and a statement that it has no more is gone.
sed 's/It is not\./It is smaller./; s/What it is\./What else it is./; /id: ours/d' mine.yaml >other.yaml
expect 0 '' "$scree" report runs/quick --statements other.yaml -o page.md
grep -qF -- '- huge: It is smaller.' page.md || complain "an explanation stays: $(grep -- '- huge' page.md)"
grep -qF 'What else it is.' page.md || complain "the words on a case stay: $(grep 'What ' page.md)"
same "$(row ours | wc -l)" 0 "rows of a statement that the table has no more"
same "$(grep -E '^\| (large|huge|more) ' page.md)" "$(grep -E '^\| (large|huge|more) ' whole.md)" "rows beside other words"
for change in 's/It is not\./It is smaller./' 's/What it is\./What else it is./' '/id: ours/d'; do
    cp whole.md page.md
    sed "$change" mine.yaml >other.yaml
    expect 0 '' "$scree" report runs/quick --statements other.yaml -o page.md
    grep -F -- "$(grep -oE 'It is not|What it is|ours' <<<"$change" | head -1)" page.md | grep -E '^- huge|^What|^. ours ' &&
        complain "words or rows stay behind $change"
done
cp whole.md page.md
sed 's/greater than 9/greater than 8/' mine.yaml >other.yaml
expect 0 '' "$scree" report runs/quick --statements other.yaml -o page.md
# A statement with another criterion has what the folders hold, the others their rows, with the runs that these are of.
row huge | grep -qF '| greater than 8 | 1.05 [0.4147, 1.685] | 2 of 2 | **differs** | quick |' || complain "another criterion: $(row huge)"
same "$(row huge | wc -l)" 1 "rows of a statement with another criterion"
same "$(grep -E '^\| (large|ours|more) ' page.md)" "$(grep -E '^\| (large|ours|more) ' whole.md)" "rows that stay"
same "$(grep '^| mine ' page.md | sort)" "$(grep '^| mine ' whole.md | sort)" "runs of rows that stay"
grep -qF 'Full form: `scree reproduce' page.md && complain "a sweep that is not built in has no command"
grep -qF 'Mine (Q). Findings: **1 agree, 1 differ, 0 are undecided**' page.md || complain "headline of rows that stay: $(grep Findings page.md)"
grep -qF -- '- more, full form only: because.' page.md || complain "no note of a row that stays"
cp page.md mixed.md
expect 0 '1 cases stay' "$scree" report runs/quick --statements other.yaml -o page.md
cmp -s page.md mixed.md || complain "a page of old and new rows changes when it is written again: $(diff page.md mixed.md)"
# Of the same form fewer runs than on the page: both are told, those of the rows that stay and those of the new one.
sweep runs/few mine true '' <<'END'
2 done 0.82 aaa 1.1
END
rm page.md
expect 0 '' "$scree" report runs/quick --statements mine.yaml -o page.md
expect 0 '' "$scree" report runs/few --statements other.yaml -o page.md
row huge | grep -qF '| 1.1 | 1 of 1 |' || complain "a new statement: $(row huge)"
row large | grep -qF '| 2 of 2 |' || complain "a row that stays: $(row large)"
same "$(grep '^| mine |' page.md | cut -d'|' -f4 | tr -d '\n')" ' 2  1, 2 ' "runs of fewer and of more seeds"
rm page.md
# Without the full form the quick one counts, and full runs weigh more than any number of quick ones.
expect 0 '' "$scree" report runs/quick --statements mine.yaml -o page.md
row large | grep -qF '| **undecided** | quick |' || complain "quick form alone: $(row large)"
row more | grep -qF '| **not run** | full |' || complain "no full form: $(row more)"
expect 0 '' "$scree" report runs/full --statements mine.yaml -o page.md
row large | grep -qF '| **agrees** | full |' || complain "full form after the quick one: $(row large)"
expect 0 '1 cases stay' "$scree" report runs/quick --statements mine.yaml -o page.md
row large | grep -qF '| **agrees** | full |' || complain "quick form after the full one: $(row large)"
# One run decides nothing: the quick form counts, which has an interval.
sweep runs/one/full mine false '' <<'END'
1 done 0.81 aaa 2.0
END
cp -r runs/quick runs/one/
rm page.md
expect 0 '' "$scree" report runs/one --statements mine.yaml -o page.md
row large | head -1 | grep -qF '| 2 | 1 of 1 | (undecided) | full |' || complain "one full run: $(row large)"
row large | tail -1 | grep -qF '| 1.05 [0.4147, 1.685] | 2 of 2 | **undecided** | quick |' || complain "two quick runs: $(row large)"
row more | grep -qF '| 2 | 1 of 1 | **undecided** | full |' || complain "one run of the only form: $(row more)"
# Nor does it take the place of quick runs whose folders are gone.
rm page.md
expect 0 '' "$scree" report runs/quick --statements mine.yaml -o page.md
expect 0 '' "$scree" report runs/one/full --statements mine.yaml -o page.md
row large | grep -qF '| 1.05 [0.4147, 1.685] | 2 of 2 | **undecided** | quick |' || complain "one full run in place of two quick ones: $(row large)"
row more | grep -qF '| 2 | 1 of 1 | **undecided** | full |' || complain "one run of the only form, beside rows that stay: $(row more)"
rm -r runs/one
# What runs say of themselves: some are not quasistatic, one failed, and why.
sweep runs/own mine false '' <<'END'
1 done 0.81 aaa 2.0
2 done 0.82 aaa 2.1
3 failed 0 x 0
4 done 0.83 aaa 2.2
5 failed 0 x 0
END
for seed in 1 4; do
    sed -i "s/\"r\":/\"kinetic_over_elastic\": 0.$seed, \"quasistatic\": \"no\", \"quasistatic_reason\": \"stage 2 (compress): 0.$seed, above | 0.1\", &/" \
        runs/own/members/$seed/summary.json
done
sed -i 's/"r":/"kinetic_over_elastic": 0.01, "quasistatic": "yes", "quasistatic_reason": "every stage keeps its limits", &/' runs/own/members/2/summary.json
printf '%s\n' 'warning: it goes slowly' 'scree run: step 7: particle 3 overlaps by 12 %; use a smaller step' 'scree sweep: failed: exit status 3' >runs/own/members/3.txt
rm page.md
expect 0 '' "$scree" report runs/own --statements mine.yaml -o page.md
grep '^| mine |' page.md | grep -qF '| 3.5 | not quasistatic by their own account: 2 of 3, the worst: stage 2 (compress): 0.4, above \| 0.1; seed 3 failed: step 7: particle 3 overlaps by 12 %; seed 5 failed: its log is not there |' ||
    complain "what runs say of themselves: $(grep '^| mine |' page.md)"
row large | grep -qF '| not quasistatic by their own account: 2 of 3 runs; 2 failed |' || complain "remark of the row: $(row large)"
# A page that stays keeps it.
cp page.md own.md
expect 0 '1 cases stay' "$scree" report runs/quick --statements mine.yaml -o page.md
cmp -s page.md own.md || complain "remarks of a page that stays: $(diff page.md own.md)"
# Runs beside the built-in sweep of their name: of its seeds and case, of other ones, of another preparation.
made() { # FOLDER NAME POINT SEED KEY=VALUE...: a member with the case that the sweep would have but for these
    local into=$1/members/$4 set=() pair
    for pair in "${@:5}" "seed=$4"; do set+=(--set "$pair"); done
    sweep "$1" "$2" false "$3" <<<"$4 done 0.81 aaa 2.0"
    "$scree" check biaxial-boundaries "${set[@]}" >"$into/case.yaml"
}
cat >built.yaml <<'END'
source: "Mine (Q)"
cases:
  - case: biaxial-boundaries
    meaning: What it is.
    statements:
      - {id: large, statement: s, source: Q 1, given: above 1, value: biaxial-boundaries/pressure.r, criterion: greater than 1, kind: finding}
END
told() { # REMARK OF THE ROW: what both tables say of runs/built
    rm -f page.md
    expect 0 '' "$scree" report runs/built --statements built.yaml -o page.md
    grep '^| biaxial-boundaries/' page.md | grep -qF "| 3.5 | $1 |" || complain "not '$1': $(grep '^| biaxial-boundaries/' page.md)"
    row large | grep -qF "| one sample: no interval$2 |" || complain "not '$2': $(row large)"
}
made runs/built biaxial-boundaries pressure 306
told '' ''
made runs/built biaxial-boundaries pressure 101
told 'seeds are not those of the sweep now (from 306 on)' '; seeds are not those of the sweep now'
sed 's/ *| seeds are not.*$/ | /; s/ | remark |$/ |/' page.md >older.md
made runs/built biaxial-boundaries pressure 306 stages.confine.friction=0.05
told 'of another preparation than the case has now (stages.1.friction)' '; of another preparation than the case has now'
made runs/built biaxial-boundaries pressure 306 stages.compress.rate='1e-3 1/s'
told 'of another setting than the case has now (stages.2.rate)' '; of another setting than the case has now'
# A preparation counts before anything else that differs.
made runs/built biaxial-boundaries pressure 306 contact.damping_time='3 ms' stages.confine.friction=0.05
told 'of another preparation than the case has now (stages.1.friction)' '; of another preparation than the case has now'
# Runs that are gone have left their seeds, on a page without such remarks too.
mkdir -p nothing
cp older.md page.md
expect 0 '1 cases stay' "$scree" report nothing --statements built.yaml -o page.md
grep '^| biaxial-boundaries/' page.md | grep -qF '| 3.5 | seeds are not those of the sweep now (from 306 on) |' || complain "seeds of a page: $(grep '^| biaxial-boundaries/' page.md)"
grep -qE '^\| runs .* \| remark \|$' page.md || complain "the head of a table that stays: $(grep '^| runs ' page.md)"
cp page.md older.md
expect 0 '1 cases stay' "$scree" report nothing --statements built.yaml -o page.md
cmp -s page.md older.md || complain "the same remark is not written twice: $(diff page.md older.md)"
rm -r runs/own runs/built page.md
# Several sources; what is built in stays as it is.
expect 0 '' "$scree" report runs -s mine.yaml --statements padbidri2010 -o page.md
same "$(grep -c '^## ' page.md)" 2 "sources on the page"
same "$(grep -c 'Findings: ' page.md)" 2 "headlines"

# Wrong tables: place and nearest right name; the page stays as it was.
wrong() {
    sed "$1" mine.yaml >wrong.yaml
    expect 2 "^wrong.yaml:$2" "$scree" report runs -s wrong.yaml -o page.md
}
cp page.md before.md
wrong 's/kind: check/kind: chek/' "10:[0-9]+: cases.0.statements.2.kind: .*did you mean 'check'"
all_forms='.accepted: within 10 %, equivalent within 0.5, greater than 2, less than 3, between 2 and 4, holds.'
wrong 's/greater than 9/greatr than 9/' "8:[0-9]+: huge: there is no criterion 'greatr than 9'; did you mean 'greater than 9'. $all_forms"
wrong 's/greater than 9/at least 9/' "8:[0-9]+: huge: there is no criterion 'at least 9' $all_forms"
wrong 's/greater than 9/greater than nine/' "8:[0-9]+: huge: 'greater than nine' is not a criterion, expected behind 'greater than': one number without unit"
wrong 's/greater than 9/between 9 and 8/' "8:[0-9]+: huge: .* expected behind 'between': two numbers, the lower one first"
wrong 's/given: 2, value/given: two, value/' "10:[0-9]+: ours: 'within' needs a number in 'given', not 'two'"
wrong 's/case: mine/case: mien/' "4:11: case: there is no sweep or case 'mien'; did you mean 'mine'"
wrong 's/value: mine.r, criterion: within/value: mine\/III.r, criterion: within/' "10:[0-9]+: ours: there is no point 'III'"
wrong 's/reason: because/unit: m/' "11:[0-9]+: more: 'form' needs a 'reason'"
cmp -s page.md before.md || complain "a wrong table changed the page"
expect 2 '^nothing.yaml: there is no file and no built-in table of statements of this name .accepted: .*padbidri2010' "$scree" report runs -s nothing.yaml
expect 2 '^padbidri201: there is no file and no built-in table of statements of this name .accepted: padbidri2010.$' "$scree" report runs -s padbidri201

# Averages over members: intervals of files, of differences and quotients of different ensembles, of one and the same.
average() { # FOLDER POINT RUNS RESULT VALUE LOW HIGH
    mkdir -p "$1/ensemble/$2"
    echo "{\"runs\": $3, \"$4\": $5, \"$4_low\": $6, \"$4_high\": $7, \"$4_p\": 0.03, \"runs_high\": null}" >"$1/ensemble/$2/summary.json"
}
for point in one two; do
    sweep ens/$point pair false $point <<'END'
1 done 0.81 aaa 2.0
2 done 0.82 aaa 2.0
3 done 0.83 aaa 2.0
4 done 0.84 aaa 2.0
5 done 0.85 aaa 2.0
6 done 0.86 aaa 2.0
END
done
average ens/one one 6 dip 0.5 0.46 0.53
average ens/two two 6 dip 0.2 0.16 0.24
cat >ens.yaml <<'END'
source: "Mine (Q)"
cases:
  - case: pair
    meaning: What it is.
    statements:
      - {id: single, statement: s, source: Q, given: 1, value: pair/one.ensemble_dip, criterion: greater than 0.4, kind: finding}
      - {id: apart, statement: s, source: Q, given: 1, value: pair/one.ensemble_dip - pair/two.ensemble_dip, criterion: greater than 0.3, kind: finding}
      - {id: twice, statement: s, source: Q, given: 1, value: pair/one.ensemble_dip + pair/one.ensemble_dip, criterion: greater than 0.9, kind: finding}
      - {id: ratio, statement: s, source: Q, given: 1, value: 2 / pair/two.ensemble_dip, criterion: less than 8, kind: finding}
      - {id: level, statement: s, source: Q, given: 1, value: pair/one.ensemble_dip_p, criterion: less than 0.05, kind: finding}
      - {id: fixed, statement: s, source: Q, given: 1, value: pair/one.ensemble_dip_p, criterion: less than 0.05, kind: finding, deterministic: yes}
      - {id: mixed, statement: s, source: Q, given: 1, value: pair/one.ensemble_dip - pair/two.r, criterion: less than 5, kind: finding}
END
expect 0 '' "$scree" report ens -s ens.yaml -o page.md
row single | grep -qF '| 0.5 [0.46, 0.53] | 6 of 6 | **agrees** |' || complain "an ensemble: $(row single)"
# Ends: 0.3 - (0.04^2 + 0.04^2)^(1/2), 0.3 + (0.03^2 + 0.04^2)^(1/2).
row apart | grep -qF '| 0.3 [0.2434, 0.35] | 6 of 6 | **undecided** |' || complain "two ensembles: $(row apart)"
row twice | grep -qF '| 1 [0.92, 1.06] | 6 of 6 | **agrees** |' || complain "one ensemble twice: $(row twice)"
row ratio | grep -qF '| 10 [8.333, 12.5] | 6 of 6 | **differs** |' || complain "a quotient: $(row ratio)"
row level | grep -qF '| **undecided** |' || complain "a number without interval: $(row level)"
row fixed | grep -qF '| 0.03 [0.03, 0.03] | 6 of 6 | **agrees** |' || complain "deterministic: $(row fixed)"
row mixed | grep -qF 'make no value with those of single runs' || complain "mixed: $(row mixed)"
average ens/two two 7 dip 0.2 0.16 0.24
expect 0 '' "$scree" report ens -s ens.yaml -o page.md
row ratio | grep -qF 'averages over 7 of the 6 runs that are done' || complain "old averages: $(row ratio)"
average ens/one one 5 dip 0.5 0.46 0.53
rm page.md
expect 0 '' "$scree" report ens -s ens.yaml -o page.md
row single | grep -qF '| **undecided** | full | averages over 5 of the 6 runs that are done: call `scree sweep --collect`; averages over fewer than 6 samples have no interval of 95 % |' || complain "few samples: $(row single)"
row fixed | grep -qF '| **agrees** |' || complain "few samples, deterministic: $(row fixed)"
# Averages over four full runs have no interval, whatever their row shows: six quick ones stay on the page and count
# when their folders are gone, as they count beside such a row.
sed -n '1,/id: single/p' ens.yaml >few.yaml
sweep few/quick pair true one <<'END'
1 done 0.81 aaa 2.0
2 done 0.82 aaa 2.0
3 done 0.83 aaa 2.0
4 done 0.84 aaa 2.0
5 done 0.85 aaa 2.0
6 done 0.86 aaa 2.0
END
sweep few/full pair false one <<'END'
1 done 0.81 aaa 2.0
2 done 0.82 aaa 2.0
3 done 0.83 aaa 2.0
4 done 0.84 aaa 2.0
5 missing 0 x 0
6 missing 0 x 0
END
average few/quick one 6 dip 0.3 0.26 0.33
average few/full one 4 dip 0.5 0.46 0.53
rm page.md
expect 0 '' "$scree" report few -s few.yaml -o page.md
row single | tail -1 | grep -qF '| 0.3 [0.26, 0.33] | 6 of 6 | **differs** | quick |' || complain "six quick runs beside four full ones: $(row single)"
rm page.md
expect 0 '' "$scree" report few/quick -s few.yaml -o page.md
cp page.md six.md
expect 0 '1 cases stay as page.md had them' "$scree" report few/full -s few.yaml -o page.md
cmp -s page.md six.md || complain "four full runs in place of six quick ones: $(row single)"
# Where only the full row stands, quick runs with an interval take its place.
rm page.md
expect 0 '' "$scree" report few/full -s few.yaml -o page.md
row single | grep -qF '| 4 of 6 | **undecided** | full |' || complain "four full runs alone: $(row single)"
expect 0 '' "$scree" report few/quick -s few.yaml -o page.md
row single | grep -qF '| 0.3 [0.26, 0.33] | 6 of 6 | **differs** | quick |' || complain "six quick runs after four full ones: $(row single)"
sed -i 's/two.ensemble_dip,/two.ensemble_dpi,/' ens.yaml
expect 2 "there is no result 'ensemble_dpi'; did you mean 'ensemble_dip'" "$scree" report ens -s ens.yaml -o page.md
finish ""
