#!/usr/bin/env bash
# Under a batch system: SIGUSR1 ends a run after a checkpoint, the script of docs/clusters.md queues the job again and
# the run goes on with the same bits; several processes of a launcher are refused, by one of them.
# shellcheck source=tests/cli/job.sh
. "$(dirname "$0")/job.sh"
# shellcheck source=tests/cli/check.sh
. "$(dirname "$0")/check.sh"

# --- a launcher of MPI, as it looks to its processes
refusal='started 4 times by a launcher of MPI .*each of the 4 would run the whole case'
for verb in 'run restitution' 'sweep friction' 'bisect restitution' reproduce; do
    # shellcheck disable=SC2086
    expect 2 "^scree ${verb% *}: $refusal" env OMPI_COMM_WORLD_SIZE=4 OMPI_COMM_WORLD_RANK=0 "$scree" $verb
done
expect 2 '' env OMPI_COMM_WORLD_SIZE=4 OMPI_COMM_WORLD_RANK=3 "$scree" run restitution -o many
expect 2 "$refusal" env PMI_SIZE=4 PMI_RANK=0 "$scree" run restitution -o many
expect 2 '' env PMI_SIZE=4 PMI_RANK=1 "$scree" run restitution -o many
[ -e many ] && complain "a refused run has made its folder"
# What is no launcher of several, and what computes nothing.
expect 0 'results in one' env SLURM_NTASKS=4 OMPI_COMM_WORLD_SIZE=1 PMI_SIZE=none "$scree" run restitution --no-figures -o one
expect 0 'state_checksum' env OMPI_COMM_WORLD_SIZE=4 OMPI_COMM_WORLD_RANK=1 "$scree" get one
expect 0 'scree run' env OMPI_COMM_WORLD_SIZE=4 OMPI_COMM_WORLD_RANK=0 "$scree" run --help
if ldd "$scree" | grep -q libmpi; then
    echo "built with MPI: mpirun is not refused (test_ranks.sh)"
elif command -v mpirun >/dev/null; then
    checks=$((checks + 1))
    OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 mpirun --oversubscribe -n 3 "$scree" run restitution -o many \
        >mpirun.txt 2>&1 </dev/null && complain "mpirun was not refused"
    same "$(grep -c 'by a launcher of MPI' mpirun.txt)" 1 "messages under mpirun: $(cat mpirun.txt)"
    [ -e many ] && complain "a run refused under mpirun has made its folder"
else
    echo "no mpirun here: only its environment was tried"
fi

# --- the script of the documents, with the signal that SLURM sends it; `sbatch` is a call of bash here
make_programs
export SLURM_CPUS_PER_TASK=1 SLURM_JOB_ID=17
job_script 'A run under SLURM'
"$scree" run biaxial -o whole -q --no-figures --quick --threads 1 --set particles.count=40 --set 'stages.compress.strain=4 %' \
    --set 'stages.compress.rate=1e-2 1/s' --set stages.confine.friction=0.4 --set 'integrator.step=4e-5 s' \
    --set 'measure.windows=[]' --set output.snapshots=1 || complain "the run that is not interrupted"
cp whole/case.yaml big.yaml
stop_job 'confine ended'
expect 0 '' bash job.sh
same "$(cat requeued.txt)" 'requeue 17' "a job that is done is not queued again"
same "$("$scree" get out state_checksum)" "$("$scree" get whole state_checksum)" "bits of the run that was queued again"
grep -q 'goes on from step' out/log.txt || complain "the second job did not continue: $(cat out/log.txt)"
# A job that is cancelled gets SIGTERM, all of its processes do; it writes a checkpoint and is not queued again.
rm -r out requeued.txt
bash job.sh 2>job.txt &
job=$!
wait_for 'confine ended' out/log.txt
kill -TERM "$(pgrep -P $job)"
wait $job
same $? 130 "exit status of a job that is cancelled"
[ -e requeued.txt ] && complain "a job that was cancelled is queued again"
expect 0 '' bash job.sh
same "$("$scree" get out state_checksum)" "$("$scree" get whole state_checksum)" "bits of the run that was cancelled"
finish
