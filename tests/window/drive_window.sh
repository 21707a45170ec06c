#!/bin/bash
# What the scripts that drive the viewer's window share; sourced by them, with PROGRAM and FOLDER as the first
# two arguments. The program leaves its pictures in FOLDER/shots and its log in FOLDER/log.txt.
#
# Nothing here depends on how fast or idle the machine is: what is waited for is seen, with a limit that only a failure
# reaches, and a wait ends at once where the program has ended. What is slept is what a hand takes, or what the window's
# own clock is to pass.
set -u
program=$1
out=$2
shots=$out/shots
client=$(dirname "$program")/test_x_client
patience=300 # seconds, of each wait; x_client has the same
# The program keeps everything in FOLDER, whatever the user's settings are.
export HOME=$out XDG_CACHE_HOME=$out/cache
unset XDG_CONFIG_HOME XDG_DATA_HOME XDG_STATE_HOME
recent=$HOME/.local/state/stereonav/recent.json # written with the first picture of a scene
mkdir -p "$shots"

# A moment, without a process for it: on a busy machine those take long.
exec {never}<> <(:)
nap() { read -rt 0.05 -u "$never"; }

fail() {
    echo "$*" >>"$out/problems.txt"
    kill "$pid" 2>/dev/null
    exit 1
}
alive() { kill -0 "$pid" 2>/dev/null; }
# wait_for WHAT COMMAND ...: until the command succeeds
wait_for() {
    local what=$1 end=$((SECONDS + patience))
    shift
    until "$@"; do
        alive || fail "the program ended before: $what"
        [ "$SECONDS" -lt "$end" ] || fail "not within $patience seconds: $what"
        nap
    done
}
until_true() { wait_for "$*" "$@"; }

keys() { xdotool key --clearmodifiers "$@"; }
# turns [N]: until the window has handled all that was done before, and has gone round so often since
turns() { "$client" turns "$window" "${1:-3}" 2>>"$out/problems.txt" || fail "the window does not answer"; }
# pass SECONDS: of the window's clock, while nothing is done to it
pass() {
    turns
    sleep "$1"
    turns
}
hold() {
    xdotool keydown "$1"
    pass "$2"
    xdotool keyup "$1"
}
at() { xdotool mousemove --window "$window" "$1" "$2"; }
# press X Y [BUTTON]
press() {
    at "$1" "$2"
    turns
    xdotool mousedown "${3:-1}"
    turns
    xdotool mouseup "${3:-1}"
    turns
}
titled() { [ "$(xdotool getwindowname "$window")" = "stereonav - $1" ]; }

# Until all that was asked for is done: no thread of the program works, and the window has taken what came of it.
at_rest() { "$client" rest "$window" "$pid" 2>>"$out/problems.txt" || fail "the window does not come to rest"; }

found_window() {
    window=$(xdotool search --onlyvisible --name '^stereonav' 2>/dev/null | head -n 1)
    [ -n "$window" ]
}
# start_window ARGUMENT ...: of the program. Waits for its window. A picture that rests stays as it was made, so that two
# of one place are the same.
start_window() {
    rm -rf "$recent" "$HOME/.local/share/stereonav/views" # each scene begins at its start
    "$program" view "$@" --refine off --shots "$shots" >"$out/log.txt" 2>&1 &
    pid=$!
    wait_for "its window" found_window
    xdotool search --onlyvisible --class '^stereonav$' 2>/dev/null | grep -qx "$window" ||
        fail "the window's class is not stereonav, by which packaging/entry.desktop knows it"
    xdotool windowfocus --sync "$window"
}
# open_window ARGUMENT ...: of the program; $size: of its pictures, where 320x240 will not do. Waits for its window and
# for the first picture in it.
open_window() {
    start_window "$@" --size "${size:-320x240}" --mode sbsl
    first_picture
}
# The first one that is shown, and the first one that is saved: keys that come while the scene loads are dropped.
first_picture() {
    wait_for "its first picture" [ -s "$recent" ]
    take
}

# look_at_pictures: how many there are in $pictures, the last one in $picture
look_at_pictures() {
    local all=("$shots"/stereonav_*.png)
    pictures=0
    [ -e "${all[0]}" ] || return
    pictures=${#all[@]}
    picture=${all[-1]}
}
more_pictures() {
    look_at_pictures
    [ "$pictures" -gt "$1" ]
}
of_step() { sed -n "s/^$1 //p" "$out/steps.txt"; }
is_step() { echo "$1 $picture" >>"$out/steps.txt"; }
# take [KEY ...]: the picture after everything pressed so far; its file in $picture.
take() {
    look_at_pictures
    keys "${@:-p}"
    wait_for "a picture" more_pictures "$pictures"
}
takes_other() {
    take
    ! cmp -s "$1" "$picture"
}
takes_other_at_rest() {
    at_rest
    takes_other "$1"
}
# shot STEP [KEY ...]: the picture at once, named in steps.txt: of what keys change in the next picture.
shot() {
    take "${@:2}"
    is_step "$1"
}
# differing STEP OTHER: the first picture that is not that of step OTHER, named in steps.txt.
differing() {
    wait_for "step $1 differs from step $2" takes_other "$(of_step "$2")"
    is_step "$1"
}
# settled STEP [OTHER]: the picture once all is done, named in steps.txt: of what moves by itself, or takes longer than a
# picture. Not before it differs from that of step OTHER.
settled() {
    if [ $# -gt 1 ]; then
        wait_for "step $1 differs from step $2" takes_other_at_rest "$(of_step "$2")"
    else
        at_rest
        take
    fi
    is_step "$1"
}

# await_end WHY: until the program has ended; its exit status in $status.
await_end() {
    local end=$((SECONDS + patience))
    while alive; do
        [ "$SECONDS" -lt "$end" ] || fail "$1 did not end the program"
        nap
    done
    wait "$pid"
    status=$?
}
# Ctrl+Q, and the exit status in status.txt.
close_window() {
    keys ctrl+q
    await_end ctrl+q
    echo "$status" >"$out/status.txt"
}
