#!/usr/bin/env bash
# Sweeps against a real Slurm, which is started in a temporary folder and stopped at the end.
#
#   sweep/tests/slurm.sh [--time-limit] [PARTITA]
#
# PARTITA is the program, target/debug/partita if nothing is said. 24 runs, one of which fails by design, are made by threads, by job
# arrays in three chunks (MaxArraySize is 8), and by job arrays that are cancelled half-way and submitted again: the tables are the
# same. With --time-limit a run is also killed by its time limit, and continues when it is submitted again; that takes some minutes.
#
# It needs Debian's slurmctld, slurmd, slurm-client and munge, which it installs, and root. Without them it does nothing.
set -euo pipefail

time_limit=no
if [ "${1:-}" = --time-limit ]; then
    time_limit=yes
    shift
fi
root=$(cd "$(dirname "$0")/../.." && pwd)
partita=$(realpath "${1:-${PARTITA:-$root/target/debug/partita}}")

nothing() {
    echo "slurm.sh: $1; nothing was tested"
    exit 0
}

has_slurm() {
    for program in slurmctld slurmd sbatch scancel munged; do
        command -v "$program" >/dev/null || return 1
    done
}

[ "$(id -u)" = 0 ] || nothing "Slurm can be started by root only"
packages=(slurmctld slurmd slurm-client munge)
if ! has_slurm; then
    command -v apt-get >/dev/null || nothing "there is no apt-get to install ${packages[*]}"
    export DEBIAN_FRONTEND=noninteractive
    { apt-get update && apt-get install -y --no-install-recommends "${packages[@]}"; } >/dev/null 2>&1 ||
        nothing "${packages[*]} cannot be installed"
fi
has_slurm || nothing "Slurm is not installed"
[ -x "$partita" ] || { echo "slurm.sh: $partita is not a program: build it first, or name it" >&2; exit 1; }

