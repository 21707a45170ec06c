#!/bin/bash
# Answers what the window asks about the screen; run it inside own_display.sh.
#   drive_screen.sh PROGRAM FOLDER
# Leaves what the window kept and printed in kept.toml and told.json, those of a second window, whose command line says
# how wide the screen is, in again.toml and quiet.txt; view_screen_window_test.cpp judges them.
. "$(dirname "$0")/drive_interface.sh"
config=$out/.config/stereonav/window.toml

size=1200x600 # side by side: as wide as the screen
open_window terrain --json
set -- $(xdotool getwindowgeometry --shell "$window" | sed -n 's/^\(WIDTH\|HEIGHT\)=//p')
at_rest
pass 4.5 # what was saved is told no longer, above the question
# Of the window's left half, where the interface of the left eye is.
middle=$(($1 / 4))
press $((middle - 160)) 66
keys ctrl+a
words 598
press $((middle - 62)) 66
close_window
cp "$config" "$out/kept.toml"
cp "$out/log.txt" "$out/told.json"
open_window terrain --quiet --screen-width 700 --viewing-distance 900
close_window
cp "$config" "$out/again.toml"
cp "$out/log.txt" "$out/quiet.txt"
