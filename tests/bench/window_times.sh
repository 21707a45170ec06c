#!/bin/bash
# How long the window's own work takes under Xvfb, in milliseconds: panels laid out, pictures uploaded, composed and
# drawn, and the whole turn from the events to the picture, which is how late it can be.
#   tests/bench/window_times.sh PROGRAM SECONDS [SCENE [OPTION ...]]
# The flight goes on for so many seconds with all panels open, 1280x720 pixels an eye side by side; after a third of
# them another scene is opened (STEREONAV_BENCH_OPENS, by default colon).
set -eu
if [ -z "${STEREONAV_BENCH_INSIDE:-}" ]; then
    export STEREONAV_BENCH_INSIDE=1
    exec xvfb-run -a -n "$((200 + $$ % 30000))" -s '-noreset -screen 0 2800x1000x24' "$0" "$@"
fi
program=$1
seconds=$2
shift 2
home=$(mktemp -d)
trap 'rm -rf "$home"' EXIT
HOME=$home STEREONAV_WINDOW_TIMES=1 LIBGL_ALWAYS_SOFTWARE=1 "$program" view "$@" --size 1280x720 --mode sbsl --shots "$home" 2>"$home/times" &
pid=$!
for _ in $(seq 600); do
    window=$(xdotool search --onlyvisible --name '^stereonav' 2>/dev/null | head -n 1 || true)
    [ -n "$window" ] && break
    sleep 0.1
done
xdotool windowfocus "$window"
sleep 3
xdotool key F2 F3
xdotool keydown w
sleep "$((seconds / 3))"
xdotool keyup w
xdotool key ctrl+o
sleep 0.5
xdotool type --delay 30 -- "${STEREONAV_BENCH_OPENS:-colon}"
xdotool key Return
xdotool keydown w
sleep "$((seconds - seconds / 3))"
xdotool keyup w
xdotool key ctrl+q
wait "$pid" || true
cat "$home/times"
