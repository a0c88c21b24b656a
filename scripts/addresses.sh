#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# addresses.sh [--all]: the tests with the address and undefined-behaviour sanitizers, each test program in one process,
# since starting a watched one takes as long as many of its tests. Without --all what scans and optimises whole houses stays
# out: the programs project, emulated_ui and optimizer (hours of CPU), the walks through all rooms, and the exercises that
# the pointer solves. Those that run the program hundreds of times, to kill it or to let its disk fail, are run without
# sanitizers only.
set -euo pipefail
cd "$(dirname "$0")/.."
export filter='-KilledEditor.*:*KilledVerb.*:*Faults*:KilledScan.*'
long=(project emulated_ui optimizer)  # first, so that none of them is left alone at the end
all=false
[[ ${1:-} == --all ]] && all=true
$all || filter+=':WalkedBuildings.*:*ByMouse*'
export ASAN_OPTIONS=detect_stack_use_after_return=1:strict_string_checks=1 UBSAN_OPTIONS=print_stacktrace=1
export LSAN_OPTIONS="suppressions=$PWD/tests/leaks.supp:print_suppressions=0"

run() {  # run PROGRAM
  local log=$1.log since=$SECONDS
  # Drivers of OpenGL are unloaded before the end: what they keep has no name left by which it could be suppressed.
  [[ $1 != *editor_viewport ]] || ASAN_OPTIONS+=:detect_leaks=0
  "$1" --gtest_brief=1 --gtest_filter="$filter" >"$log" 2>&1 || { echo "$(basename "$1"): failed"; return 1; }
  echo "$(basename "$1"): $((SECONDS - since)) s"
}

cmake --preset asan >/dev/null
# Those that read files of others come first: where the time ends before the tests do, they have been run.
programs=(core importers ifc geometry pointclouds materials survey samples scanners cli editor_viewport editor)
$all && programs=("${long[@]}" "${programs[@]}")
known=$(ninja -C build/asan -t targets all | grep -oP '^test_\w+(?=: phony)' | sort)
for name in ${known//test_/}; do
  [[ " ${programs[*]} ${long[*]} " == *" $name "* ]] || { echo "$0 leaves out test_$name"; exit 1; }
done

# Programs run while the next one is built.
declare -A running=()
for name in "${programs[@]}"; do
  cmake --build --preset asan --target "test_$name"
  while (($(jobs -rp | wc -l) >= $(nproc))); do sleep 1; done
  run "build/asan/bin/test_$name" &
  running[$name]=$!
done
failed=()
for name in "${programs[@]}"; do wait "${running[$name]}" || failed+=("$name"); done
# What failed comes last, where somebody who sees but the end of the output reads it.
for name in ${failed[@]+"${failed[@]}"}; do
  tail -n 60 "build/asan/bin/test_$name.log"
  grep -E '^\[  FAILED|^SUMMARY: |runtime error: |^==[0-9]+==ERROR' "build/asan/bin/test_$name.log" | head -20 || true
  echo "test_$name: failed"
done
((${#failed[@]} == 0))
