#!/usr/bin/env bash
# Around a run on several processes: what it takes (`scree check --ranks`), what it has sent (log.txt, summary.json),
# members of sweeps on several processes, and the SLURM script of docs/clusters.md with the signal that mpirun forwards.
# Without MPI: the estimate, and what is refused.
# shellcheck source=tests/cli/job.sh
. "$(dirname "$0")/job.sh"
# shellcheck source=tests/cli/check.sh
. "$(dirname "$0")/check.sh"
cat >shear.yaml <<'END'
scree: 1
name: shear
seed: 1
materials: [{name: glass, young_modulus: 10 MPa, density: 2500 kg/m3, friction: 0.5, restitution: 0.5}]
particles: {shape: disc, material: glass, radius_min: 0.7 mm, radius_max: 1.3 mm, count: 150}
contact: {law: hertz_mindlin}
integrator: {scheme: velocity_verlet, step_fraction: 0.2}
boundary: {periodic: xy}
stages:
  - {stage: prepare, method: gas, solid_fraction: 45 %}
  - {stage: confine, pressure: 2 kPa, unbalanced_limit: 0.9}
  - {stage: deform, velocity_gradient: {xy: 20 1/s}, stress: {yy: 2 kPa}, strain: 2 %}
measure: {samples: 10, cells: no}
output: {snapshots: 1, figures: no, paraview: no}
END
cat >few.yaml <<'END'
name: few
title: Friction
case: shear.yaml
realisations: 1
vary:
  - {key: materials.0.friction, values: [0.2, 0.4]}
measures: [steps]
END

