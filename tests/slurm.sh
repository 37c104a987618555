#!/bin/bash
# tests/shards.sh with an engine under it: a Slurm controller and one node on this machine, without systemd, in a folder of their own,
# ended by their process ids. Needs slurmctld, slurmd, sbatch and munge (packages slurmctld slurmd slurm-client munge), and to be root.
set -eu
for program in slurmctld slurmd sbatch munged scontrol; do
	command -v $program >/dev/null || { echo "test-slurm: $program is missing (packages slurmctld slurmd slurm-client munge)" >&2; exit 1; }
done
[ "$(id -u)" = 0 ] || { echo 'test-slurm: slurmd wants to be root' >&2; exit 1; }
home=$(mktemp -d) pids=()
finish() {
	status=$?
	[ $status = 0 ] || tail -n 15 "$home"/*.log >&2
	for pid in "${pids[@]}"; do kill "$pid" 2>/dev/null || true; done
	for pid in "${pids[@]}"; do wait "$pid" 2>/dev/null || true; done
	rm -rf "$home"
	exit $status
}
trap finish EXIT
mkdir -p "$home"/{state,spool,munge}
chmod 755 "$home"
head -c 128 /dev/urandom >"$home/munge/key"
chmod 700 "$home/munge"
chmod 400 "$home/munge/key"
host=$(hostname -s) port=$((20000 + $$ % 20000))
read -r _ memory _ </proc/meminfo
cat >"$home/slurm.conf" <<CONF
ClusterName=raycost
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$port
SlurmdPort=$((port + 1))
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket=$home/munge/socket
CredType=cred/munge
StateSaveLocation=$home/state
SlurmdSpoolDir=$home/spool
SlurmctldPidFile=$home/slurmctld.pid
SlurmdPidFile=$home/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
CommunicationParameters=NoCtldInAddrAny,NoInAddrAny
ReturnToService=2
MailProg=/bin/true
SchedulerParameters=batch_sched_delay=0,sched_interval=1
MinJobAge=60
NodeName=$host NodeAddr=127.0.0.1 CPUs=$(nproc) RealMemory=$((memory / 2048))
PartitionName=all Nodes=$host Default=YES MaxTime=10 State=UP
CONF
echo 'CgroupPlugin=cgroup/v1' >"$home/cgroup.conf"
export SLURM_CONF=$home/slurm.conf
munged --foreground --force --key-file="$home/munge/key" --socket="$home/munge/socket" --pid-file="$home/munge/pid" \
	--log-file="$home/munge/log" --seed-file="$home/munge/seed" >"$home/munged.log" 2>&1 &
pids+=($!)
for _ in $(seq 50); do [ -S "$home/munge/socket" ] && break; sleep 0.1; done
chmod 755 "$home/munge"
slurmctld -D -f "$SLURM_CONF" >"$home/slurmctld.log" 2>&1 &
pids+=($!)
slurmd -D -f "$SLURM_CONF" -N "$host" >"$home/slurmd.log" 2>&1 &
pids+=($!)
for _ in $(seq 100); do
	scontrol show node "$host" 2>/dev/null | grep -q 'State=IDLE' && break
	sleep 0.2
done
scontrol show node "$host" | grep -q 'State=IDLE' || { echo 'test-slurm: the node does not come up' >&2; exit 1; }
SLURM=yes sh tests/shards.sh
