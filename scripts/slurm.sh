#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# slurm.sh [-q] [PROGRAM [MODEL]]: runs the array of `dataset slurm` on a Slurm of its own (one controller, three nodes
# on this machine's loopback) and compares its sets byte for byte with plain runs: whole, in shards, with a task that is
# requeued, a node that is drained, a node that dies while its script lives on, a controller that is killed, an array
# that is cancelled and one that fails. -q: two of eight stations, so no more than two shards or tasks; without the
# last five. Exit code 77: no Slurm here, or not root.
# Needs Debian's slurm-wlm and munge.
set -euo pipefail
quick=; [ "${1:-}" = -q ] && { quick=1; shift; }
root="$(cd "$(dirname "$0")/.." && pwd)"
program="$(realpath "${1:-$root/build/release/bin/standpoint}")"
model="$(realpath "${2:-$root/build/release/samples/house.ifc}")"
for tool in slurmctld slurmd munged sbatch scontrol sinfo squeue scancel; do
  command -v "$tool" >/dev/null || { echo "skipped: $tool is not installed (Debian: slurm-wlm, munge)"; exit 77; }
done
[ "$(id -u)" = 0 ] || { echo "skipped: slurmd wants to be started by root"; exit 77; }
nodes=3
d="$(mktemp -d)"
export SLURM_CONF="$d/slurm.conf"
orphan=