# --- what one of N processes takes: parts, ghosts, time, memory; of many more particles than processes nearly a part
expect 0 '^# processes +4, mpirun -n 4' "$scree" check shear.yaml --ranks 4
grep -qE '^#   particles +37.5, and about [1-9][0-9.]* of others' <<<"$output" || complain "parts of 4: $output"
[ "$("$scree" check shear.yaml | grep -c processes)" = 0 ] || complain 'processes are told without --ranks'
# estimate NAME PROCESSES: the number of a line [s, B] of 1,000,000 discs.
estimate() { "$scree" check shear.yaml --set particles.count=1000000 --ranks "$2" | awk -v name="$1" '
    on && $2 == name { print $3 * ($4 ~ /^(GB|min)/ ? 1000 : $4 ~ /^h/ ? 60000 : $4 ~ /^kB/ ? 1e-3 : 1); exit } /^# processes/ { on = 1 }'; }
more() { checks=$((checks + 1)); awk "BEGIN { exit !($1 > $2) }" || complain "$3: $1 is not more than $2"; }
more "$(estimate memory 1)" "4 * $(estimate memory 8)" 'memory of one process over that of a part of 8'
more "$(estimate sends 8)" "1.5 * $(estimate sends 64)" 'bytes of 8 and of 64 processes'
more "3 * $(estimate sends 64)" "$(estimate sends 8)" 'bytes go with the surface'
for wrong in 0 -1 5000 two; do expect 2 "^scree check: --ranks: .*from 1 to 4096" "$scree" check shear.yaml --ranks=$wrong; done
expect 2 "stage 'collide' cannot be spread over several processes yet" "$scree" check restitution --quick --ranks 2
mkdir run
cp shear.yaml run/case.yaml
expect 2 'not asked of the folder of a run' "$scree" check run --ranks 2

# --- members of several processes
expect 2 'ranks: does not go with --dry-run' "$scree" sweep few.yaml --ranks 2 --dry-run
if ! ldd "$scree" | grep -q libmpi; then
    for what in '--slurm no.sh' '--member 0' ''; do
        # shellcheck disable=SC2086
        expect 2 'members cannot have several processes: this program is built without MPI' "$scree" sweep few.yaml -o no --ranks 2 $what
    done
    [ -e no ] || [ -e no.sh ] && complain 'a refused sweep has made something'
    echo 'built without MPI: nothing was run on several processes'
    finish
    exit
fi
command -v mpirun >/dev/null || { echo 'skipped: there is no mpirun'; exit 77; }
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
# mpirun in a job that is none: without SLURM's variables, on more processes than there are cores; says how it was called.
launcher=$(command -v mpirun)
make_programs
printf '#!/bin/bash\nprintf "%%s " "$@" >>"%s/launched.txt"\necho >>"%s/launched.txt"\nunset SLURM_JOB_ID SLURM_NTASKS\nexec "%s" --oversubscribe "$@"\n' "$scratch" "$scratch" "$launcher" >programs/mpirun
chmod +x programs/mpirun
sed 's/shear.yaml/restitution\nquick: yes/' few.yaml >struck.yaml
expect 2 "stage 'collide' cannot be spread" "$scree" sweep struck.yaml -o no --ranks 2 --slurm no.sh
expect 0 'sbatch array.sh' "$scree" sweep few.yaml -o array --ranks 2 --threads 1 --slurm array.sh
expect 0 '' bash -n array.sh
grep -q '^#SBATCH --ntasks=2$' array.sh || complain "array.sh does not ask for two tasks: $(cat array.sh)"
expect 0 'done in' env SLURM_JOB_ID=17 SLURM_ARRAY_TASK_ID=0 bash array.sh
grep -q -- "^-n 2 $scree run array/members/000-.* --threads 1 --quiet" launched.txt || complain "member 0 was started by $(cat launched.txt)"
# One that is stopped at its limit: mpirun would kill its processes after a second, unless it is told by SIGUSR1.
SLURM_JOB_ID=17 SLURM_ARRAY_TASK_ID=1 bash array.sh 2>task.txt &
task=$!
wait_for 'prepare ended' array/members/001-friction=0.4-seed=1/log.txt
kill -TERM $task
wait $task
same $? 130 "a task that is stopped: $(cat task.txt)"
expect 0 'done in' env SLURM_JOB_ID=17 SLURM_ARRAY_TASK_ID=1 bash array.sh
grep -q 'goes on from step' array/members/001-friction=0.4-seed=1/log.txt || complain 'a task that was stopped does not go on'
expect 0 'means in' "$scree" sweep few.yaml -o array --ranks 2 --collect --no-figures
expect 0 'means in' "$scree" sweep few.yaml -o alone --no-figures
for member in 000-friction=0.2-seed=1 001-friction=0.4-seed=1; do
    same "$("$scree" get "array/members/$member" state_checksum)" "$("$scree" get "alone/members/$member" state_checksum)" "bits of member $member"
done

# --- what was sent: of two processes each sends one message and gets one back in a step; bytes follow from the ghosts
folder=array/members/000-friction=0.2-seed=1
count() { "$scree" get "$folder" "processes_$1"; }
same "$("$scree" get "$folder" processes)" 2 'processes that took part'
expect 2 'there is no result' "$scree" get alone/members/000-friction=0.2-seed=1 processes
grep -qE '2 processes, a step of all of them \(mean of [0-9]+\): 4\.0 messages, ' $folder/log.txt || complain "messages of two: $(grep 'a step of' $folder/log.txt)"
more "$(count messages)" 4 'messages, lists included'
more "$(count ghosts)" 1 'ghosts of a process'
# 2D: position and velocity follow, force and torque come back: 9 numbers of 8 bytes.
checks=$((checks + 1))
awk "BEGIN { ratio = $(count bytes) / (2 * 72 * $(count ghosts)); exit !(ratio >= 1 && ratio < 1.3) }" || complain "$(count bytes) bytes for $(count ghosts) ghosts of each of two"
more "$(count bytes_ratio)" 1 'bytes over what ghosts need'
more "$(count reductions)" 1.9 'reductions a step'
more 3.5 "$(count reductions)" 'reductions a step'
more "$(count imbalance)" 0.9999 'balance'
more 1 "$(count waiting)" 'share of waiting'
more "$(count waiting)" 0 'share of waiting'
grep -qE 'time of a process, mean \(most\): reductions [0-9.e-]+ s ' $folder/log.txt || complain 'nothing is said of waiting'

# --- the script of the documents for one run on several processes: stopped at its limit, queued again, gone on
export SLURM_CPUS_PER_TASK=1 SLURM_JOB_ID=17 SLURM_NTASKS=3
job_script 'A run of several processes under SLURM'
expect 0 '' bash -n job.sh
cp shear.yaml big.yaml
rm launched.txt
stop_job 'prepare ended'
SLURM_NTASKS=2 bash job.sh 2>>job.txt || complain "the second job: $(cat job.txt)"
same "$(cat requeued.txt)" 'requeue 17' 'a job that is done is not queued again'
same "$(cut -d' ' -f1,2,4,5 launched.txt | tr '\n' ';')" '-n 3 run big.yaml;-n 2 run --restart;' 'how the jobs were started'
expect 0 '|warning' "$scree" run big.yaml -o whole -q --threads 1 --no-figures
same "$("$scree" get out state_checksum)" "$("$scree" get whole state_checksum)" 'bits of the run that was queued again'
finish
