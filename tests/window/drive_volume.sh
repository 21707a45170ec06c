#!/bin/bash
# Drives the viewer's window through a study: flight, slices, a piece that is taken, another search; run it inside own_display.sh.
#   drive_volume.sh PROGRAM FOLDER STUDY [OPTION ...]
# Leaves pictures (one for each step, named in steps.txt), the log and the exit status in FOLDER;
# view_volume_window_test.cpp judges them.
. "$(dirname "$0")/drive_window.sh"
shift 2

# A colon has one wall, and pieces that are taken by clicks; that of other volumes moves.
case "$*" in
    *--isosurface*)
        moves() { settled "$1" "$2"; }
        pages=axial
        chooses() { :; }
        ;;
    *)
        moves() { settled "$1"; }
        pages=chosen
        chooses() {
            press 245 120
            settled chosen axial
        }
        ;;
esac

open_window "$@"
settled start
hold w 0.6
settled flown start
keys period period period period period period period period
moves surface flown
keys t
settled translucent surface
keys t
settled opaque translucent
keys v
settled axial opaque
chooses
keys Next Next Next Next
settled paged "$pages"
keys v
settled coronal paged
keys Return
at_rest
keys Escape
settled back coronal
close_window
