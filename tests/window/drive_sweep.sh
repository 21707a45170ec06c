#!/bin/bash
# Drives the viewer's window through two models of a medium, the second of which has a medium of its own, once
# for each way to sweep; run it inside own_display.sh.
#   drive_sweep.sh PROGRAM FOLDER "SWEEP ..." SCENE [OPTION ...]
# Leaves pictures (one for each step, named in steps.txt), the log and the exit status in FOLDER/SWEEP;
# view_sweep_window_test.cpp judges them.
. "$(dirname "$0")/drive_window.sh"
folder=$2
sweeps=$3
shift 3

for sweep in $sweeps; do
    out=$folder/$sweep
    shots=$out/shots
    mkdir -p "$shots"
    open_window "$@" --sweep "$sweep"
    settled indirect
    keys i i
    settled surface indirect
    close_window
done
