# Helpers of the tests of one run on several processes; sourced beside check.sh.
# shellcheck shell=bash disable=SC2154
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1

skip() { echo "skipped: $1"; exit 77; }

# need_processes TOOL...: a build with MPI, and these programs beside the tests.
need_processes() {
    local tool tools
    tools=$(dirname "$scree")/tests
    command -v mpirun >/dev/null || skip 'there is no mpirun'
    for tool in check_ranks "$@"; do [ -x "$tools/$tool" ] || skip "there is no $tools/$tool (a target)"; done
    ! mpirun --oversubscribe -n 2 "$tools/check_ranks" 1 2>&1 </dev/null | grep -q '^ranks 1' || skip 'built without MPI (preset mpi)'
}

# on PROCESSES ARGUMENT...: a run on so many.
on() { mpirun --oversubscribe -n "$1" "$scree" run "${@:2}" --quiet 2>&1 </dev/null; }
checksum() { "$scree" get "$1" state_checksum; }
