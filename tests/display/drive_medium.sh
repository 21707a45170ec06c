#!/bin/bash
# Drives the viewer's window through a medium: models, light, flight, ways to two eyes; run it inside xvfb-run.
#   drive_medium.sh PROGRAM FOLDER SCENE [OPTION ...]
# Leaves pictures (one for each step, named in steps.txt), the log and the exit status in FOLDER;
# view_medium_window_test.cpp judges them.
. "$(dirname "$0")/drive_window.sh"
shift 2

open_window "$@"
sleep 1
shot start
keys i
sleep 1
shot emission
keys i i i
sleep 1
shot again
keys k k k k k k k k k k k k k k k k k k k k
sleep 1
shot turned
keys n
sleep 1
shot two_sweeps
hold w 0.8
sleep 2
shot flown
close_window
