#!/bin/sh
# bake_mpi.sh PROGRAM: a bake shared by processes of an MPI run has the bytes of one by a single process, also
# where it stops at an error.
set -eu
program=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
export XDG_CACHE_HOME="$folder" OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1

# Hills and caves that see each other in 20^3 voxels.
{
  printf 'NRRD0004\ntype: short\ndimension: 3\nsizes: 20 20 20\nspacings: 1 1 1\nencoding: ascii\n\n'
  awk 'BEGIN { for (k = 0; k < 20; ++k) for (j = 0; j < 20; ++j) for (i = 0; i < 20; ++i) {
    print int(1500 + 400 * (sin(0.7 * i) + cos(0.6 * j) + sin(0.5 * k))) } }'
} > "$folder/caves.nrrd"

for options in "--what irradiance --samples 40" "--what transfer --error 0.1" "--what openness --error 0.05"; do
  # shellcheck disable=SC2086
  "$program" bake "$folder/caves.nrrd" $options --out "$folder/one.bake"
  for processes in 2 3; do
    # shellcheck disable=SC2086
    mpirun --oversubscribe -n $processes "$program" bake "$folder/caves.nrrd" $options --out "$folder/many.bake"
    cmp "$folder/one.bake" "$folder/many.bake"
    rm "$folder/many.bake"
  done
  rm "$folder/one.bake"
done
