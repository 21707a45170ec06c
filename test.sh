#!/usr/bin/env bash
# Installs what is missing, builds the release and runs every test under a virtual display; the last lines say what was
# skipped. Arguments go to ctest: ./test.sh -R warp
set -euo pipefail
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.ci/setup.sh"

install_missing build test
configure release -DCMAKE_UNITY_BUILD=ON ${STEREONAV_CMAKE_ARGS:-}
build release
run_tests release "$@"
