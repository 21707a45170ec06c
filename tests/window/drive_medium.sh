#!/bin/bash
# Drives the viewer's window through a medium: models, light, flight, ways to two eyes; run it inside own_display.sh.
#   drive_medium.sh PROGRAM FOLDER SCENE [OPTION ...]
# Leaves pictures (one for each step, named in steps.txt), the log and the exit status in FOLDER;
# view_medium_window_test.cpp judges them.
. "$(dirname "$0")/drive_window.sh"
shift 2

open_window "$@"
settled start
keys i
settled emission start
keys i i i
settled again emission
keys k k k k k k k k k k k k k k k k k k k k
settled turned again
keys n
settled two_sweeps
hold w 0.8
settled flown two_sweeps
close_window
