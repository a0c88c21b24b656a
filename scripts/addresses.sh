#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# addresses.sh [CTEST ARGUMENTS]: builds everything with the address and undefined-behaviour sanitizers, and runs every test.
# It takes about an hour on two cores; `.ci/run` does not call it yet.
set -euo pipefail
cd "$(dirname "$0")/.."
cmake --preset asan >/dev/null
cmake --build --preset asan
exec ctest --preset asan -LE fuzz -j "$(nproc)" "$@"
