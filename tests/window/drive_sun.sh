#!/bin/bash
# Sets the sun by a date and a time that are typed; run it inside own_display.sh.
#   drive_sun.sh PROGRAM FOLDER DEM
# Leaves saved scene files, the log and the exit status in FOLDER; view_sun_window_test.cpp judges them.
. "$(dirname "$0")/drive_interface.sh"
dem=$3

size=900x600
open_window "$dem"
keys 0 F2
turns
set -- $(xdotool getwindowgeometry --shell "$window" | sed -n 's/^WIDTH=//p')
press $(($1 - 154)) 38 # the first heading is closed, so that the sun is at a known place
press $(($1 - 200)) 85
press $(($1 - 240)) 108
keys ctrl+a
words 2024-06-21
keys Return
press $(($1 - 162)) 108
keys ctrl+a
words 09:30
keys Return
at_rest
save_scene set.toml
keys ctrl+z
at_rest
save_scene undone.toml
close_window
