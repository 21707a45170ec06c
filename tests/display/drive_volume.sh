#!/bin/bash
# Drives the viewer's window through a study: flight, slices, a seed, another search; run it inside xvfb-run.
#   drive_volume.sh PROGRAM FOLDER STUDY [OPTION ...]
# Leaves pictures (one for each step, named in steps.txt), the log and the exit status in FOLDER;
# view_volume_window_test.cpp judges them.
. "$(dirname "$0")/drive_window.sh"
shift 2

open_window "$@"
sleep 3
shot start
hold w 0.6
sleep 3
shot flown
keys period period period period period period period period
sleep 2
shot surface
keys t
sleep 3
shot translucent
keys t
sleep 3
keys v
sleep 2
shot axial
xdotool mousemove --window "$window" 160 120
sleep 0.2
xdotool mousedown 1
sleep 0.15
xdotool mouseup 1
sleep 0.5
shot seeded
keys Next Next Next Next
sleep 0.3
shot paged
keys v
sleep 0.3
shot coronal
keys Return
sleep 3
keys Escape
sleep 1
shot back
close_window
