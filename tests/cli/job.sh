# Helpers of the tests of SLURM scripts; sourced beside check.sh. `sbatch` is a call of bash here.
# shellcheck shell=bash disable=SC2154

# Programs for PATH: a scree without figures, and an scontrol that notes what is queued again.
make_programs() {
    mkdir programs
    # shellcheck disable=SC2016
    printf '#!/bin/sh\necho "$@" >>requeued.txt\n' >programs/scontrol
    printf '#!/bin/sh\nexec "%s" "$@" --no-figures\n' "$scree" >programs/scree
    chmod +x programs/*
    export PATH=$scratch/programs:$PATH
}

# job_script HEADING: the script under this heading of docs/clusters.md, as job.sh.
job_script() {
    awk -v heading="## $1" '$0 == heading {here = 1} here && /^    #!\/bin\/bash/ {on = 1} on && !/^    / {exit} on {print substr($0, 5)}' \
        "${SCREE_SOURCE_DIR:?}/docs/clusters.md" >job.sh
    grep -q '^#SBATCH --signal=B:USR1@' job.sh || complain "the script of docs/clusters.md was not found: $1"
}

# stop_job PATTERN: a job.sh that is told of its limit when a line of out/log.txt matches ends so, and is queued again.
stop_job() {
    local job
    bash job.sh 2>job.txt &
    job=$!
    wait_for "$1" out/log.txt
    kill -USR1 $job
    wait $job
    same $? 130 "exit status of a job at its limit: $(cat job.txt)"
    same "$(cat requeued.txt)" 'requeue 17' 'what was queued again'
}
