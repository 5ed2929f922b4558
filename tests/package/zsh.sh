#!/usr/bin/env bash
# zsh.sh FOLDER: what becomes of a line that is typed into zsh, followed by the tabulator; FOLDER holds _terrabench, which zsh
# finds there, or which is sourced.
set -euo pipefail
command -v zsh >/dev/null || { echo "skipped: no zsh" && exit 77; }
exec timeout 60 zsh -f -s "$(realpath "$1")" <<'END'
zmodload zsh/zpty
begin() { # a shell in which Ctrl-T prints the line
  zpty shell zsh -f -i
  zpty -w shell "PS1= PS2= TERM=dumb; show() { print -r -- \"LINE<\$BUFFER>\" }; zle -N show; bindkey ^T show"
  zpty -w shell "autoload -Uz compinit; $1; print RE''ADY"
  zpty -r -m shell seen '*READY*'
}
expect() {
  local typed=$1 becomes=$2 seen line
  zpty -n -w shell $typed$'\t\x14'
  zpty -r -m shell seen '*LINE<*>*'
  line=${${seen##*LINE<}%>*}
  [[ $line == $becomes ]] || { print -r -- "zsh: '$typed' becomes '$line', not '$becomes'"; exit 1 }
  zpty -n -w shell $'\x15' # clears the line
}
for load in "fpath=($1 \$fpath); compinit -D -u" "compinit -D -u; source $1/_terrabench"; do
  begin $load
  expect 'terrabench repre' 'terrabench represent '
  expect 'terrabench represent jacksboro --as he' 'terrabench represent jacksboro --as heightmap '
  expect 'terrabench run --profile pa' 'terrabench run --profile paper '
  expect 'terrabench run mrbsp.w' 'terrabench run mrbsp.walk '
  expect 'terrabench run --profile=pa' 'terrabench run --profile=paper '
  expect 'terrabench check --verb' 'terrabench check --verbose '
  zpty -d shell
done
END
