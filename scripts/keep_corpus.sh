#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# keep_corpus.sh [MORE_SEEDS]: takes what the fuzz targets of build/asan have learned, and files of MORE_SEEDS/<target>, into
# tests/fuzz/corpus: for each target as few and as small files as reach the same code, none above 8 KiB. MORE_SEEDS must be
# files of our own making, since they become part of the project.
set -euo pipefail
cd "$(dirname "$0")/.."
export ASAN_OPTIONS=detect_leaks=0
for program in build/asan/bin/fuzz_*; do
  name=${program##*/fuzz_}
  corpus=tests/fuzz/corpus/$name
  kept=build/asan/fuzz/$name/kept
  sources=("$corpus" "build/asan/fuzz/$name/corpus" ${1:+"$1/$name"})
  rm -rf "$kept"
  mkdir -p "$kept" "$corpus" "${sources[@]}"
  "$program" -merge=1 -timeout=60 -rss_limit_mb=2048 -max_len=8192 "$kept" "${sources[@]}" >"$kept.log" 2>&1 ||
    { tail -5 "$kept.log" >&2; exit 1; }
  rm -r "$corpus"
  mv "$kept" "$corpus"
  printf '%-12s %4d files, %4d KiB\n' "$name" "$(find "$corpus" -type f | wc -l)" "$(du -sk --apparent-size "$corpus" | cut -f1)"
done
