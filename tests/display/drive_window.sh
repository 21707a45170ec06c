#!/bin/bash
# What the scripts that drive the viewer's window share; sourced by them, with PROGRAM and FOLDER as the first
# two arguments. The program leaves its pictures in FOLDER/shots and its log in FOLDER/log.txt.
set -u
program=$1
out=$2
shots=$out/shots
mkdir -p "$shots"

fail() {
    echo "$*" >>"$out/problems.txt"
    kill "$pid" 2>/dev/null
    exit 1
}
pictures() { find "$shots" -name 'stereonav_*.png' | wc -l; }
keys() { xdotool key --clearmodifiers "$@"; }
hold() {
    xdotool keydown "$1"
    sleep "$2"
    xdotool keyup "$1"
}

# open_window ARGUMENT ...: of the program. Waits for its window and for the first picture in it.
open_window() {
    "$program" view "$@" --size 320x240 --mode sbsl --shots "$shots" >"$out/log.txt" 2>&1 &
    pid=$!
    window=
    for _ in $(seq 300); do
        window=$(xdotool search --onlyvisible --name '^stereonav' 2>/dev/null | head -n 1)
        [ -n "$window" ] && break
        kill -0 "$pid" 2>/dev/null || fail "the program ended before its window opened"
        sleep 0.1
    done
    [ -n "$window" ] || fail "no window within 30 seconds"
    xdotool windowfocus --sync "$window"
    # Keys that come while the scene loads are dropped: ask until the first picture is there.
    for _ in $(seq 120); do
        keys p
        sleep 0.5
        [ "$(pictures)" -gt 0 ] && break
        kill -0 "$pid" 2>/dev/null || fail "the program ended while it loaded"
    done
}

# shot STEP [KEY]: the picture after everything pressed so far, named in steps.txt.
shot() {
    local before
    before=$(pictures)
    keys "${2:-p}"
    for _ in $(seq 600); do
        [ "$(pictures)" -gt "$before" ] && break
        kill -0 "$pid" 2>/dev/null || fail "the program ended before the picture of step $1"
        sleep 0.05
    done
    [ "$(pictures)" -gt "$before" ] || fail "no picture for step $1"
    echo "$1 $(find "$shots" -name 'stereonav_*.png' | sort | tail -n 1)" >>"$out/steps.txt"
}

# Escape, and the exit status in status.txt.
close_window() {
    keys Escape
    for _ in $(seq 200); do
        kill -0 "$pid" 2>/dev/null || break
        sleep 0.05
    done
    if kill -0 "$pid" 2>/dev/null; then fail "Escape did not end the program"; fi
    wait "$pid"
    echo $? >"$out/status.txt"
}
