# SPDX-License-Identifier: GPL-3.0-or-later
# Sourced by prepare.sh: shows how far an installation or a build has come, and the time that is left. On a terminal one
# line that is redrawn; elsewhere a line every ten seconds.

progress_shown=0  # SECONDS of the last line elsewhere

show_progress() {  # show_progress TEXT
  if [[ -t 1 ]]; then
    printf '\r\033[K%s' "${1:0:$((${COLUMNS:-80} - 1))}"
  elif ((SECONDS - progress_shown >= 10)); then
    progress_shown=$SECONDS
    printf '%s\n' "$1"
  fi
}

clear_progress() { [[ ! -t 1 ]] || printf '\r\033[K'; }

time_left() {  # time_left SECONDS
  if (($1 >= 90)); then
    echo "about $((($1 + 30) / 60)) min left"
  elif (($1 > 0)); then
    echo "about $1 s left"
  else
    echo "nearly done"
  fi
}

# Reads APT's status lines (dlstatus:N:PERCENT:text, pmstatus:PACKAGE:PERCENT:text).
follow_apt() {  # follow_apt PACKAGES
  local kind name percent rest phase="" since=$SECONDS left=""
  while IFS=: read -r kind name percent rest; do
    [[ $kind == [dp][lm]status && $percent =~ ^[0-9] ]] || continue
    [[ $kind == "$phase" ]] || { phase=$kind since=$SECONDS left=""; }
    percent=${percent%%.*}
    if ((percent > 2 && percent < 100)); then
      left=", $(time_left $(((SECONDS - since) * (100 - percent) / percent)))"
    fi
    if [[ $phase == dlstatus ]]; then
      show_progress "1 of 2 Downloading $1 packages: $percent %$left"
    else
      show_progress "2 of 2 Installing: $((percent * $1 / 100)) of $1 packages, $percent %$left"
    fi
  done
  clear_progress
}

# What a step of the build costs, in tenths of a second on one of the machine's jobs: the mean of its target as
# scripts/build_seconds.txt has it, 7 s where it does not.
declare -A build_cost
read_build_costs() {
  local target seconds
  while read -r target seconds; do build_cost[$target]=${seconds/./}; done < <(grep -v '^#' scripts/build_seconds.txt)
}
cost_of() {  # cost_of DESCRIPTION: into `cost`
  case $1 in
    Building*/CMakeFiles/*.dir/*)
      cost=${1##*/CMakeFiles/}
      cost=${build_cost[${cost%%.dir/*}]:-70}
      ;;
    *executable*) cost=15 ;;
    *) cost=2 ;;
  esac
}

# Reads what Ninja prints: its own lines become progress, all others (errors, warnings) are printed as they are.
# Ninja 1.11 knows no time left, and a share of steps says little where one takes a second and another a minute.
follow_ninja() {  # follow_ninja COST STEPS
  local whole=$1 steps=$2 jobs=$(($(nproc) + 1)) spent=0 done=0 begun=$SECONDS at=$SECONDS line="" shown=0
  local prior=$((whole / 8 + 1)) most=$((2 * jobs * whole / steps)) piece status cost rate now
  while :; do
    status=0
    IFS= read -r -t 1 piece || status=$?
    line+=$piece
    if ((status < 128)) && [[ $line =~ ^\[[0-9]+/[0-9]+\]\ (.*)$ ]]; then
      cost_of "${BASH_REMATCH[1]}"
      spent=$((spent + cost)) done=$((done + 1)) at=$SECONDS
    elif ((status == 0)) || [[ $status -lt 128 && -n $line ]]; then
      clear_progress
      printf '%s\n' "$line"
    fi
    ((status > 128)) || line=""  # after a time-out the rest of the line follows
    ((status == 0 || status > 128)) || break
    # Hundredths of cost a second; first as the table says, for an eighth of the whole. Between two steps it goes on as
    # fast, at most by what all jobs can have under way.
    rate=$(((spent + prior) * 100 / (at - begun + prior / jobs / 10 + 1) + 1))
    now=$(((SECONDS - at) * rate / 100))
    now=$((spent + (now < most ? now : most)))
    now=$((now < whole ? now : whole))
    shown=$((now * 99 / whole > shown ? now * 99 / whole : shown))
    show_progress "Building: $shown %, $done of $steps steps, $(time_left $(((whole - now) * 100 / rate)))"
  done
  clear_progress
}
