#!/bin/bash
# Flights that are being recorded while the window is closed, while the program is killed or told to stop, and while another
# scene is opened; run it inside own_display.sh.
#   drive_closing.sh PROGRAM FOLDER SCENE OTHER_SCENE
# Leaves a flight for each in FOLDER/shots, and a line for each end of the program in ends.txt (its name and exit status);
# view_closing_window_test.cpp judges them.
. "$(dirname "$0")/drive_window.sh"
scene=$3 other=$4
cd "$out" || exit 1
flights=0

# records: opens the window and flies until the first of the flight is in its file
records() {
    flights=$((flights + 1))
    start_window "$scene" --size 320x240 --mode ml
    first_picture
    keys z
    xdotool keydown w
    until_true [ -s "$shots/flight_000$flights.gltf" ]
    xdotool keyup w
    turns
}
# grows: the recording is longer than $bytes
grows() { [ "$(wc -c <"$shots/flight_0001.gltf")" -gt "$bytes" ]; }
ended() {
    wait "$pid"
    echo "$1 $?" >>ends.txt
}
# still_there: the window goes on; a program that ends is seen at once
still_there() {
    "$client" turns "$window" 5 2>/dev/null &
    local answer=$!
    until_true eval "! kill -0 $answer 2>/dev/null"
    wait "$answer" || fail "the window does not answer"
}
# asks STEP COMMAND ...: once it is only a question; soon again it is the answer
asks() {
    local step=$1 end=$((SECONDS + patience))
    shift
    "$@"
    still_there
    while alive; do
        [ "$SECONDS" -lt "$end" ] || fail "$step does not end the program"
        "$@" 2>/dev/null
        nap
    done
    ended "$step"
}

# Escape leaves full screen, and answers the question; it ends neither the recording nor the window.
records
keys F11
turns
keys Escape Escape Escape
still_there
keys ctrl+q Escape Escape
still_there
bytes=$(wc -c <"$shots/flight_0001.gltf")
xdotool keydown w
until_true grows
xdotool keyup w
turns
asks quit keys ctrl+q
records
# Keys belong to the search while it is open, also where nothing is found: no picture is saved, nothing ends.
keys ctrl+p
turns
xdotool type --delay 20 qqqq
turns
keys Return z p x m
turns
still_there
keys Escape
turns
asks closed "$client" close "$window"
records
kill -KILL "$pid"
ended killed 2>/dev/null
records
kill -TERM "$pid"
ended stopped
records
"$client" drop "$window" "$other" || fail "the drop was not taken"
until_true titled "$other"
turns
close_window # at once: nothing is at work
echo "other $status" >>ends.txt
