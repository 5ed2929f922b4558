# shellcheck shell=bash
# Functions that the scripts share. Sourced, not run; sets root, and strict mode in the script that sources it.
set -euo pipefail
export LC_ALL=C.UTF-8

root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd -P)

# Git refuses to read a checkout that belongs to another user (a container's mount, a copy made as root), and the results
# would then lack their revision. This run and its children trust this checkout.
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

# fitting_jobs MIB: how many processes to run at once: one per core, but no more than the available memory holds if each
# needs so many MiB; at least one.
fitting_jobs() {
  local each=$(($1 * 1024)) cores kib=0 limit
  cores=$(nproc)
  [[ -r /proc/meminfo ]] && kib=$(sed -n 's/^MemAvailable: *\([0-9]*\) kB/\1/p' /proc/meminfo)
  limit=$(cat /sys/fs/cgroup/memory.max 2>/dev/null || true)  # a container's; "max" when it has none
  if [[ $limit =~ ^[0-9]+$ ]] && ((kib == 0 || limit / 1024 < kib)); then kib=$((limit / 1024)); fi
  local fitting=$((kib / each))
  if ((kib == 0 || fitting > cores)); then fitting=$cores; fi
  echo $((fitting > 0 ? fitting : 1))
}

# How many compilers to run at once. The largest source needs 0.8 GiB, and 1.2 GiB with a sanitizer.
compile_jobs() { fitting_jobs 1536; }

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
