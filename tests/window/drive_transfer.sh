#!/bin/bash
# Drives the panel of a volume's transfer function with the mouse; run it inside own_display.sh.
#   drive_transfer.sh PROGRAM FOLDER STUDY [OPTION ...]
# Leaves pictures (named in steps.txt), saved scene files, the log and the exit status in FOLDER;
# view_transfer_window_test.cpp judges them.
. "$(dirname "$0")/drive_interface.sh"
shift 2
size=900x600
open_window "$@"
# One eye, and the panels beside it; their headings are closed, so that the curve is at a known place.
keys 0 F2
turns
set -- $(xdotool getwindowgeometry --shell "$window" | sed -n 's/^WIDTH=//p')
panel=$(($1 - 154)) left=$(($1 - 292)) # of the plot, which is 274 wide and ends 229 below the top
for heading in 38 63 88; do press "$panel" "$heading"; done
# Values from -5 to 255: a point at 125 without opacity, and the isovalue at 60.
point=$((left + 137)) line=$((left + 68)) bottom=228
settled start
drag_by "$point" "$bottom" 0 -63
settled held start
let_go
save_scene dragged.toml
keys ctrl+z
settled undone held
save_scene undone.toml
press $((left + 200)) 200 3
drag_by "$line" 180 -26 0
let_go
save_scene moved.toml
close_window
