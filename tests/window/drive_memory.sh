#!/bin/bash
# Opens the viewer's window on a scene, flies a little and saves pictures, and notes the memory that it took;
# run it inside own_display.sh.
#   drive_memory.sh PROGRAM FOLDER SIZE SCENE [OPTION ...]
# Leaves the most bytes that no file backs in FOLDER/taken.txt, what was asked for in FOLDER/asked.txt
# (STEREONAV_MEMORY_ASKED), the log and the exit status; view_memory_window_test.cpp judges them.
. "$(dirname "$0")/drive_window.sh"
size=$3
shift 3

exec 9>>"$out/asked.txt"
export STEREONAV_MEMORY_ASKED=9
open_window "$@"
most=0
look() {
    local now
    now=$(awk '/^RssAnon:/ { print 1024 * $2 }' "/proc/$pid/status")
    [ "${now:-0}" -gt "$most" ] && most=$now
}
look
for _ in 1 2 3; do
    hold w 0.4
    look
    take
    look
done
echo "$most" >"$out/taken.txt"
close_window
