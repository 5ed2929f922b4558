#!/usr/bin/env bash
# Usage: slurm_test.sh PROGRAM SNAKEFILE FOLDER
# Runs a small sweep through Slurm with the workflow's profile, kills a shard once, and compares the results with the same
# workflow's on one machine. Exits with 77 (skipped) where Snakemake or Slurm is not installed or cannot start.
set -euo pipefail
program=$1 snakefile=$2 folder=$3
command -v snakemake >/dev/null || { echo "skipped: snakemake is not installed" && exit 77; }

if [[ -z ${SLURM_CONF:-} ]]; then
  rm -rf "$folder" && mkdir -p "$folder"
  node=$(mktemp --directory /tmp/slurm.XXXX) # a short path, since it holds a socket
  trap 'rm -rf "$node"' EXIT
  "$(dirname -- "$0")/slurm_node.sh" "$node" "$0" "$@"
  exit
fi

export HOME=$folder XDG_CACHE_HOME=$folder/cache
cd "$folder"
sweep() {
  local out=$1 && shift
  snakemake --snakefile "$snakefile" --directory "$folder" --quiet "$@" --config out="$out" program="$program" \
    shards=2 ids='hybrid.noise-stages hybrid.fresnel hybrid.table2' options='--set pixels=16,n=16' mem_mb=500 minutes=5 claims=hybrid.fresnel
}

sweep slurm --profile "$(dirname -- "$snakefile")/slurm" --latency-wait 5 &
snakemake=$! job=
while [[ -z $job ]] && kill -0 $snakemake; do
  job=$(squeue --noheader --states=RUNNING --format=%i | head -1)
  sleep 0.1
done
[[ -n $job ]] || { echo "no job was seen running, so that none could be killed" && exit 1; }
scancel --signal=KILL "$job"
wait $snakemake
sweep local --cores "$(nproc)"

"$program" compare local/merged slurm/merged | tail -3
records() { grep -c '"case"' "$1/merged/measurements.jsonl"; }
[[ $(records slurm) == "$(records local)" ]]
[[ -s slurm/check.txt && -s slurm/merged/report/index.html ]]
jobs=$(squeue --states=all --noheader | wc -l)
echo "jobs that Slurm ran: $jobs"
# Four jobs at least: two shards, the second try of the killed one, and the job that merges, checks and reports.
((jobs >= 4))
