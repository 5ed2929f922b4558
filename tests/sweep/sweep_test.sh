#!/usr/bin/env bash
# Usage: sweep_test.sh PROGRAM SNAKEFILE FOLDER
# Runs a small sweep with Snakemake: kills it once, completes it, and compares it with the same run in one piece.
# Exits with 77 (skipped) where Snakemake is not installed.
set -euo pipefail
command -v snakemake >/dev/null || { echo "skipped: snakemake is not installed" && exit 77; }
program=$1 snakefile=$2 folder=$3
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"
export HOME=$folder XDG_CACHE_HOME=$folder/cache

ids='hybrid.kernels hybrid.fresnel hybrid.table2' options='--set n=16'
sweep() {
  snakemake --snakefile "$snakefile" --directory "$folder" --cores 2 --rerun-incomplete --retries 2 --quiet "$@" \
    --config out=sweep program="$program" shards=4 ids="$ids" options="$options" \
    claims="hybrid.F1 hybrid.F2 hybrid.fresnel"
}

sweep >killed.log 2>&1 &
sleep 3
pkill -KILL --parent $! || true # the shards, if they have begun
kill -KILL $! || true
wait || true
sweep --unlock >/dev/null
sweep

# shellcheck disable=SC2086
"$program" run $ids $options --out whole 2>/dev/null
"$program" compare whole sweep/merged | tail -3
records() { grep -c '"case"' "$1/measurements.jsonl"; }
[[ $(records whole) == "$(records sweep/merged)" ]]
[[ -s sweep/check.txt && -s sweep/merged/report/index.html ]]
