#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# threads.sh: the thread sanitizer over what runs on several threads: scans, the optimizer, the tasks of the editor.
set -euo pipefail
cd "$(dirname "$0")/../.."
tbb=$(scripts/ci/tbb_for_threads.sh build/tsan-tbb)
[[ -f build/tsan/build.ninja ]] || cmake --preset tsan >/dev/null
cmake --build build/tsan --target test_core test_optimizer test_scanners test_survey test_editor
export LD_LIBRARY_PATH=$tbb TSAN_OPTIONS="halt_on_error=1 second_deadlock_stack=1 suppressions=$PWD/scripts/ci/threads.supp"
ctest --test-dir build/tsan --output-on-failure -j "$(nproc)" --timeout 600 \
  -R '^(.*/)?(Task|LatestTask|Progress|RayEngine|Scan|Rays|Optimiz|Simplif|Collision|Walkable|Coverage|Plan)[A-Za-z]*\.'
