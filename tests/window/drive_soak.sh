#!/bin/bash
# Presses every key of a flight in its turn, twice, over and over, and notes what the program holds after each round, once it
# has rested; run it inside own_display.sh.
#   drive_soak.sh PROGRAM FOLDER ROUNDS SCENE [OPTION ...]
# Leaves a line for each round in held.txt (bytes that no file backs), and the exit status; view_memory_window_test.cpp judges
# them.
. "$(dirname "$0")/drive_interface.sh"
rounds=$3
shift 3
cd "$out" || exit 1
letters=(f c x m n i l t o b g u h j k p 3 1 2 4 5 6 7 8 9 0 F1 F2 F3 F4 F5 F6 F8 F9 F10 Tab space comma period minus equal
    bracketleft bracketright semicolon apostrophe Left Right Up Down BackSpace ctrl+b ctrl+f ctrl+m ctrl+z ctrl+y shift+f
    shift+g shift+m shift+o shift+t shift+F8 r)

size=480x360 open_window "$@"
for ((round = 0; round < rounds; ++round)); do
    for key in "${letters[@]}"; do
        keys "$key"
        turns 1
        keys "$key"
        turns 1
    done
    # The window of the panels takes the keys when it comes.
    for _ in 1 2; do
        keys F7
        turns
        xdotool windowfocus --sync "$window"
    done
    # A flight is recorded and played, and the slices are shown and looked from.
    keys z
    hold w 0.3
    keys z
    keys shift+z
    pass 0.5
    keys space v
    at_rest
    keys Return
    at_rest
    keys Escape
    keys r
    at_rest
    pass 6 # a long rest is five seconds
    awk '/^RssAnon:/ { print 1024 * $2 }' "/proc/$pid/status" >>held.txt
done
close_window
