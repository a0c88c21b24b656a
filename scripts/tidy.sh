#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# tidy.sh [BASE]: clang-tidy (.clang-tidy) over what has changed since BASE, by default what is not yet on origin/main, or the last commit.
# tidy.sh --all:  over the whole program, about a quarter of an hour of CPU; the target `tidy` does the same.
# It reads what the release preset compiles: a unity source says what a dozen sources share only once.
set -euo pipefail
cd "$(dirname "$0")/.."
build=build/release
[[ -f $build/compile_commands.json ]] || cmake --preset release >/dev/null

base=""
if [[ ${1:-} != --all ]]; then
  # Where origin/main has it all, or there is none: the last commit. A shallow clone may have no other one.
  for base in ${1:-origin/main HEAD~1}; do
    base=$(git merge-base "$base" HEAD 2>/dev/null) && [[ $base != "$(git rev-parse HEAD)" ]] && break
    base=""
  done
  [[ -n $base ]] || { echo "tidy: no earlier commit to compare with; --all reads everything"; exit 0; }
fi

# Of tests and benchmarks nothing is asked. A changed header is read where its own source is, or else where it is
# included first.
mapfile -t units < <(python3 - "$build/compile_commands.json" "$base" <<'PY'
import json, os, re, subprocess, sys
database, base = sys.argv[1:]
here = os.getcwd() + '/'
sources = {}  # by the file that is compiled
for entry in json.load(open(database)):
    unit = os.path.relpath(entry['file'], here)
    if re.search(r'(^|/)(tests|bench)/', unit):
        continue
    together = re.findall(r'#include "(.*\.cpp)"', open(unit).read()) if '/Unity/' in unit else [unit]
    sources[unit] = [os.path.relpath(source, here) for source in together]
if not base:
    print(*sources, sep='\n')
    sys.exit()
unit_of = {source: unit for unit, together in sources.items() for source in together}
changed = subprocess.run(['git', 'diff', '--name-only', '--diff-filter=d', base, '--', '*.cpp', '*.h'],
                         capture_output=True, check=True, text=True).stdout.split()
chosen = set()
for path in changed:
    own = path[:-2] + '.cpp' if path.endswith('.h') else path
    users = [own] if own in unit_of or path.endswith('.cpp') else \
        [source for source in unit_of if f'#include "{path}"' in open(source).read()]
    chosen.update(unit_of[source] for source in users[:1] if source in unit_of)
if chosen:
    print(*sorted(chosen), sep='\n')
PY
)
if ((${#units[@]} == 0)); then
  echo "tidy: no source to read"
  exit 0
fi
# -Wno-restrict and its like are options of GCC alone.
printf '%s\n' "${units[@]}" | xargs -P "${TIDY_JOBS:-$(nproc)}" -n 1 clang-tidy -p "$build" --quiet \
  --warnings-as-errors='*' --extra-arg=-Wno-unknown-warning-option || {
  echo "tidy: findings above"
  exit 1
}
echo "tidy: ${#units[@]} of the compiled sources in order"
