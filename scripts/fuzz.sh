#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# fuzz.sh [CTEST ARGUMENTS]: builds the fuzz targets (asan preset) and runs each for 20 s from its corpus. An hour of each:
# cmake --workflow --preset nightly.
set -euo pipefail
cd "$(dirname "$0")/.."
cmake --preset asan >/dev/null
cmake --build --preset asan --target fuzz
exec ctest --preset asan -L fuzz -j "$(nproc)" "$@"
