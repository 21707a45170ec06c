#!/bin/bash
# Drives the viewer's window through what changes in a volume seen from outside without loading it again; run it
# inside xvfb-run.
#   drive_look.sh PROGRAM FOLDER STUDY MOVED [OPTION ...]
# Once the window shows STUDY it is moved to MOVED, so that reading it again would fail. Leaves pictures (one
# for each step, named in steps.txt), the log and the exit status in FOLDER; view_look_window_test.cpp judges
# them.
. "$(dirname "$0")/drive_window.sh"
study=$3
moved=$4
shift 4

open_window "$study" "$@"
sleep 2
keys t
sleep 2
shot start
mv "$study" "$moved"
keys period period period period
sleep 2
shot surface
keys comma comma comma comma
sleep 2
shot back
keys o
sleep 2
shot ambient
keys o
sleep 2
shot method
keys equal equal equal
sleep 2
shot radius
keys O
keys O
sleep 2
shot lamp
keys t
sleep 2
shot translucent
keys b
sleep 2
shot variance
keys g g g
sleep 2
shot sigma
keys b
sleep 2
shot gradient
keys b
sleep 2
shot whole
keys t
sleep 2
shot opaque
close_window
