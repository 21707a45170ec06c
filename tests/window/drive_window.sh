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

# start_window ARGUMENT ...: of the program. Waits for its window. A picture that rests stays as it was made, so that two
# of one place are the same.
start_window() {
    "$program" view "$@" --refine off --shots "$shots" >"$out/log.txt" 2>&1 &
    pid=$!
    window=
    for _ in $(seq 1200); do
        window=$(xdotool search --onlyvisible --name '^stereonav' 2>/dev/null | head -n 1)
        [ -n "$window" ] && break
        kill -0 "$pid" 2>/dev/null || fail "the program ended before its window opened"
        sleep 0.1
    done
    [ -n "$window" ] || fail "no window within two minutes"
    xdotool search --onlyvisible --class '^stereonav$' 2>/dev/null | grep -qx "$window" ||
        fail "the window's class is not stereonav, by which packaging/entry.desktop knows it"
    xdotool windowfocus --sync "$window"
}

# open_window ARGUMENT ...: of the program; $size: of its pictures, where 320x240 will not do. Waits for its window and
# for the first picture in it.
open_window() {
    start_window "$@" --size "${size:-320x240}" --mode sbsl
    first_picture
    # Those that were asked for once it was loaded, so that none of them is taken for a step's.
    local before=0
    while [ "$(pictures)" -gt "$before" ]; do
        before=$(pictures)
        sleep 2
    done
}

# Waits for one that is not there yet.
first_picture() {
    local before
    before=$(pictures)
    # Keys that come while the scene loads are dropped: ask until the first picture is there.
    for n in $(seq 1200); do
        [ $((n % 20)) -eq 1 ] && keys p
        sleep 0.1
        [ "$(pictures)" -gt "$before" ] && return
        kill -0 "$pid" 2>/dev/null || fail "the program ended while it loaded"
    done
    fail "no picture within two minutes"
}

# until_true COMMAND ...: within half a minute
until_true() {
    for _ in $(seq 300); do
        "$@" && return
        kill -0 "$pid" 2>/dev/null || fail "the program ended before: $*"
        sleep 0.1
    done
    fail "not within half a minute: $*"
}
titled() { [ "$(xdotool getwindowname "$window")" = "stereonav - $1" ]; }

# take [KEY]: the picture after everything pressed so far; its file in $picture.
take() {
    local before
    before=$(pictures)
    keys "${1:-p}"
    for _ in $(seq 1200); do
        [ "$(pictures)" -gt "$before" ] && break
        kill -0 "$pid" 2>/dev/null || fail "the program ended before a picture"
        sleep 0.05
    done
    [ "$(pictures)" -gt "$before" ] || fail "no picture within a minute"
    picture=$(find "$shots" -name 'stereonav_*.png' | sort | tail -n 1)
}

# shot STEP [KEY]: the picture at once, named in steps.txt: of what keys change in the next picture.
shot() {
    take "${2:-p}"
    echo "$1 $picture" >>"$out/steps.txt"
}

# differing STEP OTHER: the first picture that is not that of step OTHER, named in steps.txt.
differing() {
    local other
    other=$(sed -n "s/^$2 //p" "$out/steps.txt")
    for _ in $(seq 100); do
        take
        if ! cmp -s "$other" "$picture"; then
            echo "$1 $picture" >>"$out/steps.txt"
            return
        fi
    done
    fail "step $1 shows what step $2 does"
}

# settled STEP [OTHER]: the picture once three in a row are the same, named in steps.txt: of what moves by itself, or
# takes longer than a picture. Not before it differs from that of step OTHER.
settled() {
    local same=0 last='' other=''
    [ $# -gt 1 ] && other=$(sed -n "s/^$2 //p" "$out/steps.txt")
    for _ in $(seq 100); do
        take
        if [ -n "$last" ] && cmp -s "$last" "$picture"; then same=$((same + 1)); else same=0; fi
        if [ "$same" -ge 2 ] && ! { [ -n "$other" ] && cmp -s "$other" "$picture"; }; then
            echo "$1 $picture" >>"$out/steps.txt"
            return
        fi
        last=$picture
        sleep 0.3
    done
    fail "step $1 does not come to rest${2:+, or shows what step $2 does}"
}

# Escape, and the exit status in status.txt.
close_window() {
    keys Escape
    for _ in $(seq 1200); do
        kill -0 "$pid" 2>/dev/null || break
        sleep 0.05
    done
    if kill -0 "$pid" 2>/dev/null; then fail "Escape did not end the program"; fi
    wait "$pid"
    echo $? >"$out/status.txt"
}
