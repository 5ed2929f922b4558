#!/usr/bin/env bash
# manual.sh PAGE: the manual page has every command with its options and examples, and formats without a warning.
set -euo pipefail
page=$(zcat "$1" | sed 's/\\-/-/g')
commands=$(terrabench --help | sed -n '/^Subcommands:/,/^$/ s/^  \([a-z][a-z]*\) .*/\1/p')
[[ $commands == *represent* ]]
for command in $commands; do
  section=$(sed -n "/^\.SS terrabench $command /,/^\.S/p" <<<"$page")
  options=$(terrabench "$command" --help | grep -o -e '^  -h,--help' -e '^  --[a-z-]*' -e '^  terrabench .*')
  while read -r option; do
    [[ $section == *"${option/,/, }"* ]] || { echo "$command: the page lacks $option" && exit 1; }
  done <<<"$options"
done
[[ $page == *'.SH EXIT STATUS'* ]]

command -v man >/dev/null || { echo "skipped: no man" && exit 77; }
warnings=$(man --warnings=all -l "$1" 2>&1 >/dev/null)
[[ -z $warnings ]] || { echo "$warnings" && exit 1; }
