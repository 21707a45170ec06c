#!/bin/bash
# Drives the viewer's window through what changes in a volume seen from outside without loading it again; run it
# inside own_display.sh.
#   drive_look.sh PROGRAM FOLDER STUDY MOVED [OPTION ...]
# Once the window shows STUDY it is moved to MOVED, so that reading it again would fail. Leaves pictures (one
# for each step, named in steps.txt), the log and the exit status in FOLDER; view_look_window_test.cpp judges
# them.
. "$(dirname "$0")/drive_window.sh"
study=$3
moved=$4
shift 4

# Where light is baked or lazy it takes the place of ambient light and shows the surface alone.
case "$*" in
    *--light*) changes() { settled "$1"; } ;;
    *) changes() { settled "$1" "$2"; } ;;
esac

open_window "$study" "$@"
settled opened
keys t
changes start opened
mv "$study" "$moved"
keys period period period period
settled surface start
keys comma comma comma comma
settled back surface
keys o
changes ambient back
keys o
changes method ambient
keys equal equal equal
changes radius method
keys O
keys O
changes lamp radius
keys t
changes translucent lamp
keys b
changes variance translucent
keys g g g
changes sigma variance
keys b
changes gradient sigma
keys b
changes whole gradient
keys t
changes opaque whole
close_window
