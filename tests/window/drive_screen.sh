#!/bin/bash
# Answers what the panel View and stereo asks about the screen; run it inside own_display.sh.
#   drive_screen.sh PROGRAM FOLDER
# Leaves what the window kept and printed in kept.toml and told.json, those of a second window, whose command line says
# how wide the screen is, in again.toml and quiet.txt; view_screen_window_test.cpp judges them.
. "$(dirname "$0")/drive_interface.sh"
config=$out/.config/stereonav/window.toml

size=1200x600 # side by side: as wide as the screen
open_window terrain --json
at_rest
keys F2
turns
press 320 297
keys ctrl+a
words 598
press 417 297
keys F2
turns
close_window
cp "$config" "$out/kept.toml"
cp "$out/log.txt" "$out/told.json"
open_window terrain --quiet --screen-width 700 --viewing-distance 900
close_window
cp "$config" "$out/again.toml"
cp "$out/log.txt" "$out/quiet.txt"
