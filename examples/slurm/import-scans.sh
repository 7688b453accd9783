#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
# Imports many scans on a cluster with Slurm, then measures all surfaces in one table.
#   import-scans.sh BODY LIST FOLDER [options of treadmark import ...]
# BODY: wheel or rail. LIST: a scan a line, named as nodes see it. FOLDER, which all nodes see, gets NAME.slcw or NAME.slcs of each scan,
# its audit NAME/, what was said of it (NAME.log), and measures.csv in the end. The same command again takes up only what is not imported yet.
# TASKS (100): the scans are shared by so many tasks at most. Options of sbatch go by its environment: SBATCH_PARTITION, SBATCH_TIMELIMIT, ...
set -eu

# Slurm starts this file too: --task BODY FOLDER OPTIONS..., --gather likewise.
action=submit
case ${1:-} in --task | --gather) action=${1#--}; shift ;; esac
if [ "$action" = submit ] && [ $# -lt 3 ]; then sed -n '5,8s/^# \{0,1\}//p' "$0" >&2; exit 2; fi
body=$1
case $body in wheel) kind=slcw ;; rail) kind=slcs ;; *) echo "a scan is of a wheel or a rail, not of '$body'" >&2; exit 2 ;; esac
shift
if [ "$action" = submit ]; then list=$1; shift; fi
folder=$1
shift
name() { basename "${1%.*}"; }

case $action in
submit)
  if [ -f "$folder/jobs" ] && [ -n "$(squeue -h -j "$(paste -sd, "$folder/jobs")" 2>/dev/null)" ]; then
    echo "jobs $(paste -sd' ' "$folder/jobs") of this folder still wait or run: scancel ends them" >&2
    exit 1
  fi
  mkdir -p "$folder"
  tr -d '\r' <"$list" | awk 'NF' >"$folder/scans"
  twice=$(while IFS= read -r scan; do name "$scan"; done <"$folder/scans" | sort | uniq -d | paste -sd' ')
  if [ -n "$twice" ]; then echo "several scans have the same name: $twice" >&2; exit 2; fi
  while IFS= read -r scan; do [ -e "$folder/$(name "$scan").done" ] || printf '%s\n' "$scan"; done <"$folder/scans" >"$folder/open"
  count=$(wc -l <"$folder/open") tasks=${TASKS:-100}
  if [ "$count" -eq 0 ]; then echo "all scans are imported"; exit 0; fi
  if [ "$count" -lt "$tasks" ]; then tasks=$count; fi
  array=$(sbatch --parsable --requeue --open-mode=append --array="0-$((tasks - 1))" --output="$folder/task_%a.out" \
    "$0" --task "$body" "$folder" "$@")
  gather=$(sbatch --parsable --dependency="afterany:${array%%;*}" --output="$folder/gather.out" "$0" --gather "$body" "$folder" "$@")
  printf '%s\n' "${array%%;*}" "${gather%%;*}" >"$folder/jobs"
  echo "$count scans in $tasks tasks of job ${array%%;*}; job ${gather%%;*} measures them"
  ;;
task)
  # Every n-th scan, so that long and short ones mix. One that fails keeps its message and does not stop the others.
  awk -v n="$SLURM_ARRAY_TASK_COUNT" -v i="$SLURM_ARRAY_TASK_ID" '(NR - 1) % n == i' "$folder/open" | while IFS= read -r scan; do
    out=$folder/$(name "$scan")
    if [ -e "$out.done" ]; then continue; fi
    if treadmark --quiet --threads "${SLURM_CPUS_PER_TASK:-1}" import "$scan" --body "$body" -o "$out.$kind" --report "$out" "$@" \
      >"$out.log" 2>&1 </dev/null; then : >"$out.done"; fi
  done
  ;;
gather)
  # The one option that both verbs need.
  while [ $# -gt 1 ] && [ "$1" != --nominal-radius ]; do shift; done
  if [ $# -gt 1 ]; then set -- "$1" "$2"; else set --; fi
  : >"$folder/surfaces"
  while IFS= read -r scan; do
    out=$folder/$(name "$scan")
    if [ -e "$out.done" ]; then printf '%s\n' "$out.$kind" >>"$folder/surfaces"; else echo "not imported: $scan, see $out.log"; fi
  done <"$folder/scans"
  imported=$(wc -l <"$folder/surfaces") scans=$(wc -l <"$folder/scans")
  echo "$imported of $scans scans imported"
  if [ "$imported" -gt 0 ]; then treadmark --quiet measure "$body" "@$folder/surfaces" "$@" --csv "$folder/measures.csv"; fi
  [ "$imported" -eq "$scans" ]
  ;;
esac
