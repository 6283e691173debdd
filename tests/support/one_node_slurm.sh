# A throw-away Slurm of one node on this host, in the folder given; to be sourced: one_node_slurm FOLDER CPUS. Afterwards SLURM_CONF is
# set, so that srun, sinfo and squeue talk to it, and stop_one_node_slurm ends its three daemons. Everything, keys and ports
# included, is its own; a Slurm that is installed here for real is not touched. Returns 77, having said why, where it cannot run.
one_node_slurm() {
  local folder=$1 cpus=$2 name ctld node i
  for name in munged slurmctld slurmd srun sinfo; do
    PATH=$PATH:/usr/sbin command -v $name > /dev/null || { echo "no $name here: apt install slurm-wlm munge"; return 77; }
  done
  [ "$(id -u)" = 0 ] || { echo 'slurmd must be root'; return 77; }
  mkdir -p "$folder"/{state,spool}
  chmod 755 "$folder"
  node=$(hostname -s)
  ctld=$((20000 + RANDOM % 10000))
  # Munge refuses a socket or key below folders that others may write to; /run is safe.
  one_node_slurm_run=$(mktemp -d /run/one-node-slurm.XXXXXX)
  chmod 755 "$one_node_slurm_run"
  head -c 1024 /dev/urandom > "$one_node_slurm_run/munge.key"
  chmod 400 "$one_node_slurm_run/munge.key"
  PATH=$PATH:/usr/sbin munged --key-file="$one_node_slurm_run/munge.key" --socket="$one_node_slurm_run/munge.socket" --pid-file="$one_node_slurm_run/munge.pid" \
    --log-file="$one_node_slurm_run/munge.log" --seed-file="$one_node_slurm_run/munge.seed" > "$folder/munged.out" 2>&1 || { cat "$folder/munged.out"; stop_one_node_slurm; return 77; }
  cat > "$folder/slurm.conf" <<CONF
ClusterName=test
SlurmctldHost=$node(127.0.0.1)
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket=$one_node_slurm_run/munge.socket
CredType=cred/munge
SlurmctldPort=$ctld
SlurmdPort=$((ctld + 1))
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$one_node_slurm_run/slurmctld.pid
SlurmdPidFile=$one_node_slurm_run/slurmd.pid
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd.log
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
ReturnToService=2
SwitchType=switch/none
MpiDefault=none
NodeName=$node NodeAddr=127.0.0.1 CPUs=$cpus State=UNKNOWN
PartitionName=all Nodes=$node Default=YES MaxTime=INFINITE State=UP OverSubscribe=NO
CONF
  # slurmd looks for a cgroup folder even where no plugin uses it.
  printf 'CgroupAutomount=no\nCgroupMountpoint=%s\nIgnoreSystemd=yes\n' "$([ -d /sys/fs/cgroup ] && echo /sys/fs/cgroup || echo "$folder")" > "$folder/cgroup.conf"
  export SLURM_CONF=$folder/slurm.conf
  /usr/sbin/slurmctld -f "$SLURM_CONF" > "$folder/out" 2>&1 && /usr/sbin/slurmd -f "$SLURM_CONF" -N "$node" >> "$folder/out" 2>&1 || true
  for i in $(seq 100); do
    [ "$(timeout 5 sinfo -h -o %T 2> /dev/null)" != idle ] || return 0
    sleep 0.2
  done
  echo 'Slurm does not come up here:'
  cat "$folder/out"
  tail -n 5 "$folder"/slurm*.log
  stop_one_node_slurm
  return 77
}

stop_one_node_slurm() {
  local name
  for name in slurmd slurmctld munge; do
    [ ! -s "$one_node_slurm_run/$name.pid" ] || kill "$(cat "$one_node_slurm_run/$name.pid")" 2> /dev/null || true
  done
  rm -rf "$one_node_slurm_run"
}
