#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# A Slurm cluster of two nodes on this machine, to try things: munged, slurmctld
# and two slurmd, with everything they write in one folder.
#
#   examples/cluster/local_slurm.sh start FOLDER
#   export SLURM_CONF=FOLDER/slurm.conf        for sbatch, squeue, snakemake
#   examples/cluster/local_slurm.sh kill-node FOLDER node1
#   examples/cluster/local_slurm.sh stop FOLDER
#
# Needs root and the packages slurmctld, slurmd, slurm-client and munge.
set -euo pipefail
if (($# < 2)); then
  sed -n '6,9s/^# *//p' "$0" >&2
  exit 2
fi
action="$1"
mkdir -p "$2"
folder="$(cd "$2" && pwd)"
export SLURM_CONF="$folder/slurm.conf"
nodes=(node1 node2)

# end <name>: ends the daemon of that name, and waits for it.
end() {
  local file="$folder/$1.pid" pid
  [[ -s "$file" ]] || return 0
  pid="$(cat "$file")"
  kill "${2:--TERM}" "$pid" 2>/dev/null || true
  for _ in {1..100}; do
    kill -0 "$pid" 2>/dev/null || break
    sleep 0.1
  done
  rm -f "$file"
}

# ports <n>: n free ports.
ports() {
  /usr/bin/python3 -c '
import socket, sys
sockets = [socket.socket() for _ in range(int(sys.argv[1]))]
for s in sockets: s.bind(("", 0))
print(*(s.getsockname()[1] for s in sockets))' "$1"
}

configure() {
  local host cpus memory controller first second
  host="$(hostname -s)"
  cpus="$(nproc)"
  memory="$(awk '/MemTotal/ {print int($2 / 1024 / 3)}' /proc/meminfo)"
  read -r controller first second < <(ports 3)
  mkdir -p "$folder/state" "$folder/spool"
  cat >"$SLURM_CONF" <<CONF
ClusterName=here
SlurmctldHost=$host
SlurmctldPort=$controller
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket=$folder/munge.socket
CryptoType=crypto/munge
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool/%n
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/%n.pid
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU_Memory
AccountingStorageType=accounting_storage/none
JobAcctGatherType=jobacct_gather/none
MpiDefault=none
ReturnToService=2
SlurmdTimeout=10
SlurmctldTimeout=10
MinJobAge=600
NodeName=node1 NodeHostname=$host NodeAddr=127.0.0.1 Port=$first CPUs=$cpus RealMemory=$memory
NodeName=node2 NodeHostname=$host NodeAddr=127.0.0.1 Port=$second CPUs=$cpus RealMemory=$memory
PartitionName=all Nodes=node1,node2 Default=YES MaxTime=INFINITE State=UP
CONF
}

start() {
  configure
  (umask 077 && head -c 1024 /dev/urandom >"$folder/munge.key")
  munged --force --key-file="$folder/munge.key" \
    --socket="$folder/munge.socket" --pid-file="$folder/munged.pid" \
    --log-file="$folder/munged.log" --seed-file="$folder/munged.seed"
  slurmctld -c
  for node in "${nodes[@]}"; do slurmd -N "$node"; done
  for _ in {1..100}; do
    if (($(sinfo --noheader --Node --states=idle | wc -l) == ${#nodes[@]})); then
      sinfo
      return
    fi
    sleep 0.3
  done
  echo "The nodes do not come up; the logs in $folder say why." >&2
  exit 1
}

stop() {
  scancel --user="$(id -un)" 2>/dev/null || true
  for daemon in "${nodes[@]}" slurmctld munged; do end "$daemon"; done
}

# As a machine that loses its power: the daemon and all that it runs.
kill_node() {
  kill -KILL "$(cat "$folder/$1.pid")"
  local environment process parent
  for environment in /proc/[0-9]*/environ; do
    grep -qzsx "SLURMD_NODENAME=$1" "$environment" || continue
    process="${environment//[^0-9]/}"
    parent="$(awk '{print $4}' "/proc/$process/stat" 2>/dev/null || true)"
    if [[ "$(cat "/proc/$parent/comm" 2>/dev/null)" == slurmstepd ]]; then
      kill -KILL "$parent" 2>/dev/null || true
    fi
    kill -KILL "$process" 2>/dev/null || true
  done
}

case "$action" in
  start) start ;;
  stop) stop ;;
  kill-node) kill_node "$3" ;;
  *)
    echo "There is no '$action'; see the head of this script." >&2
    exit 2
    ;;
esac
