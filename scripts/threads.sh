#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# threads.sh [CTEST ARGUMENTS]: what runs in parallel (scan, optimise, the editor's tasks) under ThreadSanitizer, with a libtbb
# that is instrumented as well. Exit code 5: Debian's source of libtbb cannot be had here.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/tbb_for_threads.sh build/tsan-tbb
cmake --preset tsan >/dev/null
cmake --build --preset tsan
exec ctest --preset tsan -j "$(nproc)" "$@"