endOf() {  # PID: stops it and waits for it
  [ -n "$1" ] && kill "$1" 2>/dev/null || return 0
  for _ in $(seq 100); do kill -0 "$1" 2>/dev/null || return 0; sleep 0.2; done
  kill -9 "$1" 2>/dev/null || true
}
pidIn() { cat "$d/run/$1.pid" 2>/dev/null || true; }
down() {
  [ -z "$orphan" ] || kill -9 "$orphan" 2>/dev/null || true
  scancel --user="$(id -un)" 2>/dev/null && sleep 1 || true
  for i in $(seq 0 $((nodes - 1))); do endOf "$(pidIn slurmd-n$i)"; done
  endOf "$(pidIn slurmctld)"
  endOf "$(pidIn munged)"
  rm -rf "$d"
}
trap down EXIT
trap 'exit 143' HUP INT TERM
die() { echo "FAILED: $*"; tail -n 5 "$d"/set*/slurm/*.log 2>/dev/null || true; exit 1; }

freePort() {  # the first of a row of them
  local p k taken
  for _ in $(seq 50); do
    p=$((20000 + RANDOM % 20000)) taken=
    for k in $(seq 0 $((nodes + 2))); do
      if (exec 3<>"/dev/tcp/127.0.0.1/$((p + k))") 2>/dev/null; then taken=1; fi
    done
    [ -n "$taken" ] || { echo "$p"; return; }
  done
  die "no free ports"
}

up() {
  local host port i
  host="$(hostname -s)" port="$(freePort)"
  mkdir -p "$d/state" "$d/log" "$d/run"
  chmod 755 "$d" "$d/run"
  dd if=/dev/urandom of="$d/munge.key" bs=1 count=1024 2>/dev/null
  chmod 400 "$d/munge.key"
  munged --key-file="$d/munge.key" --socket="$d/run/munge.sock" --pid-file="$d/run/munged.pid" \
         --log-file="$d/log/munged.log" --seed-file="$d/munge.seed"
  cat >"$SLURM_CONF" <<CONF
ClusterName=standpoint
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$port
AuthType=auth/munge
AuthInfo=socket=$d/run/munge.sock
CredType=cred/munge
SlurmUser=root
SlurmdUser=root
SlurmctldPidFile=$d/run/slurmctld.pid
SlurmdPidFile=$d/run/slurmd-%n.pid
StateSaveLocation=$d/state
SlurmdSpoolDir=$d/spool-%n
SlurmctldLogFile=$d/log/slurmctld.log
SlurmdLogFile=$d/log/%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerType=sched/backfill
SchedulerParameters=batch_sched_delay=1,sched_interval=2,bf_interval=2
CommunicationParameters=NoInAddrAny,NoCtldInAddrAny
MailProg=/bin/true
ReturnToService=2
SlurmdTimeout=10
KillWait=5
MinJobAge=600
JobRequeue=1
MaxArraySize=10001
SlurmdParameters=config_overrides
CONF
  for i in $(seq 0 $((nodes - 1))); do
    mkdir -p "$d/spool-n$i"
    echo "NodeName=n$i NodeHostname=$host NodeAddr=127.0.0.1 Port=$((port + 2 + i)) CPUs=2 Boards=1 SocketsPerBoard=1" \
         "CoresPerSocket=2 ThreadsPerCore=1 RealMemory=2000 State=UNKNOWN" >>"$SLURM_CONF"
  done
  echo "PartitionName=batch Nodes=ALL Default=YES MaxTime=INFINITE State=UP" >>"$SLURM_CONF"
  slurmctld -f "$SLURM_CONF" -c
  for i in $(seq 0 $((nodes - 1))); do slurmd -f "$SLURM_CONF" -N "n$i"; done
  allIdle
}
allIdle() {
  for _ in $(seq 300); do
    [ "$(sinfo -h -o '%T %D' 2>/dev/null)" = "idle $nodes" ] && return
    sleep 0.2
  done
  die "the nodes are not idle: $(sinfo -h -N)"
}

stateOf() {
  scontrol show job "$1" 2>/dev/null | sed -n 's/.*JobState=\([A-Z_]*\).*/\1/p' | head -n 1 || true
}
tasks() { squeue -h -r -j "$scans" -o '%i %T %r %N' 2>/dev/null || true; }
# A requeued task waits for two minutes; these wait for two seconds. Sooner its node refuses it ("credential revoked"):
# it takes it for the start that it ended, for it counts whole seconds.
hurry() {
  local id state reason rest waiting=()
  while read -r id state reason rest; do
    [ "$state" = PENDING ] && [ "$reason" = BeginTime ] && waiting+=("$id") || true
  done < <(tasks)
  ((${#waiting[@]} > 0)) || return 0
  sleep 2
  for id in "${waiting[@]}"; do scontrol update jobid="$id" StartTime=now 2>/dev/null || true; done
}
submit() {  # SET SHARDS; sets `scans` and `manifest`
  "$program" dataset slurm "$d/recipe.json" -o "$1" --shards "$2" --threads 1 >/dev/null
  resubmit "$1"
}
resubmit() {
  local said
  said="$("$1/slurm/submit")"
  scans="$(sed 's/scans \([0-9]*\).*/\1/' <<<"$said")" manifest="$(sed 's/.*manifest \([0-9]*\).*/\1/' <<<"$said")"
}
# TASK: waits until it has made its first scan, or is in it.
begun() {
  for _ in $(seq 600); do
    ls -d "$set"/.work/"${scans}_$1".* >/dev/null 2>&1 && return
    sleep 0.1
  done
  die "task $1 does not begin"
}
processOf() {  # TASK
  local work
  work="$(ls -d "$set"/.work/"${scans}_$1".*)"
  echo "${work##*.}"
}
endStepOf() {  # PROCESS: kills its slurmstepd; one that nobody has waited for yet has no children any more either
  local step
  step="$(ps -o ppid= -p "$1" | tr -d ' ')"
  kill -9 "$step"
  while ps -o stat= -p "$step" | grep -qv Z; do sleep 0.01; done
}
finish() {  # waits for the last job
  local state
  for _ in $(seq 1200); do
    state="$(stateOf "$manifest")"
    case "$state" in
      COMPLETED) return ;;
      FAILED | CANCELLED | TIMEOUT | NODE_FAIL) die "the manifest's job is $state" ;;
    esac
    hurry
    sleep 0.25
  done
  die "the array does not end: $(tasks)"
}
same() {  # what the set is, beside the plain run
  cmp "$d/plain/SHA256SUMS" "$set/SHA256SUMS" || die "$1: other bytes"
  (cd "$set" && sha256sum --quiet -c SHA256SUMS) || die "$1: sums"
  "$program" dataset verify "$set" --json >"$d/verify.json" 2>/dev/null || die "$1: verify: $(cat "$d/verify.json")"
  if grep -q '"missing"\|"damaged"\|"unknown"' "$d/verify.json"; then die "$1: $(cat "$d/verify.json")"; fi
  if [ -n "$(find "$set" -name '*.part*')" ]; then die "$1: left $(find "$set" -name '*.part*')"; fi
  echo "$1: the same $(wc -l <"$set/SHA256SUMS") files, $(($(date +%s) - started)) s${2:+; $2}"
}
begin() { set="$d/set-$1"; started="$(date +%s)"; }

stations=8 shards=(2 4) sizes=(1 2 4)
[ -z "$quick" ] || stations=2 shards=(2) sizes=(1 2)
cat >"$d/recipe.json" <<JSON
{"format": "standpoint-dataset", "recipe_version": 1, "name": "array", "license": "CC0-1.0", "creator": "a test",
 "date": "2026-01-31", "environments": [{"id": "house", "model": "$model"}],
 "stations": [{"strategy": "grid", "spacing_m": 1, "count": $stations}],
 "instruments": [{"id": "focus", "instrument": "faro-focus-s350", "set": ["resolution=1/32", "quality=4x"]}],
 "effects": [{"id": "noisy"}, {"id": "ideal", "ideal": true}],
 "splits": {"train": ["house"]}, "classes": ["s3dis"]}
JSON
set="$d/plain" started="$(date +%s)"
"$program" dataset run "$d/recipe.json" -o "$set" --json >"$d/run.json" 2>/dev/null || die "$(cat "$d/run.json")"
same "plain run"
for n in "${shards[@]}"; do
  begin "shards-$n"
  for i in $(seq "$n" -1 1); do
    "$program" dataset run "$d/recipe.json" -o "$set" --shard "$i/$n" >/dev/null 2>&1 || die "shard $i/$n"
  done
  "$program" dataset manifest "$set" >/dev/null 2>&1 || die "manifest of $n shards"
  for i in $(seq "$n"); do
    "$program" dataset verify "$set" --shard "$i/$n" >/dev/null 2>&1 || die "verify of shard $i/$n"
  done
  same "plain run in $n shards"
done

started="$(date +%s)"
up
echo "a controller and $nodes nodes are up: $(sinfo --version), $(($(date +%s) - started)) s"
for n in "${sizes[@]}"; do
  begin "array-$n"
  submit "$set" "$n"
  finish
  same "array of $n"
done

begin requeued
submit "$set" $((stations / 2))  # four scans a task
begun 1
scontrol requeue "${scans}_1"
finish
same "task 1 requeued" "$(sed -n 's/.*cancelled.*/its first start ended by TERM/p' "$set"/slurm/*-1.log | head -n 1)"
[ -n "$quick" ] && exit 0

begin drained
submit "$set" 8
begun 1
node="$(tasks | awk '$2 == "RUNNING" { print $4; exit }')"
scontrol update nodename="$node" state=drain reason=test
finish
[ "$(sinfo -h -n "$node" -o %T)" = drained ] || die "$node is $(sinfo -h -n "$node" -o %T)"
scontrol update nodename="$node" state=resume
same "node drained" "$node"
allIdle

# The scripts of a node that dies live on. This one is stopped until its twin is at work, so that both write at once.
begin died
submit "$set" 2
begun 2
node="$(tasks | awk -v task="${scans}_2" '$1 == task { print $4 }')"
orphan="$(processOf 2)"
endStepOf "$orphan"
kill -STOP "$orphan"  # not before: who stands still when its parent dies is hung up
if [ "$(tasks | awk -v task="${scans}_1" '$1 == task { print $4 }')" = "$node" ]; then
  endStepOf "$(processOf 1 2>/dev/null)" 2>/dev/null || true  # it may have ended
fi
kill -9 "$(pidIn "slurmd-$node")"
for _ in $(seq 600); do
  case "$(sinfo -h -n "$node" -o %T)" in down*) break ;; esac
  sleep 0.2
