#!/bin/bash
# What scripts share that drive the window's panels with the mouse; sourced by them, as drive_window.sh.
. "$(dirname "$0")/drive_window.sh"
words() {
    xdotool type --delay 20 -- "$1"
    turns
}
saved() { [ -s "$out/$1" ]; }
# save_scene NAME: through the dialog
save_scene() {
    keys ctrl+s
    turns
    keys ctrl+a
    words "$out/$1"
    keys Return
    until_true saved "$1"
    turns
}
# drag_by X Y DX DY
drag_by() {
    at "$1" "$2"
    turns
    xdotool mousedown 1
    turns
    for n in 1 2 3 4 5 6; do
        at $(($1 + $3 * n / 6)) $(($2 + $4 * n / 6))
        turns 1
    done
    turns
}
# What was changed is a step that can be undone by itself once the window's clock has passed a little.
let_go() {
    xdotool mouseup 1
    pass 0.7
}
