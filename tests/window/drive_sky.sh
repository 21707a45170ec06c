#!/bin/bash
# Drives the viewer's window under baked light: the sky is turned and tilted; run it inside own_display.sh.
#   drive_sky.sh PROGRAM FOLDER SCENE [OPTION ...]
# Leaves pictures (one for each step, named in steps.txt), the log and the exit status in FOLDER;
# view_sky_window_test.cpp judges them.
. "$(dirname "$0")/drive_window.sh"
shift 2

# Without a sky there is nothing that a key could change.
case "$*" in
    *--sky*) changes() { settled "$1" "$2"; } ;;
    *) changes() { settled "$1"; } ;;
esac

open_window "$@"
settled start
keys j j j j j j j j j j
changes turned start
keys u u u u u u u u u u
changes tilted turned
command -v import >/dev/null && import -window "$window" "$out/window.png"
keys r
changes reset tilted
close_window
