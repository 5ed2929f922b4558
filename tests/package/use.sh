#!/usr/bin/env bash
# Run by scripts/test-package in a bare Debian: installs terrabench.deb, which lies beside this file, and uses it.
set -euo pipefail
cd "$(dirname "$0")"
export DEBIAN_FRONTEND=noninteractive
apt_get() { apt-get -qq -o Dpkg::Use-Pty=0 install --no-install-recommends "$@" >/dev/null; }
apt_get ./terrabench.deb

set -x
terrabench --version
terrabench list terrains | grep jacksboro
terrabench represent jacksboro --as heightmap --crop 100 100 65 49 --save my.tif --render my.png
terrabench run 'mrbsp.pro*' --out out
terrabench check out >/dev/null
terrabench report out
test -s out/report/index.html
for page in docs/commands.md examples/own_method.cpp experiments/mrbsp/claims.toml lod/camera/paths/fly.toml copyright; do
  test -s "/usr/share/doc/terrabench/$page"
done

# Two methods side by side along a recorded path, on a display of this test's own, then measured along it.
code=0
terrabench view my.tif 2>no-display.txt || code=$?
((code == 4))
grep 'terrabench render' no-display.txt
apt_get xvfb xauth man-db zsh
printf 'wait\nkey R\nkey W 30\nkey R\nframes 10\npicture seen.png\n' >session.txt
xvfb-run -a terrabench view my.tif --lod roam --lod geomipmap --script session.txt
test -s seen.png
terrabench render my.tif --path path-1.toml --frames 2 --size 320x200 --out flight
terrabench run cross.lod-equal-error 'my.tif/roam/*' --terrain my.tif --set path=path-1.toml --out along

./manual.sh /usr/share/man/man1/terrabench.1.gz
./bash.sh /usr/share/bash-completion/completions/terrabench
./zsh.sh /usr/share/zsh/vendor-completions
