# Helpers of the tests of the command line; sourced. First arguments of every test: the program and a scratch folder.
set -u
scree=$(realpath "$1")
scratch=$2
[ -x "$scree" ] || { echo "there is no program $scree"; exit 1; }
rm -rf "$scratch"
mkdir -p "$scratch"
scratch=$(realpath "$scratch")
cd "$scratch" || exit 1
checks=0
failures=0

complain() {
    printf 'FAIL: %.600s\n' "$*"
    failures=$((failures + 1))
}

# expect STATUS PATTERN COMMAND...: the command ends with that status, and what it prints (both streams) matches the
# extended regular expression (empty: prints nothing at all). Sets $output.
expect() {
    local wanted=$1 pattern=$2 status
    shift 2
    checks=$((checks + 1))
    output=$("$@" 2>&1 </dev/null)
    status=$?
    [ "$status" -eq "$wanted" ] || complain "$* ended with $status, not $wanted: $output"
    if [ -z "$pattern" ]; then
        [ -z "$output" ] || complain "$* printed '$output'"
    else
        grep -qE -- "$pattern" <<<"$output" || complain "$* printed '$output', not /$pattern/"
    fi
}

same() {
    checks=$((checks + 1))
    [ "$1" = "$2" ] || complain "${3:-not the same}: '$1' against '$2'"
}

# Milliseconds that a command takes, for people to read: timing never decides a test.
slowest=0
timed() {
    local begin end
    begin=$(date +%s%N)
    "$@"
    end=$(date +%s%N)
    local taken=$(((end - begin) / 1000000))
    [ "$taken" -gt "$slowest" ] && slowest=$taken
}

# wait_for PATTERN FILE: until a line of the file matches, at most a minute.
wait_for() {
    for ((i = 0; i < 1200; i++)); do
        grep -qs "$1" "$2" && return
        sleep 0.05
    done
    complain "nothing like '$1' in $2"
}

finish() {
    echo "$(basename "$0"): $checks checks, $failures failures${1:+; $1}"
    exit $((failures > 0))
}
