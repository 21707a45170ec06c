#!/bin/bash
# Drives the viewer's window with keys, mouse and resizes; run it inside xvfb-run.
#   drive_view.sh PROGRAM FOLDER
# Leaves pictures (one for each step, named in steps.txt), the window's own pixels, the log and the
# exit status in FOLDER; view_window_test.cpp judges them.
. "$(dirname "$0")/drive_window.sh"
rest() { sleep 2.5; }

open_window terrain --method cubic
sleep 1
shot start
keys x
shot swapped F12
keys x
keys 9
shot anaglyph
import -window "$window" "$out/window_anaglyph.png" 2>/dev/null
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
sleep 0.5
import -window "$window" "$out/window_side_by_side.png" 2>/dev/null
hold w 1.0
rest
shot moved
keys bracketright bracketright bracketright bracketright
rest
shot separated
keys z
hold Right 1.0
rest
keys z
shot recorded
keys Z
sleep 0.9
shot playing
sleep 5
shot played
xdotool mousemove --window "$window" 200 100
xdotool mousedown 1
sleep 0.2
xdotool mousemove_relative -- 60 20
sleep 0.2
xdotool mouseup 1
rest
shot dragged
keys space
rest
shot home
xdotool windowsize "$window" 500 200
sleep 1
shot resized
keys F1
sleep 0.5
close_window
