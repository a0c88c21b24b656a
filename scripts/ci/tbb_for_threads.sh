#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# tbb_for_threads.sh FOLDER: builds this Debian's oneTBB from its source package with the thread sanitizer, and prints the
# folder of the library. The packaged one has fences that the sanitizer cannot see: 88 false reports in a correct program,
# and every suppression that silences them also hides real races in what TBB runs.
set -euo pipefail
mkdir -p "$1"
folder=$(cd "$1" && pwd)
version=$(dpkg-query -W -f='${source:Version}' libtbb-dev)
if [[ -f $folder/version && $(<"$folder/version") == "$version" ]]; then
  cat "$folder/place"
  exit
fi
rm -rf "$folder"
mkdir -p "$folder/lists/partial"
source /etc/os-release
printf 'deb-src http://deb.debian.org/debian %s main\ndeb-src http://deb.debian.org/debian-security %s-security main\n' \
  "$VERSION_CODENAME" "$VERSION_CODENAME" >"$folder/sources.list"
cd "$folder"
options=(-o Dir::Etc::sourcelist="$folder/sources.list" -o Dir::Etc::sourceparts=- -o Dir::State::lists="$folder/lists"
  -o APT::Sandbox::User=root -qq)
{
  apt-get "${options[@]}" update
  apt-get "${options[@]}" source --download-only "onetbb=$version"
  dpkg-source -x onetbb_*.dsc source
  cmake -G Ninja -S source -B build -DCMAKE_BUILD_TYPE=RelWithDebInfo -DTBB_SANITIZE=thread -DTBB_STRICT=OFF \
    -DTBB_TEST=OFF -DTBBMALLOC_BUILD=OFF
  cmake --build build --target tbb
} >"$folder/log" 2>&1 || { tail -30 "$folder/log" >&2; exit 1; }
place=$(dirname "$(find "$folder/build" -name 'libtbb.so.12*' -print -quit)")
printf '%s\n' "$place" | tee "$folder/place"
printf '%s\n' "$version" >"$folder/version"
