#!/usr/bin/env bash
# Runs examples/slurm/percuss-sweep.sbatch on a real SLURM of one node: daemons on loopback in a folder of its own, without systemd
# and without cgroups. Needs Debian's packages slurmctld, slurmd, slurm-client and munge, which it installs where it may, and root.
# Usage: .ci/slurm-test.sh PERCUSS (the program that the tasks run)
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
percuss=$(realpath "${1:?usage: .ci/slurm-test.sh PERCUSS}")

fail() { echo "slurm-test: $*" >&2; exit 1; }

[ "$(id -u)" -eq 0 ] || fail "the daemons of SLURM have to be started by root"
packages=(slurmctld slurmd slurm-client munge)
if ! { command -v slurmctld && command -v slurmd && command -v sbatch && command -v munged; } >/dev/null; then
    command -v apt-get >/dev/null || fail "SLURM is not there: install ${packages[*]}"
    echo "installing ${packages[*]}"
    { apt-get update -qq && DEBIAN_FRONTEND=noninteractive apt-get install -qq -y --no-install-recommends "${packages[@]}"; } \
        >/tmp/percuss-slurm-apt.log 2>&1 || { tail -n 20 /tmp/percuss-slurm-apt.log; fail "cannot install ${packages[*]}"; }
fi

dir=$(mktemp -d /tmp/percuss-slurm.XXXXXX)
stop() {
    # In this order nothing waits for what has gone.
    for daemon in slurmd slurmctld munged; do
        [ -f "$dir/$daemon.pid" ] && kill "$(cat "$dir/$daemon.pid")" 2>/dev/null || true
    done
}
finish() {
    code=$?
    stop
    if [ "$code" -ne 0 ]; then
        for log in "$dir"/*.log; do echo "== $log"; tail -n 20 "$log"; done >&2
    fi
    sleep 1
    rm -rf "$dir"
    exit "$code"
}
trap finish EXIT

# munged wants folders that nobody else may write to, and a key that nobody else may read.
chmod 755 "$dir"
mkdir "$dir/state" "$dir/spool"
(umask 077 && head -c 1024 /dev/urandom >"$dir/munge.key")
host=$(hostname -s)
cpus=$(nproc)
memory=$(awk '/^MemTotal/ { print int($2 / 1024) }' /proc/meminfo)
cat >"$dir/slurm.conf" <<EOF
ClusterName=percuss
SlurmctldHost=$host(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$dir/munge.socket
SlurmctldPort=16817
SlurmdPort=16818
SlurmctldPidFile=$dir/slurmctld.pid
SlurmdPidFile=$dir/slurmd.pid
StateSaveLocation=$dir/state
SlurmdSpoolDir=$dir/spool
SlurmctldLogFile=$dir/slurmctld.log
SlurmdLogFile=$dir/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SchedulerType=sched/builtin
MpiDefault=none
ReturnToService=2
NodeName=$host NodeAddr=127.0.0.1 CPUs=$cpus RealMemory=$memory State=UNKNOWN
PartitionName=all Nodes=$host Default=YES MaxTime=INFINITE State=UP
EOF
export SLURM_CONF="$dir/slurm.conf"
munged --force --key-file="$dir/munge.key" --socket="$dir/munge.socket" --pid-file="$dir/munged.pid" \
    --log-file="$dir/munged.log" --seed-file="$dir/munged.seed"
slurmctld
slurmd
for _ in $(seq 60); do
    state=$(sinfo --noheader --format=%T 2>/dev/null || true)
    [ "$state" = idle ] && break
    sleep 0.5
done
[ "$state" = idle ] || fail "the node did not come up: ${state:-no answer}"

# 240 runs of the paper's case, and what they come to without a scheduler.
work="$dir/work"
mkdir -p "$work/bin"
ln -s "$percuss" "$work/bin/percuss"
export PATH="$work/bin:$PATH"
cp "$root"/cases/paper-table1/scenario.toml "$work/"
cat >"$work/sweep.toml" <<'EOF'
base = "scenario.toml"
model = "chain"
design = "sobol"
samples = 240
block_size = 2
[[parameter]]
key = "projectile.impact_velocity"
uniform = { from = "150 m/s", to = "400 m/s" }
EOF
cd "$work"
percuss sweep sweep.toml --out whole --quiet
percuss sweep merge whole --out whole.parquet >/dev/null

array() {
    sbatch --parsable --cpus-per-task=1 --mem=256M --array=1-4 "$@" "$root/examples/slurm/percuss-sweep.sbatch" sweep.toml rows
}
# `sbatch --wait` looks every ten seconds only.
ended() {
    while [ -n "$(squeue --noheader --job "$1" 2>/dev/null)" ]; do sleep 0.1; done
}
blocks() { find rows -name 'block-*.parquet' 2>/dev/null | wc -l; }

# The first attempt loses two tasks midway: one is killed, one is cancelled.
job=$(array)
until [ "$(blocks)" -ge 4 ]; do sleep 0.05; done
scancel --signal=KILL --full "${job}_1"
scancel "${job}_2"
ended "$job"
first=$(blocks)
if percuss sweep merge rows/part-* --out rows.parquet 2>merge.txt; then
    fail "a merge without the parts that were lost does not fail"
fi
grep -q 'missing' merge.txt || fail "the merge says something else: $(cat merge.txt)"
[ "$first" -lt 120 ] || fail "no block was lost: nothing was tested"

# The same line again completes them, and once more changes nothing.
ended "$(array)"
percuss sweep merge rows/part-* --out rows.parquet >/dev/null || fail "the second attempt failed: $(cat percuss-sweep-*.log)"
cmp rows.parquet whole.parquet || fail "the rows differ from those without a scheduler"
before=$(find rows -name 'block-*' -printf '%p %T@\n' | sort | md5sum)
job=$(array)
ended "$job"
[ "$(grep -l 'all rows were already computed' percuss-sweep-"$job"_*.log | wc -l)" -eq 4 ] || fail "an attempt with nothing to do failed"
[ "$before" = "$(find rows -name 'block-*' -printf '%p %T@\n' | sort | md5sum)" ] || fail "complete parts were computed again"

# A part of the array would count other parts: the script refuses it.
ended "$(array --array=3 --output=refused.log)"
grep -q 'submit the whole array' refused.log || fail "the refusal says something else: $(cat refused.log)"
echo "slurm-test: $first of 120 blocks after the first attempt, complete and bitwise equal after the second"
