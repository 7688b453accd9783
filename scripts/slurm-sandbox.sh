#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
# usage: slurm-sandbox.sh start FOLDER | kill FOLDER NODE | stop FOLDER
# A Slurm cluster of two nodes, n1 and n2, with a processor each, on this machine and without systemd: munged, slurmctld and two slurmd from
# Debian's packages (slurmctld slurmd slurm-client munge), all of whose files are in FOLDER. start makes the folder and prints what sets
# SLURM_CONF for sbatch, squeue and so on: eval "$(slurm-sandbox.sh start FOLDER)". kill ends a node with all that runs on it at once, as a
# power cut does. Exit status 77 where a package is missing.
set -euo pipefail

usage() { sed -n 's/^# usage: /usage: /p' "${BASH_SOURCE[0]}" >&2; exit 2; }
(($# >= 2)) || usage
action=$1
folder=$(realpath -m "$2")
export SLURM_CONF=$folder/slurm.conf

# Ends the process of a file and waits until it is gone.
end() {
  local process
  process=$(cat "$2" 2>/dev/null) || return 0
  kill "-$1" "$process" 2>/dev/null || return 0
  for ((i = 0; i < 100; ++i)); do
    # A zombie that nobody waits for is gone too.
    [[ $(ps -o stat= -p "$process" 2>/dev/null) =~ ^[^Z] ]] || return 0
    sleep 0.05
  done
  kill -KILL "$process" 2>/dev/null || true
}

start() {
  for program in munged slurmctld slurmd sbatch; do
    PATH=$PATH:/usr/sbin command -v "$program" >/dev/null || {
      echo "$program is missing: install the Debian packages slurmctld slurmd slurm-client munge" >&2
      exit 77
    }
  done
  mkdir -p "$folder"/{state,n1,n2}
  chmod 700 "$folder"
  head -c 1024 /dev/urandom >"$folder/munge.key"
  chmod 400 "$folder/munge.key"
  local ports host
  ports=($(python3 -c 'import socket; s = [socket.socket() for _ in range(3)]; [x.bind(("127.0.0.1", 0)) for x in s]; print(*(x.getsockname()[1] for x in s))'))
  host=$(hostname)
  cat >"$SLURM_CONF" <<CONF
ClusterName=sandbox
SlurmctldHost=$host(127.0.0.1)
SlurmUser=$(id -un)
SlurmdUser=$(id -un)
AuthInfo=socket=$folder/munge.socket
SlurmctldPort=${ports[0]}
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/%n
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.%n.pid
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/%n.log
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
# A dead node is noticed, and what waits for a free one begins, within seconds.
SlurmdTimeout=4
KillWait=1
SchedulerParameters=sched_interval=1,batch_sched_delay=0,sched_min_interval=0
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
ReturnToService=2
MinJobAge=3600
NodeName=n1 NodeHostname=$host NodeAddr=127.0.0.1 Port=${ports[1]} CPUs=1
NodeName=n2 NodeHostname=$host NodeAddr=127.0.0.1 Port=${ports[2]} CPUs=1
PartitionName=all Nodes=ALL Default=YES
CONF
  export PATH=$PATH:/usr/sbin
  munged --force --key-file="$folder/munge.key" --socket="$folder/munge.socket" --pid-file="$folder/munged.pid" --log-file="$folder/munged.log" --seed-file="$folder/munged.seed" 2>>"$folder/munged.log"
  slurmctld 2>>"$folder/slurmctld.log"
  # A node is a PID namespace: with its first process all others end.
  local away=(unshare --pid --fork --kill-child)
  ((EUID == 0)) || away=(unshare --user --map-current-user --pid --fork --kill-child)
  for node in n1 n2; do
    setsid "${away[@]}" slurmd -D -N "$node" >>"$folder/$node.log" 2>&1 </dev/null &
    echo $! >"$folder/$node.pid"
  done
  for ((i = 0; i < 200; ++i)); do
    [[ $(sinfo -h -t idle -o %D 2>/dev/null) == 2 ]] && { echo "export SLURM_CONF=$SLURM_CONF"; return; }
    sleep 0.1
  done
  echo "the nodes do not come up; see $folder/*.log" >&2
  stop
  exit 1
}

stop() {
  end KILL "$folder/n1.pid"
  end KILL "$folder/n2.pid"
  end TERM "$folder/slurmctld.pid"
  end TERM "$folder/munged.pid"
}

case $action in
  start) start ;;
  kill) (($# == 3)) || usage; end KILL "$folder/$3.pid" ;;
  stop) stop ;;
  *) usage ;;
esac
