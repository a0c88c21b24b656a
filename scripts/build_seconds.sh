#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# build_seconds.sh: rewrites scripts/build_seconds.txt from the log of a whole build in build/release that took nothing from
# a cache (CCACHE_DISABLE=1).
set -euo pipefail
cd "$(dirname "$0")/.."
table=scripts/build_seconds.txt
{
  grep '^#' "$table"
  awk -F '\t' '$4 ~ /\.o$/ && match($4, /CMakeFiles\/[^\/]*\.dir/) {
    target = substr($4, RSTART + 11, RLENGTH - 15); seconds[target] += $2 - $1; files[target]++
  }
  END { for (t in files) printf "%s %.1f\n", t, seconds[t] / files[t] / 1000 }' build/release/.ninja_log | sort
} >"$table.new"
mv "$table.new" "$table"
