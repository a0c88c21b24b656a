#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# fuzz.sh SECONDS [TARGET...]: each fuzz target from its kept corpus for so long, two at a time; what it finds lies in
# build/fuzz/found. fuzz.sh --keep does not run them: it adds what the runs have reached to the kept corpus, small files
# only.
set -euo pipefail
cd "$(dirname "$0")/../.."
kMostBytes=8192   # of a file of the corpus
kMostKept=300000  # of a target's, in bytes
[[ -f build/fuzz/build.ninja ]] || cmake --preset fuzz >/dev/null
seconds=$1
shift
cmake --build build/fuzz
mapfile -t targets < <(cd build/fuzz/bin && ls -d fuzz_* | sed 's/^fuzz_//')
(($# == 0)) || targets=("$@")

keep() {  # keep TARGET: the smallest files that reach what all reach
  local corpus=tests/fuzz/corpus/$1 merged=build/fuzz/merged/$1 kept=0 file
  rm -rf "$merged"
  mkdir -p "$merged" "$corpus"
  build/fuzz/bin/fuzz_"$1" -merge=1 -max_len=$kMostBytes "$merged" "$corpus" build/fuzz/reached/"$1" >/dev/null 2>&1
  rm -f "$corpus"/*
  while read -r file; do
    ((kept += $(stat -c %s "$file")))
    ((kept > kMostKept)) && break
    cp "$file" "$corpus"/
  done < <(ls -Sr "$merged"/*)
}

run() {  # run TARGET
  mkdir -p build/fuzz/{found,reached/"$1",logs} tests/fuzz/corpus/"$1"
  build/fuzz/bin/fuzz_"$1" -max_total_time="$seconds" -timeout=10 -rss_limit_mb=2048 -max_len=65536 \
    -artifact_prefix=build/fuzz/found/"$1"- build/fuzz/reached/"$1" tests/fuzz/corpus/"$1" \
    >build/fuzz/logs/"$1" 2>&1 ||
    { echo "fuzz_$1: found something; build/fuzz/found/$1-*"; tail -60 build/fuzz/logs/"$1"; return 1; }
  echo "fuzz_$1: $(grep -c . <(ls tests/fuzz/corpus/"$1")) kept files, $(sed -n 's/^Done \([0-9]*\) runs.*/\1 runs/p' build/fuzz/logs/"$1")"
}
export -f keep run
export seconds kMostBytes kMostKept
work=run
[[ $seconds == --keep ]] && work=keep
printf '%s\n' "${targets[@]}" | xargs -P "$(nproc)" -I{} bash -c "set -euo pipefail; $work {}"
