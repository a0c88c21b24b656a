#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# package.sh: builds the .deb packages and the .tar.zst into build/release/packages/, and checks them.
source "$(dirname "$0")/prepare.sh"
install_missing packages.txt packages-delivery.txt
build installable
packages=build/release/packages
rm -rf "$packages"
mkdir -p "$packages"
cpack --config build/release/CPackConfig.cmake >"$packages/cpack.log" 2>&1 || { cat "$packages/cpack.log" >&2; exit 3; }
rm -r "$packages/cpack.log" "$packages/_CPack_Packages"
debs=("$packages"/*.deb)

tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
for deb in "${debs[@]}"; do dpkg-deb --extract "$deb" "$tree"; done
for program in "$tree"/usr/bin/* "$tree"/usr/lib/python3/dist-packages/standpoint/*.so; do
  if grep -qF "$PWD" "$program"; then
    echo "${program##*/}: has the path of its source in it" >&2
    exit 3
  fi
done
desktop-file-validate "$tree"/usr/share/applications/*.desktop
appstreamcli validate --no-net "$tree"/usr/share/metainfo/*.xml
as_user=()
((EUID != 0)) || as_user=(setpriv --reuid nobody --regid nogroup --clear-groups env HOME="$tree")  # lintian refuses root
chmod -R go+rX "$tree"
cp "${debs[@]}" "$tree"
"${as_user[@]}" lintian --fail-on error,warning --tag-display-limit 0 "$tree"/*.deb
for deb in "${debs[@]}"; do dpkg-deb --info "$deb" | grep -E '^ (Package|Version|Installed-Size|Depends):'; done
ls -l "$packages"
