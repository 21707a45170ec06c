#!/bin/bash
# Drags contours, paints what is seen from a click, and asks for tracks that lie elsewhere; run it inside own_display.sh.
#   drive_ground.sh PROGRAM FOLDER DEM TRACKS
# Leaves saved scene files, pictures, the log and the exit status in FOLDER; view_ground_window_test.cpp judges them.
. "$(dirname "$0")/drive_interface.sh"
dem=$3
tracks=$4

start_window "$dem" --size 900x600 --mode sbsl
first_picture
keys 0 F2
turns
set -- $(xdotool getwindowgeometry --shell "$window" | sed -n 's/^WIDTH=//p')
press $(($1 - 154)) 38 # the first two headings are closed, so that the third is at a known place
press $(($1 - 154)) 63
press $(($1 - 154)) 88
settled plain
drag_by $(($1 - 285)) 263 150 0
let_go
settled contours plain
press $(($1 - 283)) 288
press 300 400
settled seen contours
save_scene seen.toml
keys ctrl+z
settled undone seen
press $(($1 - 90)) 238
words "$tracks"
keys Return
at_rest
save_scene failed.toml
close_window
