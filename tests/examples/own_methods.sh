#!/bin/sh
# own_methods.sh PROGRAM FOLDER: methods that a program adds from outside take part in every command, comparison,
# claim and page. They needed nothing but their own files (CONTRIBUTING.md).
set -eu
program=$1
rm -rf "$2" && mkdir -p "$2" && cd "$2"

has() {  # has FILE TEXT
  grep -q -e "$2" "$1" || { echo "$1 lacks '$2'"; exit 1; }
}

"$program" list > list.txt
has list.txt byte_heights
has list.txt right_triangles
"$program" represent jacksboro --as byte_heights --crop 100 100 33 33 --save own.tb --render own.png
"$program" export own.tb own.tif
"$program" render own.tif --lod right_triangles --size 320x200 --out seen.png

# The comparisons, on a ground of 33 × 33 samples.
"$program" represent jacksboro --as heightmap --crop 100 100 33 33 --save small.tif
compared='representations error-maps round-trip lod-equal-error lod-ranks lod-frames lod-jump lod-seams lod-surface lod-edit'
"$program" run overview.relief $(printf 'cross.%s ' $compared) --terrain small.tif --out ground
for experiment in $compared; do
  grep "\"experiment\":\"cross.$experiment\"" ground/measurements.jsonl > "$experiment.txt"
  case $experiment in
    lod-*) has "$experiment.txt" right_triangles ;;
    *) has "$experiment.txt" byte_heights ;;
  esac
done
"$program" report ground
cat ground/report/*.html > pages.txt
has pages.txt 'byte heights'
has pages.txt 'right triangles'

# Claims judge them beside the others.
"$program" run cross.round-trip --out claims
"$program" check claims --verbose > check.txt
has check.txt byte_heights
"$program" run cross.lod-edit --terrain jacksboro --out claims
"$program" check claims --claims cross.lod-edit --verbose > check.txt
has check.txt right_triangles
"$program" report claims
