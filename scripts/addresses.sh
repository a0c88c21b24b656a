#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# addresses.sh [--all]: the tests with the address and undefined-behaviour sanitizers, each test program in one process, since
# starting a watched one takes as long as many of its tests. Without --all the programs stay out whose tests scan and optimise
# whole houses (project, emulated_ui, optimizer: hours of CPU), and the walks through all rooms. Those that run the program
# hundreds of times, to kill it or to let its disk fail, are run without sanitizers only.
set -euo pipefail
cd "$(dirname "$0")/.."
export filter='-KilledEditor.*:*KilledVerb.*:*Faults*:KilledScan.*'
long=(project emulated_ui optimizer)  # first, so that none of them is left alone at the end
all=false
[[ ${1:-} == --all ]] && all=true
$all || filter+=':WalkedBuildings.*'
cmake --preset asan >/dev/null
cmake --build --preset asan
export ASAN_OPTIONS=detect_stack_use_after_return=1:strict_string_checks=1 UBSAN_OPTIONS=print_stacktrace=1
export LSAN_OPTIONS="suppressions=$PWD/tests/leaks.supp:print_suppressions=0"

run() {  # run PROGRAM: its last lines where it fails
  local log=$1.log since=$SECONDS
  # Drivers of OpenGL are unloaded before the end: what they keep has no name left by which it could be suppressed.
  [[ $1 != *editor_viewport ]] || ASAN_OPTIONS+=:detect_leaks=0
  "$1" --gtest_brief=1 --gtest_filter="$filter" >"$log" 2>&1 || { tail -n 60 "$log"; echo "$1: failed"; return 1; }
  echo "$(basename "$1"): $((SECONDS - since)) s"
}
export -f run

programs=()
$all && programs=("${long[@]}")
for program in build/asan/bin/test_*; do
  name=${program##*/test_}
  [[ $name == *.log || " ${long[*]} " == *" $name "* ]] || programs+=("$name")
done
printf 'build/asan/bin/test_%s\n' "${programs[@]}" | xargs -P "$(nproc)" -I{} bash -c 'run {}'
