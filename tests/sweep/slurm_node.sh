#!/usr/bin/env bash
# Usage: slurm_node.sh FOLDER COMMAND…
# Runs the command on a Slurm cluster of one node: this machine, with its daemons in namespaces of their own, so that they
# neither need ports of the machine nor outlive this script. FOLDER holds their files; its path must be short.
# Exits with 77 where Slurm is not installed or cannot start, otherwise with the command's code.
set -euo pipefail
PATH=$PATH:/usr/sbin:/sbin
skip() {
  echo "skipped: $*"
  tail --quiet --lines=5 "$folder"/*.log 2>/dev/null || true
  exit 77
}

folder=$1
if [[ ${SLURM_NODE_INSIDE:-} != "$folder" ]]; then
  for program in munged munge slurmctld slurmd sbatch srun unshare ip; do
    command -v "$program" >/dev/null || { echo "skipped: $program is not installed" && exit 77; }
  done
  namespaces=(--net --uts --mount --pid --fork --mount-proc --kill-child=KILL)
  ((EUID == 0)) || namespaces+=(--user --map-root-user)
  unshare "${namespaces[@]}" true 2>/dev/null || { echo "skipped: namespaces are not allowed here" && exit 77; }
  mkdir -p "$folder"
  SLURM_NODE_INSIDE=$folder exec unshare "${namespaces[@]}" "$0" "$@"
fi
shift

# A host name that resolves to an address that is not the loopback's, which Slurm's clients look for.
hostname node1
printf '127.0.0.1 localhost\n192.0.2.1 node1\n' >"$folder/hosts"
mount --bind "$folder/hosts" /etc/hosts
{ ip link set lo up && ip address add 192.0.2.1/32 dev lo; } || skip "the loopback device cannot be set up"

mkdir -p "$folder"/{munge,state,spool}
chmod 755 "$folder" "$folder/munge"
chmod 700 "$folder/state" "$folder/spool"
(umask 077 && head --bytes=1024 /dev/urandom >"$folder/munge/key")
memory=$(($(awk '/^MemTotal/ {print $2}' /proc/meminfo) / 1024))
user=$(id --user --name)
cat >"$folder/slurm.conf" <<EOF
ClusterName=test
SlurmctldHost=node1(192.0.2.1)
SlurmUser=$user
SlurmdUser=$user
AuthType=auth/munge
AuthInfo=socket=$folder/munge/socket
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd.log
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerType=sched/builtin
SchedulerParameters=batch_sched_delay=0,sched_interval=1
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
MailProg=/bin/true
ReturnToService=2
SlurmdParameters=config_overrides
KillWait=2
MinJobAge=3600
NodeName=node1 NodeAddr=192.0.2.1 CPUs=$(nproc) RealMemory=$memory State=UNKNOWN
PartitionName=test Nodes=node1 Default=YES MaxTime=INFINITE State=UP OverSubscribe=NO
EOF
export SLURM_CONF=$folder/slurm.conf USER=$user

munged --foreground --force --key-file="$folder/munge/key" --socket="$folder/munge/socket" \
  --pid-file="$folder/munge/pid" --seed-file="$folder/munge/seed" --log-file="$folder/munged.log" \
  </dev/null >/dev/null 2>&1 &
for ((i = 0; i < 100; ++i)); do
  munge --socket="$folder/munge/socket" --no-input 2>/dev/null | unmunge --socket="$folder/munge/socket" >/dev/null 2>&1 && break
  sleep 0.1
done
((i < 100)) || skip "munged does not answer"
slurmctld -D -i </dev/null >/dev/null 2>&1 &
slurmd -D -N node1 </dev/null >/dev/null 2>&1 &
for ((i = 0; i < 300; ++i)); do
  [[ $(timeout 5 sinfo --noheader --format=%T 2>/dev/null) == idle ]] && break
  sleep 0.1
done
((i < 300)) || skip "the node does not become idle"
timeout 30 srun --time=1 --mem=100 true || skip "the node runs no job"

"$@" # the daemons end with this shell, the first process of its namespace
