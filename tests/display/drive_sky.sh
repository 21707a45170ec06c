#!/bin/bash
# Drives the viewer's window under baked light: the sky is turned and tilted; run it inside xvfb-run.
#   drive_sky.sh PROGRAM FOLDER SCENE [OPTION ...]
# Leaves pictures (one for each step, named in steps.txt), the log and the exit status in FOLDER;
# view_sky_window_test.cpp judges them.
. "$(dirname "$0")/drive_window.sh"
shift 2

open_window "$@"
sleep 1
shot start
keys j j j j j j j j j j
sleep 1
shot turned
keys u u u u u u u u u u
sleep 1
command -v import >/dev/null && import -window "$window" "$out/window.png"
shot tilted
keys r
sleep 1
shot reset
close_window
