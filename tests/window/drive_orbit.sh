#!/bin/bash
# Turns, zooms and pans what is seen from outside, by mouse; run it inside own_display.sh.
#   drive_orbit.sh PROGRAM FOLDER STUDY [OPTION ...]
# Leaves pictures (one for each step, named in steps.txt), the log and the exit status in FOLDER;
# view_orbit_window_test.cpp judges them.
. "$(dirname "$0")/drive_window.sh"
shift 2

# drag_with BUTTON DX DY: from the middle of the left eye's picture
drag_with() {
    at 160 120
    turns
    xdotool mousedown "$1"
    turns
    at $((160 + $2 / 2)) $((120 + $3 / 2))
    turns
    at $((160 + $2)) $((120 + $3))
    turns
    xdotool mouseup "$1"
    turns
}
# wheel BUTTON COUNT: 4 is up, 5 down
wheel() {
    at 160 120
    turns
    xdotool click --repeat "$2" --delay 40 "$1"
    turns
}

open_window "$@"
settled start
drag_with 1 60 0
settled turned start
wheel 4 3
settled zoomed turned
drag_with 2 50 30
settled panned zoomed
xdotool keydown shift
drag_with 1 -50 -30
xdotool keyup shift
settled back panned
wheel 5 3
settled away back
keys space
settled home away
keys ctrl+r
drag_with 1 60 0
settled looked home
wheel 4 3
settled same
close_window
