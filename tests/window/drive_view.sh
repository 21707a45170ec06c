#!/bin/bash
# Drives the viewer's window with keys, mouse and resizes; run it inside own_display.sh.
#   drive_view.sh PROGRAM FOLDER
# Leaves pictures (one for each step, named in steps.txt), the window's own pixels, the log and the
# exit status in FOLDER; view_window_test.cpp judges them.
. "$(dirname "$0")/drive_window.sh"
# pixels NAME: the window's own, which it shows some time after its picture was made: once their middle, where no text
# lies, is that of the last picture.
pixels() {
    command -v import >/dev/null && wait_for "the pixels of $1" shows "$out/$1.png"
}
shows() {
    local middle="640x24+0+96" error
    import -window "$window" "$1" 2>/dev/null || return
    error=$(compare -metric MAE "$1[$middle]" "$picture[$middle]" null: 2>&1)
    awk -v share="${error##*(}" 'BEGIN { exit !(share + 0 < 0.5 / 255) }'
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
at 200 100
turns
xdotool mousedown 1
turns
at 260 120
turns
xdotool mouseup 1
settled dragged recorded
# Its picture is asked for at once, so that it is one of the flight's begin, however long pictures take.
shot playing Z p
settled played playing
keys space
settled home played
xdotool windowsize "$window" 500 200
settled resized home
keys F1
turns
keys Escape # of the help alone
turns
close_window
