#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# style.sh: what a machine can say of the style, in under a minute: format, long lines, words that no user should read.
# The arrows between folders are a test (tests/core/arrows_test.cpp), because they need no tool.
set -euo pipefail
cd "$(dirname "$0")/.."
mapfile -t sources < <(git ls-files '*.cpp' '*.h')
wrong=0

printf '%s\n' "${sources[@]}" | xargs -P "$(nproc)" -n 64 clang-format --dry-run -ferror-limit=1 --Werror || {
  echo "Format: run clang-format -i on the files above."
  wrong=1
}

long=$(python3 - "${sources[@]}" <<'PY'
import sys
for path in sys.argv[1:]:
    for number, line in enumerate(open(path, encoding='utf-8'), 1):
        if len(line.rstrip('\n')) > 120:
            print(f'{path}:{number}: {len(line) - 1} columns')
PY
)
[[ -z $long ]] || { printf '%s\nLines: at most 120 columns.\n' "$long"; wrong=1; }

# Tests run side by side, also those of two checkouts.
fixed=$(git grep -nE 'testing::TempDir\(|temp_directory_path\(' -- 'tests/*_test.cpp' 'tests/*/test_*.cpp' || true)
[[ -z $fixed ]] || { printf '%s\nPlaces: a test writes into a TemporaryFolder (tests/temporary_folder.h).\n' "$fixed"; wrong=1; }

# The glossary's list, one regular expression a line, searched for in the texts of the program and its screens.
python3 scripts/user_words.py || wrong=1
((wrong == 0)) && echo "style: ${#sources[@]} sources in order"
exit "$wrong"
