#!/usr/bin/env bash
# Installs what is missing, builds the release and runs stereonav with the arguments given.
set -euo pipefail
source "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/.ci/setup.sh"

install_missing build
configure release -DCMAKE_UNITY_BUILD=ON ${STEREONAV_CMAKE_ARGS:-}
build release stereonav
exec "$root/build/release/bin/stereonav" "$@"
