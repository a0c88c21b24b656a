#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# addresses.sh: the sanitizers of addresses and undefined behaviour over every test, the hostile files among them.
set -euo pipefail
cd "$(dirname "$0")/../.."
[[ -f build/asan/build.ninja ]] || cmake --preset asan >/dev/null
cmake --build build/asan
export ASAN_OPTIONS=detect_leaks=1:strict_string_checks=1 UBSAN_OPTIONS=print_stacktrace=1
export LSAN_OPTIONS=suppressions=$PWD/scripts/ci/leaks.supp
ctest --test-dir build/asan --output-on-failure -j "$(nproc)" --timeout 600
