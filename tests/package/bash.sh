#!/usr/bin/env bash
# bash.sh SCRIPT: what bash offers after the words given, the last of which is being typed.
set -euo pipefail
source "$1"
expect() {
  local offers=$1
  shift
  COMP_WORDS=(terrabench "$@") COMP_CWORD=$# COMPREPLY=()
  _terrabench
  [[ ${COMPREPLY[*]} == "$offers" ]] || { echo "bash: '$*' offers '${COMPREPLY[*]}', not '$offers'" && exit 1; }
}
expect 'report represent' rep
expect 'run' --allow-network ru
expect 'paper' run --profile pa
expect 'paper' run --profile = pa
expect 'quick paper scale' run --profile =
expect '--threads' render caves --thr
expect 'egl' render caves --renderer eg
expect 'heightmap' represent jacksboro --as he
expect 'caves canyon cactus cactus_smooth candle_holder' represent ca
expect 'roam rtin' view caves --lod r
expect 'mrbsp.walk' run mrbsp.w
expect 'export' help ex
expect '' represent jacksboro --save my # a file, which bash itself completes

# What `list` offers is written by hand.
COMP_WORDS=(terrabench list '') COMP_CWORD=2
_terrabench
((${#COMPREPLY[@]} > 10))
for what in "${COMPREPLY[@]}"; do terrabench list "$what" >/dev/null; done
