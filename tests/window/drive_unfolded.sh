#!/bin/bash
# Drives the wall that lies flat, and a second study: run it inside own_display.sh.
#   drive_unfolded.sh PROGRAM FOLDER STUDY
# Leaves pictures (one for each step, named in steps.txt), unfolded.png, the log and the exit status in FOLDER;
# view_unfolded_window_test.cpp judges them.
. "$(dirname "$0")/drive_interface.sh"
study=$3
cd "$out" || exit 1

start_window "$study" --with "$study" --size 1000x640 --mode ml --separation 0.001 --zero-parallax 0.03
first_picture
settled start
keys F10
settled below start
# A click on the wall, which is in the middle, flies there.
press 530 540
settled flown below
# The other study's place, and the flight goes on in it.
keys F3
settled beside flown
close_window
