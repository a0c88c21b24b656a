#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# try_package.sh [--base FOLDER] [--keep] DEB: installs the package in a clean root of this release of Debian and does the
# main job from it as a plain user, with times; tries the .tar.zst and Python's package beside it, too. Needs root or sudo. Exit code 5: no clean
# root could be made, for want of Debian's packages, so nothing was tried.
#   --base FOLDER   the bare root is made here once and copied from here the next time
#   --keep          leaves the root that was tried
set -euo pipefail
((EUID == 0)) || exec sudo "$0" "$@"
# Mounts of its own, which end with it.
[[ -n ${STANDPOINT_OWN_MOUNTS:-} ]] || STANDPOINT_OWN_MOUNTS=1 exec unshare --mount "$0" "$@"

base="" keep="" deb=""
while (($# > 0)); do
  case $1 in
    --base) base=$(realpath -m -- "$2"); shift ;;
    --keep) keep=1 ;;
    *) deb=$(realpath -- "$1") ;;
  esac
  shift
done
[[ -f $deb ]] || { echo "usage: try_package.sh [--base FOLDER] [--keep] DEB" >&2; exit 2; }
source "$(dirname "$0")/prepare.sh"
install_missing packages-delivery.txt

work=$(mktemp -d)
chmod 755 "$work"
root=$work/root
finish() {
  local status=$?
  ((status == 0)) || echo "try_package: failed" >&2
  mountpoint -q "$root/proc" && umount "$root/proc"
  if [[ -n $keep ]]; then echo "The root is in $root"; else rm -rf "$work"; fi
}
trap finish EXIT
say() { printf '%-34s %s\n' "$1" "$2"; }
took() { echo "$((SECONDS - since)) s"; }
in_root() {
  chroot "$root" /usr/bin/env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive \
    ${http_proxy:+http_proxy="$http_proxy"} "$@"
}
as_user() { in_root setpriv --reuid surveyor --regid surveyor --clear-groups env HOME=/home/surveyor "$@"; }
fail() { echo "try_package: $*" >&2; exit 3; }

codename=$(sed -n 's/^VERSION_CODENAME=//p' /etc/os-release)
since=$SECONDS
if [[ -n $base && -d $base/usr ]]; then
  cp -a "$base" "$root"
else
  # From where this machine gets its packages.
  mirror=$(apt-get indextargets --format '$(REPO_URI)' "Codename: $codename" "Created-By: Packages" | sort -u | head -1)
  debootstrap --variant=minbase "$codename" "$root" ${mirror:+"$mirror"} >"$work/log" 2>&1 || { cat "$work/log" >&2; exit 5; }
  [[ -z $base ]] || cp -a "$root" "$base"
fi
cp /etc/resolv.conf "$root/etc/resolv.conf"
mount -t proc proc "$root/proc"
in_root useradd --create-home surveyor
say "clean root ($codename)" "$(took)"

# The archive, in a place that nothing was told of.
archive=$(ls "${deb%/*}"/*.tar.zst 2>/dev/null) || true
if [[ -n $archive ]]; then
  mkdir -p "$root/srv/any where"
  (cd "$root/srv/any where" && cmake -E tar xf "$archive")
  unpacked="/srv/any where/$(ls "$root/srv/any where")"
  status=0
  as_user "$unpacked/standpoint" --version >"$work/said" 2>&1 || status=$?
  [[ $status == 4 ]] && grep -q "apt-get install.* libembree" "$work/said" ||
    fail "the archive does not name what is missing: $(cat "$work/said")"
  say "archive without libraries" "exit 4, names $(sed -n 's/.*apt-get install //p' "$work/said" | wc -w) packages"
fi

since=$SECONDS
in_root apt-get update -qq || exit 5
cp "$deb" "$root/opt/standpoint.deb"
packages=$(in_root apt-get -s install --no-install-recommends /opt/standpoint.deb | grep -c ^Inst)
in_root apt-get install -y --no-install-recommends /opt/standpoint.deb >"$work/log" 2>&1 || { cat "$work/log" >&2; exit 4; }
in_root apt-get clean
installed=$SECONDS
say "install" "$(took), $packages packages, $(sed -n 's/^Need to get \([^/]*\).* of archives.*/\1/p' "$work/log")"

mkdir -p "$root/home/surveyor/job/scripts"
cp scripts/headless.sh "$root/home/surveyor/job/scripts"
in_root chown -R surveyor:surveyor /home/surveyor
house=/usr/share/standpoint/samples/house.ifc
as_user STANDPOINT_BIN=/usr/bin /home/surveyor/job/scripts/headless.sh "$house" >"$work/log" 2>&1 ||
  { cat "$work/log" >&2; fail "the main job"; }
out=$root/home/surveyor/job/out
points=$(as_user standpoint info /home/surveyor/job/out/scan.e57 --json | grep -o '"points":[0-9]*' | head -1)
[[ ${points#*:} -gt 1000000 ]] || fail "the scan has too few points: $points"
pictures=("$out"/pictures/*.png)
((${#pictures[@]} > 5)) || fail "the editor drew ${#pictures[@]} pictures"
first_scan=$(($(stat -c %Y "$out/scan.e57") - $(date +%s) + SECONDS))
say "main job" "$((SECONDS - installed)) s, ${points#*:} points, ${#pictures[@]} pictures of the editor"
say "from the .deb to the first scan" "$((first_scan - since)) s"

if [[ -n $archive ]]; then
  as_user "$unpacked/standpoint" instruments --json | grep -qF "$unpacked/share/standpoint" ||
    fail "the archive does not find its own data"
  as_user "$unpacked/standpoint-editor" --help >/dev/null
  say "archive with libraries" "finds its own data"
fi
python=$(ls "${deb%/*}"/python3-standpoint_*.deb 2>/dev/null) || true
if [[ -n $python ]]; then
  since=$SECONDS
  cp "$python" "$root/opt/python3-standpoint.deb"
  in_root apt-get update -qq || exit 5
  in_root apt-get install -y --no-install-recommends /opt/python3-standpoint.deb >"$work/log" 2>&1 ||
    { cat "$work/log" >&2; exit 4; }
  in_root apt-get clean
  read_by_python=$(as_user python3 -c 'import standpoint
print(sum(map(len, standpoint.read_cloud("/home/surveyor/job/out/scan.e57"))), len(standpoint.instruments()["instruments"]))')
  [[ $read_by_python == "${points#*:} "[1-9]* ]] || fail "Python reads $read_by_python of ${points#*:} points"
  say "Python's package" "$(took) with what it needs, reads ${read_by_python% *} points"
  in_root apt-get purge -y python3-standpoint >/dev/null 2>&1
fi
in_root apt-get purge -y standpoint >/dev/null 2>&1
left=$(find "$root/usr" "$root/etc" -iname '*standpoint*')
[[ -z $left ]] || fail "left behind: $left"
say "removed" "nothing left"
