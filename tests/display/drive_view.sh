#!/bin/bash
# Drives the viewer's window with keys, mouse and resizes; run it inside xvfb-run.
#   drive_view.sh PROGRAM FOLDER
# Leaves pictures (one for each step, named in steps.txt), the window's own pixels, the log and the
# exit status in FOLDER; view_window_test.cpp judges them.
. "$(dirname "$0")/drive_window.sh"
# The window's own pixels: it is drawn after its picture was made.
pixels() {
    sleep 1
    import -window "$window" "$out/$1.png" 2>/dev/null
}

open_window terrain --method cubic
settled start
keys x
shot swapped F12
keys x
keys 9
shot anaglyph
pixels window_anaglyph
keys m
shot anaglyph_next
keys 0
shot left
keys 3
shot one_eye
keys 3
keys 5
shot top_bottom
keys 1
shot side_by_side
pixels window_side_by_side
hold w 1.0
settled moved side_by_side
keys bracketright bracketright bracketright bracketright
settled separated moved
keys z
hold Right 3.0
settled turned separated
keys z
shot recorded
keys Z
sleep 0.5
shot playing
settled played playing
xdotool mousemove --window "$window" 200 100
xdotool mousedown 1
sleep 0.2
xdotool mousemove_relative -- 60 20
sleep 0.2
xdotool mouseup 1
settled dragged played
keys space
settled home dragged
xdotool windowsize "$window" 500 200
settled resized home
keys F1
sleep 0.5
close_window
