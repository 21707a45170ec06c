#!/bin/sh
# several_processes.sh PROGRAM: what processes of an MPI run make together has the bytes of what one makes alone;
# errors are told once; a process that is lost ends the run, and a bake goes on from what was done.
set -eu
program=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
export XDG_CACHE_HOME="$folder" OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
export OMPI_MCA_rmaps_base_oversubscribe=1
export OMPI_MCA_btl_vader_single_copy_mechanism=none

fail() {
  echo "several_processes: $*" >&2
  exit 1
}
together() {  # together N ARGUMENTS...
  processes=$1
  shift
  mpirun -q --bind-to none -n "$processes" "$program" "$@"
}

# Hills and caves that see each other in 20^3 voxels, and a bent tube of air, whose narrowness brings eyes together.
volume() {  # volume NAME TYPE EXPRESSION
  printf 'NRRD0004\ntype: %s\ndimension: 3\nsizes: 20 20 20\nspacings: 2 2 2\nencoding: ascii\n\n' "$2" > "$1"
  awk "BEGIN { for (k = 0; k < 20; ++k) for (j = 0; j < 20; ++j) for (i = 0; i < 20; ++i) print ($3) }" >> "$1"
}
volume caves.nrrd short 'int(1500 + 400 * (sin(0.7 * i) + cos(0.6 * j) + sin(0.5 * k)))'
volume tube.nrrd uchar '(i - 9.5 - 3 * sin(0.3 * k)) ^ 2 + (j - 9.5) ^ 2 < 12 && k > 1 && k < 18 ? 1 : 0'

# Frames 3 to 8 of the built-in flight, with names on the ground.
points=$(for x in -7 -5 -3 -1 1 3 5; do for y in -7 -5 -3 -1 1 3 5; do printf ',[%d000,%d000]' $x $y; done; done)
printf '{"type":"Feature","properties":{"name":"Here"},"geometry":{"type":"MultiPoint","coordinates":[%s]}}' \
  "${points#,}" > named.geojson
play() {
  echo "play --size 64x48 --threads 1 --quiet --hash --frames 3..8 --tracks named.geojson --out $1 --video $1.mkv"
}
# shellcheck disable=SC2046
"$program" $(play one) > one.hash
# shellcheck disable=SC2046
together 3 $(play three) > three.hash
cmp one.hash three.hash
cmp one.mkv three.mkv
diff -r one three
[ "$(ls one)" = "$(seq -f 'frame_%05g.png' 3 8)" ] || fail "expected frames 3 to 8, got $(ls one)"

# Parts are as in the whole.
"$program" play tube.nrrd --no-cache --size 64x48 --quiet --fps 20 --out whole
together 2 play tube.nrrd --no-cache --size 64x48 --quiet --fps 20 --frames 5..9 --out part
[ "$(ls part | wc -l)" -eq 5 ] || fail "expected 5 frames, got $(ls part)"
for picture in part/*; do cmp "$picture" "whole/$(basename "$picture")"; done

bake() {  # bake OUT OPTIONS...
  out=$1
  shift
  echo "bake --quiet --out $out $*"
}
for options in "caves.nrrd --what irradiance --samples 40" "caves.nrrd --what transfer --error 0.15" \
  "--what transfer --resolution 0.0625 --samples 16"; do
  # shellcheck disable=SC2046,SC2086
  "$program" $(bake one.bake $options)
  # shellcheck disable=SC2046,SC2086
  together 3 $(bake three.bake $options)
  cmp one.bake three.bake
  rm one.bake three.bake
done

"$program" coverage tube.nrrd --no-cache --quiet --patch 5 --out one.csv --json > one.json
together 2 coverage tube.nrrd --no-cache --quiet --patch 5 --out two.csv --json > two.json
cmp one.csv two.csv
sed 's/one\.csv/two.csv/' one.json | cmp - two.json

# Of a report what is no time; the setting of a time too, for nobody measures with fewer cores.
report() {
  echo "report --quick --minutes 0.01 --parts occlusion --quiet --out $1"
}
# shellcheck disable=SC2046
"$program" $(report one)
# shellcheck disable=SC2046
together 3 $(report three)
for run in one three; do sed '/,time,/s/,time,.*/,time/' $run/report.csv > $run.csv; done
grep -q 'occlusion/radius 5/gaussian/error' one.csv || fail "expected errors of occlusion, got $(cat one.csv)"
cmp one.csv three.csv

# An error that all find, and one that the first alone finds.
for options in "play none.tif --hash" "play --frames 0..100000 --hash" "play --size 64x48 --out none/deep" \
  "report --parts late --scene none.tif --out page"; do
  status=0
  # shellcheck disable=SC2086
  together 3 $options > out 2> err || status=$?
  [ $status -eq 1 ] || fail "$options: expected exit status 1, got $status"
  [ "$(grep -c '^stereonav:' err)" -eq 1 ] || fail "$options: expected one line, got $(cat err)"
  [ ! -s out ] || fail "$options: expected nothing on standard output, got $(cat out)"
done

# A process that is lost.
together 2 bake caves.nrrd --quiet --samples 1000000 --out lost.bake > out 2> err &
run=$!
# The last of the program's processes below the run, which is mpirun or a shell that started it.
last_process() {
  for parent in "$run" $(ps -o pid= --ppid "$run"); do ps -o pid=,comm= --ppid "$parent"; done |
    awk '$2 == "stereonav" { pid = $1 } END { print pid }'
}
used() { awk '{ sub(/.*\) /, ""); print $12 + $13 }' "/proc/$1/stat" 2> /dev/null || echo 0; }
# It is at work: it has used half a second of the processor.
lost=
while [ -z "$lost" ] || [ "$(used "$lost")" -lt 50 ]; do
  kill -0 $run || fail "the bake ended by itself: $(cat err)"
  sleep 0.1
  lost=$(last_process)
done
kill -9 "$lost"
status=0
wait $run || status=$?
[ $status -ne 0 ] || fail "expected a run that lost a process to fail"
[ "$(grep -c '^stereonav:' err)" -le 1 ] || fail "expected one line at most, got $(cat err)"
# What is done is whole, if the first process had the time to write it.
if [ -e lost.bake ]; then
  "$program" bake caves.nrrd --samples 128 --out lost.bake > out 2> err
  grep -q 'nothing was to be done' out || fail "expected a bake to go on from, got $(cat out err)"
fi
