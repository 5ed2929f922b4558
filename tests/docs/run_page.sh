#!/usr/bin/env bash
# run_page.sh PAGE PROGRAM FOLDER: follows the links of a page, then runs the commands that it prints, its blocks fenced as
# sh, one after the other in FOLDER, with PROGRAM first in PATH. The first that fails ends it. A block fenced as console is not run; a comment
# above it, <!-- not run: REASON -->, says why, and is printed. <!-- file: NAME --> above a block of another language
# saves it under this name before the commands run. A block without a language holds no command.
set -euo pipefail
page=$(realpath "$1") program=$(realpath "$2") folder=$3
source=$(realpath "$(dirname "$0")/../..")
rm -rf "$folder" && mkdir -p "$folder" && cd "$folder"

awk -v name="${page#"$source/"}" '
  function fail(what) { printf "%s:%d: %s\n", name, NR, what >"/dev/stderr"; failed = 1; exit 1 }
  /^```/ && inside { inside = 0; language = ""; next }
  /^```/ {
    inside = 1
    language = substr($0, 4)
    if (language == "console" && reason == "") fail("say above it why it is not run: <!-- not run: REASON -->")
    if (language == "console") printf "%s:%d: not run: %s\n", name, NR, reason >"/dev/stderr"
  }
  !inside { reason = file = "" }
  !inside && /^<!-- not run: .+ -->$/ { reason = substr($0, 15, length($0) - 18) }
  !inside && /^<!-- file: [^\/]+ -->$/ { file = substr($0, 12, length($0) - 15) }
  inside && language == "" && /^(terrabench|scripts\/|cmake|cd) / { fail("fence commands as sh, or as console") }
  inside && !/^```/ && file != "" { print >file }
  inside && language == "sh" && !/^```/ { print }
  END { if (!failed && inside) fail("no end of the block") }
' "$page" >commands.sh

while read -r link; do
  [[ -e ${page%/*}/$link ]] || { echo "${page#"$source/"}: link to nothing: $link"; exit 1; }
done < <(grep -o ']([^)]*)' "$page" | sed 's/^](//; s/[)#].*//' | grep -v -e '^$' -e '://')

if [[ ! -s commands.sh ]]; then echo "no commands"; exit 0; fi
mkdir build && ln -s "$(dirname "$program")" build/release
export PATH=$PWD/build/release:$PATH

# What the pages say a reader has: an elevation model, and the checkout's results, here as a copy.
terrabench represent jacksboro --as heightmap --crop 100 100 65 49 --save my.tif >/dev/null
for kept in results/reference results/gpu; do
  grep -q "$kept" commands.sh || continue
  mkdir -p "$kept" && cp -r "$source/$kept"/{measurements.jsonl,figures} "$kept"
done
bash -euo pipefail -x commands.sh
