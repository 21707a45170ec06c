#!/bin/bash
# Answers what the window asks about the screen; run it inside xvfb-run.
#   drive_screen.sh PROGRAM FOLDER
# Leaves what the window kept and printed in kept.toml and told.json, those of a second window, whose command line says
# how wide the screen is, in again.toml and quiet.txt; view_screen_window_test.cpp judges them.
. "$(dirname "$0")/drive_window.sh"
config=$out/.config/stereonav/window.toml
# at X Y COMMAND...: of the window's left half, where the interface of the left eye is
at() {
    xdotool mousemove --window "$window" "$1" "$2"
    shift 2
    sleep 0.3
    "$@"
    sleep 0.5
}
click() {
    xdotool mousedown 1
    sleep 0.1
    xdotool mouseup 1
}
twice() { xdotool click --repeat 2 --delay 60 1; }

size=1200x600 # side by side: as wide as the screen
open_window terrain --json
set -- $(xdotool getwindowgeometry --shell "$window" | sed -n 's/^\(WIDTH\|HEIGHT\)=//p')
sleep 5 # what was saved is told no longer
middle=$(($1 / 4))
at $((middle - 160)) 66 twice
xdotool type --delay 40 -- 598
sleep 0.5
at $((middle - 62)) 66 click
sleep 1
close_window
cp "$config" "$out/kept.toml"
cp "$out/log.txt" "$out/told.json"
open_window terrain --quiet --screen-width 700 --viewing-distance 900
close_window
cp "$config" "$out/again.toml"
cp "$out/log.txt" "$out/quiet.txt"
