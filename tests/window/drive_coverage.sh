#!/bin/bash
# Drives coverage in the viewer's window; run it inside own_display.sh.
#   drive_coverage.sh PROGRAM FOLDER STUDY [OPTION ...]
# Leaves pictures (one for each step, named in steps.txt), what is kept, the log and the exit status in FOLDER;
# view_coverage_window_test.cpp judges them.
. "$(dirname "$0")/drive_window.sh"
shift 2

kept() { find "$out" -path '*coverage*' -name '[!.]*.json' | head -n 1; }
is_kept() { [ -n "$(kept)" ]; }

open_window "$@"
settled start
keys F9
settled followed start
until_true is_kept
cp "$(kept)" "$out/first.json"
# The flight there comes to rest slowly: it is seen once it has taken a while, and many steps.
keys F8
pass 1.5
turns 30
shot unseen
keys F9 space
settled off unseen
close_window
