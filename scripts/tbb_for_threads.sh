#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# tbb_for_threads.sh FOLDER: makes FOLDER/libtbb.so.12 from Debian's own source of the installed libtbb, instrumented for
# ThreadSanitizer: with an uninstrumented one, every hand-over of work looks like a race. Exit code 5: the source cannot be had.
set -euo pipefail
folder=$(realpath -m "$1")
wanted=$(dpkg-query -W -f='${source:Package}=${source:Version}' libtbb-dev)
[[ $(cat "$folder/made-from" 2>/dev/null) == "$wanted" ]] && exit 0
rm -rf "$folder"
mkdir -p "$folder/lists"
cd "$folder"

# The machine's own mirrors, asked for sources, in lists of our own.
apt_here() {
  apt-get -qq -o Dir::Etc::SourceList="$folder/sources.list" -o Dir::Etc::SourceParts=- \
    -o Dir::State::Lists="$folder/lists" -o APT::Sandbox::User=root "$@"
}
apt-get indextargets --format 'deb-src [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] $(SITE) $(CODENAME) main' \
  'Created-By: Packages' 'Component: main' 'Origin: Debian' | sort -u >sources.list
{ apt_here update && apt_here source --download-only "$wanted"; } >apt.log 2>&1 || { cat apt.log >&2; exit 5; }
dpkg-source --no-check -x ./*.dsc source >/dev/null

cmake -S source -B build -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER=clang++ \
  -DTBB_SANITIZE=thread -DTBB_TEST=OFF -DTBB_STRICT=OFF -DTBBMALLOC_BUILD=OFF >build.log
cmake --build build >>build.log || { tail -30 build.log >&2; exit 1; }
find build -name 'libtbb*.so.12*' -exec cp -a {} . \;
[[ -e libtbb.so.12 ]] || ln -s libtbb_*.so.12 libtbb.so.12
rm -rf lists build source ./*.tar.* ./*.dsc
echo "$wanted" >made-from
