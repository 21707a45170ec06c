#!/bin/bash
# Fills one of two monitors with the program's window and takes it back, by option and key; run it by two_monitors.sh.
#   drive_monitors.sh PROGRAM FOLDER
# Leaves the window's place after each step in places.txt (step, x, y, width, height) and the exit status;
# on_monitors_test.cpp judges them.
. "$(dirname "$0")/drive_window.sh"
place() {
    eval "$(xdotool getwindowgeometry --shell "$window" | grep -E '^(X|Y|WIDTH|HEIGHT)=')"
    echo "$X $Y $WIDTH $HEIGHT"
}
is_at() {
    case "$(place)" in $1) true ;; *) false ;; esac
}
# placed STEP PLACE: as it is then; of the place * stands for any number.
placed() {
    wait_for "$1 at $2" is_at "$2"
    echo "$1 $(place)" >>"$out/places.txt"
}
start_window terrain --mode ml --size 320x240 --full-screen 2
placed option "1025 33 3840 1080"
first_picture
keys F11
placed key "* 320 240"
# Onto the other one, which is filled next.
xdotool windowmove --sync "$window" 100 50
turns
keys F11
placed again "0 0 1025 768"
take
close_window
