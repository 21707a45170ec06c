#!/bin/bash
# Fills one of two monitors with the program's window and takes it back, by option and key; run it by two_monitors.sh.
#   drive_monitors.sh PROGRAM FOLDER
# Leaves the window's place after each step in places.txt (step, x, y, width, height) and the exit status;
# on_monitors_test.cpp judges them.
. "$(dirname "$0")/drive_window.sh"
place() {
    eval "$(xdotool getwindowgeometry --shell "$window" | grep -E '^(X|Y|WIDTH|HEIGHT)=')"
    echo "$X $Y $WIDTH $HEIGHT"
}
# placed STEP PLACE: within half a minute; else as it is then
placed() {
    for _ in $(seq 300); do
        [ "$(place)" = "$2" ] && break
        sleep 0.1
    done
    echo "$1 $(place)" >>"$out/places.txt"
}
start_window terrain --mode ml --size 320x240 --full-screen 2
placed option "1025 33 3840 1080"
first_picture
keys F11
for _ in $(seq 300); do
    case "$(place)" in *" 320 240") break ;; esac
    sleep 0.1
done
echo "key $(place)" >>"$out/places.txt"
# Onto the other one, which is filled next.
xdotool windowmove --sync "$window" 100 50
sleep 0.5
keys F11
placed again "0 0 1025 768"
take
close_window
