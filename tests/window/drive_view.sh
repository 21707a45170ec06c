#!/bin/bash
# Drives the viewer's window with keys, mouse and resizes; run it inside xvfb-run.
#   drive_view.sh PROGRAM FOLDER
# Leaves pictures (one for each step, named in steps.txt), the window's own pixels, the log and the
# exit status in FOLDER; view_window_test.cpp judges them.
. "$(dirname "$0")/drive_window.sh"
# pixels NAME: the window's own, which it shows some time after its picture was made: once their middle, where no text
# lies, is that of the last picture, or after a minute whatever they are.
pixels() {
    local middle="640x24+0+96" error
    for _ in $(seq 120); do
        import -window "$window" "$out/$1.png" 2>/dev/null || return
        error=$(compare -metric MAE "$out/$1.png[$middle]" "$picture[$middle]" null: 2>&1)
        awk -v share="${error##*(}" 'BEGIN { exit !(share + 0 < 0.5 / 255) }' && return
        sleep 0.5
    done
}

# A screen of a known width, so that no question about it lies over the picture.
open_window terrain --method cubic --screen-width 600
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
# Before the flight is played, since nothing is dragged meanwhile.
xdotool mousemove --window "$window" 200 100
xdotool mousedown 1
sleep 0.2
xdotool mousemove_relative -- 60 20
sleep 0.2
xdotool mouseup 1
settled dragged recorded
keys Z
differing playing dragged
settled played playing
keys space
settled home played
xdotool windowsize "$window" 500 200
settled resized home
keys F1
sleep 0.5
keys Escape # of the help alone
sleep 0.5
kill -0 "$pid" || fail "Escape over the help ended the program"
close_window
