#!/usr/bin/env bash
# Takes the pictures and figures of the playback tests as they are now for right, after somebody looked at them:
# tests/golden/accept.sh [BUILD FOLDER]. Set STEREONAV_TEST_DATA, or those of real data stay as they were.
set -euo pipefail
root="$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../.."
build="${1:-$root/build/release}"
STEREONAV_ACCEPT=1 "$build/bin/test_golden"
git -C "$root" status --short tests/golden
