#!/bin/bash
# Drives the viewer's window through a study: flight, slices, a seed, another search; run it inside xvfb-run.
#   drive_volume.sh PROGRAM FOLDER STUDY [OPTION ...]
# Leaves pictures (one for each step, named in steps.txt), the log and the exit status in FOLDER;
# view_volume_window_test.cpp judges them.
set -u
program=$1
out=$2
study=$3
shift 3
shots=$out/shots
mkdir -p "$shots"
"$program" view "$study" "$@" --size 320x240 --mode sbsl --shots "$shots" >"$out/log.txt" 2>&1 &
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
keys() { xdotool key --clearmodifiers "$@"; }
shot() {
    local before
    before=$(pictures)
    keys p
    for _ in $(seq 600); do
        [ "$(pictures)" -gt "$before" ] && break
        kill -0 "$pid" 2>/dev/null || fail "the program ended before the picture of step $1"
        sleep 0.05
    done
    [ "$(pictures)" -gt "$before" ] || fail "no picture for step $1"
    echo "$1 $(find "$shots" -name 'stereonav_*.png' | sort | tail -n 1)" >>"$out/steps.txt"
}
hold() {
    xdotool keydown "$1"
    sleep "$2"
    xdotool keyup "$1"
}

# Keys that come while the scene loads are dropped: ask until the first picture is there.
for _ in $(seq 120); do
    keys p
    sleep 0.5
    [ "$(pictures)" -gt 0 ] && break
    kill -0 "$pid" 2>/dev/null || fail "the program ended while it loaded"
done
sleep 3
shot start
hold w 0.6
sleep 3
shot flown
keys period period period period period period period period
sleep 2
shot surface
keys t
sleep 3
shot translucent
keys t
sleep 3
keys v
sleep 2
shot axial
xdotool mousemove --window "$window" 160 120
sleep 0.2
xdotool mousedown 1
sleep 0.15
xdotool mouseup 1
sleep 0.5
shot seeded
keys Next Next Next Next
sleep 0.3
shot paged
keys v
sleep 0.3
shot coronal
keys Return
sleep 3
keys Escape
sleep 1
shot back
keys Escape
for _ in $(seq 200); do
    kill -0 "$pid" 2>/dev/null || break
    sleep 0.05
done
if kill -0 "$pid" 2>/dev/null; then fail "Escape did not end the program"; fi
wait "$pid"
echo $? >"$out/status.txt"