dir=$(mktemp -d)
daemons=()
clean_up() {
    local code=$?
    if [ "$code" != 0 ]; then
        tail -n 20 "$dir"/log/* "$dir"/*/slurm/*.log >&2 2>/dev/null || true
    fi
    scancel --user=root >/dev/null 2>&1 || true
    for pid in "${daemons[@]}"; do
        kill "$pid" 2>/dev/null || true
    done
    wait 2>/dev/null || true
    rm -rf "$dir"
    exit "$code"
}
trap clean_up EXIT
trap 'exit 130' INT TERM

# Slurm on this machine alone.
mkdir -p "$dir"/log "$dir"/state "$dir"/spool "$dir"/munge
chmod 755 "$dir"
chmod 700 "$dir/munge"
dd if=/dev/urandom of="$dir/munge/key" bs=128 count=1 status=none
chmod 600 "$dir/munge/key"
host=$(hostname -s)
cpus=$(nproc)
memory=$(awk '/^MemTotal/ { print int($2 / 1024 * 0.9) }' /proc/meminfo)
port=$((20000 + $$ % 20000))
export SLURM_CONF=$dir/slurm.conf
cat >"$SLURM_CONF" <<END
ClusterName=test
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$port
SlurmdPort=$((port + 1))
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$dir/munge/socket
CredType=cred/munge
StateSaveLocation=$dir/state
SlurmdSpoolDir=$dir/spool
SlurmctldPidFile=$dir/slurmctld.pid
SlurmdPidFile=$dir/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
AccountingStorageType=accounting_storage/none
JobAcctGatherType=jobacct_gather/none
MpiDefault=none
SwitchType=switch/none
ReturnToService=2
MaxArraySize=8
SchedulerParameters=batch_sched_delay=0,sched_interval=1,sched_min_interval=0,bf_interval=1
NodeName=$host NodeAddr=127.0.0.1 CPUs=$cpus RealMemory=$memory
PartitionName=all Nodes=$host Default=YES MaxTime=INFINITE State=UP
END
start() {
    local name=$1
    shift
    "$@" >"$dir/log/$name" 2>&1 &
    daemons+=($!)
}
start munged munged --foreground --force --key-file="$dir/munge/key" --socket="$dir/munge/socket" \
    --pid-file="$dir/munge/pid" --seed-file="$dir/munge/seed" --log-file="$dir/log/munged.log"
start slurmctld slurmctld -D -f "$SLURM_CONF"
start slurmd slurmd -D -f "$SLURM_CONF" -N "$host"

# until_true SECONDS WHAT COMMAND...: waits for a command to succeed.
until_true() {
    local seconds=$1 what=$2
    shift 2
    for ((waited = 0; waited < seconds * 5; waited++)); do
        if "$@" >/dev/null 2>&1; then return 0; fi
        sleep 0.2
    done
    echo "slurm.sh: $what did not happen within $seconds s" >&2
    return 1
}
node_is_idle() { [ "$(sinfo -h -o %t)" = idle ]; }
queue_is_empty() { local queue; queue=$(squeue -h) && [ -z "$queue" ]; }
fail() { echo "slurm.sh: $1" >&2; exit 1; }
until_true 60 "the start of Slurm" node_is_idle
echo "slurm.sh: $(sbatch --version) with $cpus CPUs"

# 24 runs, of which the one with the largest load on the softest material fails by design.
cd "$dir"
cat >cantilever.toml <<'END'
title = "Cantilever"
[time]
step = 1.0
steps = 1
[structure]
density = 1000.0
body_force = [0.0, -1.0]
clamped = ["left"]
time_scheme = "quasi_static"
[structure.geometry.rectangle]
size = [1.0, 0.1]
elements = [48, 6]
[structure.material.saint_venant_kirchhoff]
young_modulus = 1e6
poisson_ratio = 0.0
[structure.newton]
tolerance = { relative = 1e-10 }
max_iterations = 13
END
sweep() { # STEPS LOADS MODULI
    cat <<END
title = "Cantilever: load and modulus"
scene = "cantilever.toml"
steps = $1
[[parameter]]
name = "load"
values = [$2]
set = ["structure.body_force=[\"0\", \"-\$(x) * (1 + 0.1 * sin(t))\"]"]
[[parameter]]
name = "modulus"
values = [$3]
set = ["structure.material.saint_venant_kirchhoff.young_modulus=\$(x)"]
[[choice]]
name = "full Newton"
END
}
sweep 40 "1, 2, 5, 10, 20, 1000" "1e4, 1e5, 1e6, 1e7" >tank.toml
results() { find "$1/runs" -maxdepth 1 -name '*.json' ! -name sweep.json 2>/dev/null | wc -l; }
has_results() { [ "$(results "$1")" -ge "$2" ]; }

begun=$(date +%s)
"$partita" sweep run tank.toml --out threads --jobs 2 >threads.txt 2>&1
echo "slurm.sh: by threads: $(results threads) runs in $(($(date +%s) - begun)) s"
grep '^run ' threads.txt >failed.txt
[ "$(wc -l <failed.txt)" = 1 ] || fail "one run fails, and not: $(cat failed.txt)"

begun=$(date +%s)
"$partita" sweep submit tank.toml --out slurm --slurm --time=10 2>submit.txt >/dev/null
cat submit.txt
[ "$(grep -c '^job ' submit.txt)" = 3 ] || fail "24 runs need three arrays of eight tasks"
until_true 600 "the end of the arrays" queue_is_empty
echo "slurm.sh: by Slurm: $(results slurm) runs in $(($(date +%s) - begun)) s"
"$partita" sweep collect tank.toml --out slurm >slurm.txt 2>&1
cmp threads/cells.csv slurm/cells.csv
cmp threads/map.svg slurm/map.svg
cmp <(grep '^run ' slurm.txt) failed.txt

begun=$(date +%s)
"$partita" sweep submit tank.toml --out killed --slurm >/dev/null 2>&1
until_true 300 "the first results" has_results killed 5
scancel --user=root
until_true 120 "the end of what was cancelled" queue_is_empty
kept=$(results killed)
[ "$kept" -lt 24 ] || fail "nothing was left to be cancelled"
if "$partita" sweep collect tank.toml --out killed >half.txt 2>&1; then fail "half a sweep is not complete"; fi
[ "$(grep -c 'not finished' half.txt)" = $((24 - kept)) ] || fail "what is missing is not listed: $(cat half.txt)"
"$partita" sweep submit tank.toml --out killed --slurm 2>submit.txt >/dev/null
cat submit.txt
until_true 600 "the end of the arrays" queue_is_empty
"$partita" sweep collect tank.toml --out killed >killed.txt 2>&1
cmp threads/cells.csv killed/cells.csv
cmp <(grep '^run ' killed.txt) failed.txt
echo "slurm.sh: cancelled with $kept of 24 results, submitted again: complete after $(($(date +%s) - begun)) s, the same table"
[ "$time_limit" = yes ] || exit 0

# A run of about a minute and a half under a limit of one minute.
sed -i 's/elements = .*/elements = [192, 12]/' cantilever.toml
sweep 4 1 1e6 >long.toml
begun=$(date +%s%N)
"$partita" sweep run long.toml --out short --jobs 1 --quiet
steps=$((4 * 90 * 1000000000 / ($(date +%s%N) - begun)))
sweep "$steps" 1 1e6 >long.toml
"$partita" sweep run long.toml --out uncut --jobs 1 --quiet &
uncut=$!
kills=0
for submission in 1 2 3 4 5; do
    "$partita" sweep submit long.toml --out long --slurm --time=1 >/dev/null 2>&1
    until_true 300 "the end of the run" queue_is_empty
    state=$("$partita" sweep plan long.toml --out long --json | sed -n 's/.*"state": "\(.*\)".*/\1/p')
    echo "slurm.sh: $steps steps with --time=1, submission $submission: $state"
    [ "$state" = finished ] && break
    [ "$state" = interrupted ] || fail "a run that was killed has a checkpoint"
    kills=$((kills + 1))
done
[ "$state" = finished ] && [ "$kills" -gt 0 ] || fail "the run was killed $kills times and is $state"
wait "$uncut"
"$partita" sweep collect long.toml --out long >/dev/null 2>&1
cmp uncut/cells.csv long/cells.csv
cmp uncut/runs/*[0-9a-f].json long/runs/*[0-9a-f].json
grep -h 'CANCELLED' long/slurm/*.log || true
echo "slurm.sh: killed $kills times by its time limit, the same result bit for bit"
