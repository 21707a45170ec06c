#!/usr/bin/env bash
# Installs what is missing, builds the release and runs every test under a virtual display.
# Arguments go to ctest: ./test.sh -R warp
set -euo pipefail
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.ci/setup.sh"

install_missing build test
configure release ${STEREONAV_CMAKE_ARGS:-}
build release
cd "$root"
with_display ctest --preset release --no-tests=error -j "$(nproc)" "$@"
