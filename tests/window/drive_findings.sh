#!/bin/bash
# Drives findings in the viewer's window: one on a polyp, the program killed, opened again, one beside the polyp; run it
# inside own_display.sh.
#   drive_findings.sh PROGRAM FOLDER STUDY
# Leaves copies of the kept file (kept_first.json, kept_second.json), the log and the exit status in FOLDER;
# view_findings_window_test.cpp judges them.
. "$(dirname "$0")/drive_interface.sh"
study=$3
kept() { find "$HOME/.local/share/stereonav/findings" -name '[!.]*.json' 2>/dev/null | head -n 1; }
findings() { [ -n "$(kept)" ] && grep -c '"place_mm"' "$(kept)" || echo 0; }
more_findings() { [ "$(findings)" -gt "$1" ]; }
measured() { [ "$(grep -c '"diameter_mm"\|"note"' "$(kept)")" -ge "$(findings)" ]; }
# add X Y: of a picture that rests
add() {
    local before
    before=$(findings)
    at "$1" "$2"
    at_rest
    keys ctrl+f
    until_true more_findings "$before"
}

# Eyes that are given do not follow the room, which takes long to come to rest; a screen that is known is not asked for,
# over the picture.
eyes="--separation 0.001 --zero-parallax 0.03 --screen-width 600"
size=640x480
open_window "$study" $eyes
[ -z "$(kept)" ] || fail "findings are kept before there are any"
add 285 85
until_true measured
cp "$(kept)" "$out/kept_first.json"
kill -9 "$pid"
wait "$pid" 2>/dev/null
cmp -s "$(kept)" "$out/kept_first.json" || fail "the kept file changed when the program was killed"

# What was kept is there again. Beside it is no polyp.
open_window "$study" $eyes
add 450 330
until_true measured
cp "$(kept)" "$out/kept_second.json"
close_window
