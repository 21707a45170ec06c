#!/bin/bash
# Does what a cat on the desk does, so many times eight things: keys, motion, clicks, drags, the wheel, sizes,
# minimising; run it inside own_display.sh.
#   drive_random.sh PROGRAM FOLDER ROUNDS SEED [ARGUMENT ...]
# The program is opened again where a random click closed it. Leaves a line for each opening in runs.txt (exit status,
# threads, open files and resident KiB once its first picture is shown and at the end; between them in states.txt), its
# output in log.txt, and in events.txt what was done last.
. "$(dirname "$0")/drive_window.sh"
rounds=$3
RANDOM=$4
shift 4
cd "$out" || exit 1
letters=(a b c d e f g h i j k l m n o p r s t u v w x y z 0 1 2 3 4 5 6 7 8 9 space Tab Return BackSpace Delete comma period
    minus equal bracketleft bracketright semicolon apostrophe Prior Next Left Right Up Down Home End F1 F2 F3 F4 F5 F6 F7 F9
    F11 F12 ctrl+p ctrl+o ctrl+n ctrl+s ctrl+b ctrl+z ctrl+y shift+z shift+t shift+o shift+m)
pick() { echo $((RANDOM % $1)); }
# One thing after another, as xdotool's own commands.
event() {
    local x y
    x=$(pick 1300)
    y=$(pick 800)
    case $(pick 12) in
        0 | 1 | 2 | 3) echo "key --clearmodifiers ${letters[$(pick ${#letters[@]})]}" ;;
        4 | 5 | 6) echo "mousemove $x $y click 1" ;;
        7) echo "mousemove $x $y mousedown 1 mousemove $(pick 1300) $(pick 800) sleep 0.05 mousemove $(pick 1300) $(pick 800) mouseup 1" ;;
        8) echo "mousemove $x $y click --repeat 3 $((4 + RANDOM % 2))" ;;
        9) echo "mousemove $x $y click 3" ;;
        10) echo "mousemove $x $y click --repeat 2 --delay 30 1" ;;
        11)
            case $(pick 6) in
                0) echo "windowsize $window $((64 + RANDOM % 1300)) $((64 + RANDOM % 900))" ;;
                1) echo "windowminimize $window sleep 0.3 windowmap $window" ;;
                2) echo "keydown w sleep 0.$(pick 9) keyup w" ;;
                3) echo "type --delay 10 ab-12.5" ;;
                *) echo "windowfocus $window" ;;
            esac
            ;;
    esac
}
state() {
    echo "$(ls "/proc/$pid/task" 2>/dev/null | wc -l) $(ls "/proc/$pid/fd" 2>/dev/null | wc -l) $(sed -n 's/^VmRSS:[^0-9]*\([0-9]*\).*/\1/p' "/proc/$pid/status" 2>/dev/null)"
}
# soon COMMAND ...: until it succeeds, or the program has ended
soon() {
    local end=$((SECONDS + patience))
    until "$@" || ! alive || [ "$SECONDS" -ge "$end" ]; do nap; done
}
ended() { ! alive; }
while [ "$rounds" -gt 0 ]; do
    rm -f "$recent"
    "$program" view "$@" --size 640x560 --mode sbsl --shots "$shots" >>log.txt 2>&1 &
    pid=$!
    soon found_window
    xdotool windowfocus "$window" 2>/dev/null
    soon [ -s "$recent" ]
    first=$(state)
    last=$first
    while [ "$rounds" -gt 0 ] && alive; do
        for _ in 1 2 3 4 5 6 7 8; do
            event
            echo "sleep 0.01"
        done >batch.txt
        cat batch.txt >>events.txt
        xdotool batch.txt >/dev/null 2>&1
        "$client" turns "$window" 2 2>/dev/null
        last=$(state)
        rounds=$((rounds - 1))
        echo "$rounds $last" >>states.txt
    done
    # What is open is closed: a text that is written keeps the keys.
    for _ in 1 2 3 4 5 6 7 8; do
        alive || break
        xdotool windowmap "$window" windowfocus "$window" key ctrl+q 2>/dev/null
        "$client" turns "$window" 2 2>/dev/null
    done
    soon ended
    alive && { echo "did not end" >>log.txt; kill -ABRT "$pid"; }
    wait "$pid"
    echo "status $? first $first last $last" >>runs.txt
done
rm -rf "$shots"
