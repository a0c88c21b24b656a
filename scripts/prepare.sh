# SPDX-License-Identifier: GPL-3.0-or-later
# Sourced by ./run, ./test and .ci/run: installs what is missing, then configures and builds.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
source scripts/progress.sh

install_missing() {  # install_missing [LIST...]: what the lists name, packages.txt where none is given
  local wanted missing=()
  mapfile -t wanted < <(cat "${@:-packages.txt}" | sed 's/#.*//' | tr -s '[:space:]' '\n' | sed '/^$/d')
  local package
  for package in "${wanted[@]}"; do
    [[ $(dpkg-query -W -f='${Status}' "$package" 2>/dev/null) == "install ok installed" ]] || missing+=("$package")
  done
  ((${#missing[@]} == 0)) && return
  local as_root=()
  if ((EUID != 0)); then
    command -v sudo >/dev/null || { echo "These packages are missing; install them as root: ${missing[*]}" >&2; exit 4; }
    as_root=(sudo)
  fi
  echo "Missing ${#missing[@]} Debian packages: ${missing[*]}"
  "${as_root[@]}" apt-get update -qq
  local all log
  all=$(apt-get -s install --no-install-recommends "${missing[@]}" | grep -c ^Inst) || true
  log=$("${as_root[@]}" mktemp)  # root may not write another's file in /tmp
  # The status lines go into the pipe; sudo would close a descriptor opened here.
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive sh -c 'exec apt-get install "$@" 3>&1 >"$0" 2>&1' "$log" \
    -y --no-install-recommends -o APT::Status-Fd=3 -o Dpkg::Use-Pty=0 "${missing[@]}" | follow_apt "$all" ||
    { "${as_root[@]}" cat "$log" >&2; exit 4; }
  "${as_root[@]}" rm -f "$log"
  echo "Installed $all packages with what they need in $SECONDS s"
}

quietly() {  # quietly COMMAND...: what it prints only if it fails
  local said
  said=$("$@" 2>&1) || { printf '%s\n' "$said" >&2; exit 3; }
}

build() {  # build TARGET...
  local steps step whole=0 cost
  export NINJA_STATUS="[%f/%t] "
  if [[ -f build/release/build.ninja ]]; then
    quietly cmake --build build/release --target build.ninja
  else
    echo "Configuring the build"
    quietly cmake --preset release
  fi
  mapfile -t steps < <(cmake --build build/release --target "$@" -- -n | sed -n 's/^\[[0-9]*\/[0-9]*\] //p')
  ((${#steps[@]} > 0)) || return 0
  read_build_costs
  for step in "${steps[@]}"; do cost_of "$step"; whole=$((whole + cost)); done
  local since=$SECONDS
  cmake --build build/release --target "$@" | follow_ninja "$whole" "${#steps[@]}"
  echo "Built ${#steps[@]} steps in $((SECONDS - since)) s"
}
