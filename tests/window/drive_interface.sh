#!/bin/bash
# What scripts share that drive the window's panels with the mouse; sourced by them, as drive_window.sh.
. "$(dirname "$0")/drive_window.sh"
words() {
    xdotool type --delay 40 -- "$1"
    sleep 0.4
}
saved() { [ -s "$out/$1" ]; }
# save_scene NAME: through the dialog
save_scene() {
    keys ctrl+s
    sleep 0.5
    keys ctrl+a
    words "$out/$1"
    keys Return
    until_true saved "$1"
    sleep 1 # the dialog is gone
}
at() { xdotool mousemove --window "$window" "$1" "$2"; }
press() {
    at "$1" "$2"
    sleep 0.3
    xdotool mousedown "${3:-1}"
    sleep 0.2
    xdotool mouseup "${3:-1}"
    sleep 0.4
}
# drag_by X Y DX DY
drag_by() {
    at "$1" "$2"
    sleep 0.3
    xdotool mousedown 1
    sleep 0.2
    for n in 1 2 3 4 5 6; do
        at $(($1 + $3 * n / 6)) $(($2 + $4 * n / 6))
        sleep 0.1
    done
}
let_go() {
    xdotool mouseup 1
    sleep 1
}
