#!/bin/bash
# Drives the viewer's interface with keys, typed words and clicks; run it inside xvfb-run.
#   drive_panels.sh PROGRAM FOLDER DEM
# Leaves the window's titles after each opening in titles.txt, scene files that were saved, the log and the exit status
# in FOLDER; view_panels_window_test.cpp judges them.
. "$(dirname "$0")/drive_interface.sh"
dem=$3
cd "$out" || exit 1

size=900x600
open_window terrain --method cubic
# A file that is none: the window stays as it is, and says so.
keys ctrl+o
sleep 0.5
words "$out/none.tif"
keys Return
sleep 1
titled terrain || fail "a file that is not there took the window"
keys ctrl+o
sleep 0.5
words "$dem"
keys Return
until_true titled "$dem"
sleep 2
save_scene first.toml
keys bracketleft bracketleft bracketleft
sleep 2
save_scene narrowed.toml
keys ctrl+z
sleep 2
save_scene undone.toml
keys ctrl+y
sleep 2
save_scene redone.toml
# Panels, and the picture beside them.
keys 0
sleep 1
keys F2 F3
sleep 2
shot with_panels
keys Tab
sleep 1
shot without
keys Tab
# Panels in a window of their own, whose keys are felt too.
keys F7
controls() { xdotool search --onlyvisible --name '^stereonav - controls$' 2>/dev/null | head -n 1; }
apart() { [ -n "$(controls)" ]; }
together() { [ -z "$(controls)" ]; }
until_true apart
sleep 1
shot apart
xdotool windowfocus "$(controls)"
sleep 0.5
xdotool keydown w
sleep 1
xdotool keyup w
sleep 1
shot flown_from_controls
xdotool windowfocus "$(controls)"
keys F7
until_true together
xdotool windowfocus "$window"
sleep 1
shot together
keys F2 F3
keys shift+f # stays on in what is opened next, and is kept
keys 1
sleep 1
# A card of the start page, in the right eye's part.
keys ctrl+n
sleep 2
set -- $(xdotool getwindowgeometry --shell "$window" | sed -n 's/^\(WIDTH\|HEIGHT\)=//p')
half=$(($1 / 2))
xdotool mousemove --window "$window" $((half + half / 2 - 80)) $(($2 / 2 - 95))
sleep 0.3
xdotool mousedown 1
sleep 0.2
xdotool mouseup 1
until_true titled colon
sleep 1
close_window
