#!/bin/bash
# Starts the window as a person who never had the program, changes size, mode and view, closes it and starts it again; run it
# inside own_display.sh.
#   drive_left.sh PROGRAM FOLDER SCENE
# Leaves a line for each step in sizes.txt (its name, the window's size and place) and pictures, named in steps.txt;
# view_left_window_test.cpp judges them.
. "$(dirname "$0")/drive_window.sh"
scene=$3

runs=0
begins() {
    runs=$((runs + 1))
    shots=$out/shots/$runs # names of pictures begin anew with each run
    mkdir -p "$shots"
    rm -f "$recent"
    "$program" view "$scene" --refine off --shots "$shots" "$@" >>"$out/log.txt" 2>&1 &
    pid=$!
    wait_for "its window" found_window
    xdotool windowfocus --sync "$window"
    first_picture
}
# step NAME: the window's place, and a picture at rest
step() {
    settled "$1"
    echo "$1 $(xdotool getwindowgeometry --shell "$window" | sed -n 's/^\(X\|Y\|WIDTH\|HEIGHT\)=//p' | tr '\n' ' ')" \
        >>"$out/sizes.txt"
}

begins
step first
hold w 0.5
keys 5
xdotool windowmove --sync "$window" 100 60
xdotool windowsize --sync "$window" 640 480
pass 5 # notices go
step left
close_window
begins
step again
keys r
step reset
close_window
# What the command line says counts, and is not kept.
begins --mode arcd --size 320x240
step said
close_window
begins
step kept
close_window
