#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Kills the editor and each verb that writes a project at random moments, and looks at what is left.
# Usage: scripts/kills.sh [KILLS [SEED]]     200 kills each by default; the seed is the day's
cd "$(dirname "$0")/.." || exit 1
export STANDPOINT_KILLS="${1:-200}" STANDPOINT_KILL_SEED="${2:-$(date +%Y%m%d)}"
bin=build/release/bin
failed=0
"$bin/test_editor" --gtest_filter='KilledEditor.*' --gtest_brief=1 || failed=1
"$bin/test_cli" --gtest_filter='*KilledVerb*' --gtest_brief=1 || failed=1
exit "$failed"
