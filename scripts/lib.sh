# shellcheck shell=bash
# Functions that the scripts share. Source this file, do not run it: it sets root, and strict mode in the caller.
set -euo pipefail
export LC_ALL=C.UTF-8

root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd -P)

# git refuses to read a checkout that belongs to another user (a container's mount, a copy made as root), and the
# results would not know their revision. Trust this checkout, for this run and its children only.
if [[ -z ${GIT_CONFIG_COUNT:-} ]]; then
  export GIT_CONFIG_COUNT=1 GIT_CONFIG_KEY_0=safe.directory GIT_CONFIG_VALUE_0=$root
fi

note() { printf '\n== %s (%d s)\n' "$*" "$SECONDS"; }

# fail CODE MESSAGE: the codes are those of the program (2 wrong use, 4 environment).
fail() {
  printf '%s: %s\n' "${0##*/}" "$2" >&2
  exit "$1"
}

# Prints the comment that opens the script: its help.
usage() { sed -n '2,/^$/ { s/^# \{0,1\}//; /^$/ q; p }' "$0"; }

# How many compilers to run at once: one per core, if each has 1.5 GiB. The largest source needs 0.8 GiB, with a
# sanitizer 1.2 GiB.
compile_jobs() {
  local cores kib=0 limit
  cores=$(nproc)
  [[ -r /proc/meminfo ]] && kib=$(sed -n 's/^MemAvailable: *\([0-9]*\) kB/\1/p' /proc/meminfo)
  limit=$(cat /sys/fs/cgroup/memory.max 2>/dev/null || true)  # a container's; "max" when it has none
  if [[ $limit =~ ^[0-9]+$ ]] && ((kib == 0 || limit / 1024 < kib)); then kib=$((limit / 1024)); fi
  local fitting=$((kib / 1572864))
  if ((kib == 0 || fitting > cores)); then fitting=$cores; fi
  echo $((fitting > 0 ? fitting : 1))
}

# build PRESET [TARGET…]: configures and builds into build/PRESET; everything when no target is named.
build() {
  local preset=$1 jobs
  shift
  jobs=$(compile_jobs)
  note "configure build/$preset"
  cmake -S "$root" --preset "$preset" -Wno-dev
  note "build with $jobs jobs"
  cmake --build "$root/build/$preset" --parallel "$jobs" ${1:+--target "$@"}
}
