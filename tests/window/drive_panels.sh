#!/bin/bash
# Drives the viewer's interface with keys, typed words and clicks; run it inside own_display.sh.
#   drive_panels.sh PROGRAM FOLDER DEM
# Leaves pictures (named in steps.txt), scene files that were saved, the log and the exit status in FOLDER;
# view_panels_window_test.cpp judges them.
. "$(dirname "$0")/drive_interface.sh"
dem=$3
cd "$out" || exit 1

size=900x600
open_window terrain --method cubic
# A file that is none: the window stays as it is, and says so.
keys ctrl+o
turns
words "$out/none.tif"
keys Return
at_rest
titled terrain || fail "a file that is not there took the window"
keys ctrl+o
turns
words "$dem"
keys Return
until_true titled "$dem"
turns
save_scene first.toml
keys bracketleft
turns
save_scene narrowed.toml
keys ctrl+z
turns
save_scene undone.toml
keys ctrl+y
turns
save_scene redone.toml
# Panels, and the picture beside them.
keys 0
turns
keys F2 F3
turns
shot with_panels
keys Tab
turns
shot without
keys Tab
# Panels in a window of their own, whose keys are felt too.
keys F7
controls() { xdotool search --onlyvisible --name '^stereonav - controls$' 2>/dev/null | head -n 1; }
apart() { [ -n "$(controls)" ]; }
together() { [ -z "$(controls)" ]; }
until_true apart
shot apart
xdotool windowfocus --sync "$(controls)"
hold w 1
shot flown_from_controls
xdotool windowfocus --sync "$(controls)"
keys F7
until_true together
xdotool windowfocus --sync "$window"
turns
shot together
keys F2 F3
keys shift+f # stays on in what is opened next, and is kept
keys 1
# A card of the start page, in the right eye's part.
keys ctrl+n
turns
set -- $(xdotool getwindowgeometry --shell "$window" | sed -n 's/^\(WIDTH\|HEIGHT\)=//p')
half=$(($1 / 2))
press $((half + half / 2 - 80)) $(($2 / 2 - 95))
until_true titled colon
close_window
