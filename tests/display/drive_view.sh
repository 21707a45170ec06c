#!/bin/bash
# Drives the viewer's window with keys, mouse and resizes; run it inside xvfb-run.
#   drive_view.sh PROGRAM FOLDER
# Leaves pictures (one for each step, named in steps.txt), the window's own pixels, the log and the
# exit status in FOLDER; view_window_test.cpp judges them.
set -u
program=$1
out=$2
shots=$out/shots
mkdir -p "$shots"
"$program" view terrain --size 320x240 --mode sbsl --method cubic --shots "$shots" >"$out/log.txt" 2>&1 &
pid=$!
fail() {
    echo "$*" >>"$out/problems.txt"
    kill "$pid" 2>/dev/null
    exit 1
}

window=
for _ in $(seq 300); do
    window=$(xdotool search --onlyvisible --name '^stereonav' 2>/dev/null | head -n 1)
    [ -n "$window" ] && break
    kill -0 "$pid" 2>/dev/null || fail "the program ended before its window opened"
    sleep 0.1
done
[ -n "$window" ] || fail "no window within 30 seconds"
xdotool windowfocus --sync "$window"

pictures() { find "$shots" -name 'stereonav_*.png' | wc -l; }

# The picture after everything pressed so far. The first one waits for the scene to load.
shot() {
    local before tries
    before=$(pictures)
    xdotool key --clearmodifiers "${2:-p}"
    for tries in $(seq 600); do
        [ "$(pictures)" -gt "$before" ] && break
        kill -0 "$pid" 2>/dev/null || fail "the program ended before the picture of step $1"
        sleep 0.05
    done
    [ "$(pictures)" -gt "$before" ] || fail "no picture for step $1"
    echo "$1 $(find "$shots" -name 'stereonav_*.png' | sort | tail -n 1)" >>"$out/steps.txt"
}
keys() { xdotool key --clearmodifiers "$@"; }
hold() {
    xdotool keydown "$1"
    sleep "$2"
    xdotool keyup "$1"
}
rest() { sleep 2.5; }

# Keys that come while the scene loads are dropped: ask until the first picture is there.
for _ in $(seq 120); do
    keys p
    sleep 0.5
    [ "$(pictures)" -gt 0 ] && break
    kill -0 "$pid" 2>/dev/null || fail "the program ended while it loaded"
done
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
keys Escape
for _ in $(seq 200); do
    kill -0 "$pid" 2>/dev/null || break
    sleep 0.05
done
if kill -0 "$pid" 2>/dev/null; then fail "Escape did not end the program"; fi
wait "$pid"
echo $? >"$out/status.txt"