done
lost=$(($(date +%s) - started))
for _ in $(seq 600); do
  hurry
  ls -d "$set"/.work/"${scans}_2".1.* >/dev/null 2>&1 && break
  sleep 0.2
done
ls -d "$set"/.work/"${scans}_2".1.* >/dev/null 2>&1 || die "the task of the dead node does not start again"
kill -0 "$orphan" || die "the dead node's script has ended"
kill -CONT "$orphan"
finish
for _ in $(seq 300); do kill -0 "$orphan" 2>/dev/null || break; sleep 0.2; done
kill -0 "$orphan" 2>/dev/null && die "the dead node's script does not end"
orphan=
same "node died" "$node was down after $lost s; its script and the task that took its place wrote at once"
slurmd -f "$SLURM_CONF" -N "$node"
allIdle

# What it was given less than some seconds ago is not on its disk yet: it would know nothing of it.
begin controller
submit "$set" 8
touch "$d/submitted"
for _ in $(seq 300); do [ "$d/state/job_state" -nt "$d/submitted" ] && break; sleep 0.1; done
running="$(tasks | grep -c RUNNING || true)"
# Stopped for that time: of one that ends meanwhile Slurm 22.05 may go on to say that it runs, for minutes at least.
at_work=()
for work in "$set"/.work/*; do at_work+=("${work##*.}"); done
kill -STOP "${at_work[@]}" 2>/dev/null || true
kill -9 "$(pidIn slurmctld)"
sleep 1
slurmctld -f "$SLURM_CONF"
for _ in $(seq 100); do scontrol ping >/dev/null 2>&1 && break; sleep 0.2; done
kill -CONT "${at_work[@]}" 2>/dev/null || true
finish
same "controller killed and started again" "$running tasks were running"

begin cancelled
submit "$set" 4
for _ in $(seq 600); do [ -z "$(find "$set/records" -name '*.json' 2>/dev/null)" ] || break; sleep 0.1; done
scancel "$scans"
for _ in $(seq 100); do [ -z "$(tasks)" ] && break; sleep 0.2; done
made="$(find "$set/records" -name '*.json' 2>/dev/null | wc -l)"
[ -z "$(ls "$set/.work")" ] || die "a cancelled task left $(ls "$set/.work")"
if "$program" dataset verify "$set" >/dev/null 2>&1; then die "half a set is whole"; fi
resubmit "$set"
finish
same "array cancelled and submitted again" "$made of $((2 * stations)) scans were kept"

begin failed
"$program" dataset slurm "$d/recipe.json" -o "$set" --shards 4 --threads 1 >/dev/null
STANDPOINT=/bin/false resubmit "$set"
for _ in $(seq 200); do
  [ "$(stateOf "$manifest")" = CANCELLED ] && break
  sleep 0.2
done
[ "$(stateOf "$manifest")" = CANCELLED ] || die "the manifest of a failed array is $(stateOf "$manifest")"
resubmit "$set"
finish
same "array failed and submitted again" "its first manifest job was cancelled"
