#!/bin/bash
# Loads, bakes and movies that are cancelled, or whose window is closed or told to stop, and files that can not be
# opened; run it inside own_display.sh.
#   drive_jobs.sh PROGRAM FOLDER LARGE_STUDY SMALL_STUDY DEM DAMAGED_FILE
# The large one takes long to load on one thread, as a surface with ambient light and modulated opacity.
# Leaves in FOLDER: pictures (named in steps.txt), the movie that was made to its end, what was copied of the failure
# (failure.txt), a line for each end of a window in ends.txt (its name and exit status), what lay about and should not in
# left.txt; view_jobs_window_test.cpp judges them.
. "$(dirname "$0")/drive_interface.sh"
large=$3 small=$4 dem=$5 damaged=$6
cd "$out" || exit 1
export TMPDIR=$out/tmp
mkdir -p "$TMPDIR"
# look STEP: nothing half-written lies about
look() {
    find "$out" -name '*.part*' -o -name '*.tmp*' -o -name '*.mp4' -o -name 'window_*.light' -o -path "$TMPDIR/*" |
        sed "s/^/$1 /" >>"$out/left.txt"
}
# insist COMMAND ...: while something is at work the first wish to close only asks
insist() {
    local end=$((SECONDS + patience))
    "$@"
    alive && turns
    works || fail "$*: the job ends unasked"
    while alive; do
        [ "$SECONDS" -lt "$end" ] || fail "$* does not close the window"
        "$@" 2>/dev/null
        nap
    done
}
# ended STEP: the window, and the job with it
ended() {
    await_end "$1"
    echo "$1 $status" >>"$out/ends.txt"
    [ -z "$process" ] || ! kill -0 "$process" 2>/dev/null || fail "$1: its job goes on"
    look "$1"
}
# Whether a command runs beside the window; in $process.
works() {
    process=$(cat "/proc/$pid/task/"*/children 2>/dev/null | tr -d ' \n')
    [ -n "$process" ]
}
rests() { ! works; }
# Clock ticks that a process has worked. What has used some is at work.
ticks_of() { awk '{ sub(/.*\) /, ""); print $12 + $13 }' "/proc/$1/stat" 2>/dev/null || echo 0; }
used_more() { [ "$(ticks_of "$1")" -gt $(($2 + 30)) ]; }
works_on() { works && used_more "$process" 0; }
writes_movie() { [ -n "$(find "$out" -maxdepth 1 -name '.flight.*.part.mp4')" ]; }
# The button in the notice over the picture's middle, which may have another notice above; that one goes by itself.
cancel() {
    for y in 66 83 66; do press 442 "$y"; done
}
process=

# Closed while it loads.
start_window "$large" --size 320x240 --threads 1
until_true used_more "$pid" 0
"$client" close "$window"
ended closed_loading
[ ! -e "$recent" ] || fail "it was loaded before it was closed"

# Another file is dropped while the first one is loaded: it is shown as it is where it is opened first.
start_window "$small" --size 320x240 --mode sbsl
"$client" drop "$window" "$dem" 2>>"$out/problems.txt" || fail "the drop was not taken"
until_true titled "$dem"
settled dropped
keys space
settled home
close_window

shots=shots # from here: a long name in a notice moves the button below it
start_window terrain --size 900x600 --mode ml --threads 1
first_picture
keys F2
turns
press 750 38 # headings are closed, so that the next ones are at known places
press 750 63
# A load is cancelled, whose notice comes once it has taken half a second.
before=$(ticks_of "$pid")
"$client" drop "$window" "$large" || fail "the drop was not taken"
until_true used_more "$pid" "$before"
pass 0.6
cancel
at_rest
titled terrain || fail "a load that was cancelled took the window"
keys ctrl+z # goes back to nothing
at_rest
titled terrain || fail "a load that was cancelled is a step"
look cancelled_load
take
# A bake is cancelled.
press 750 63
press 732 182
until_true works_on
turns
cancel
until_true rests
turns
look cancelled_bake
take
press 750 63
# A movie is cancelled.
press 750 138
press 837 358
until_true works
until_true writes_movie
turns
cancel
until_true rests
turns
look cancelled_movie
take
# A movie of a short flight, 320x180 pixels an eye, to its end.
keys z
hold w 0.8
keys z
press 630 358
keys ctrl+a
words 320
keys Return
press 690 358
keys ctrl+a
words 180
keys Return
keys 1
turns
press 387 358
until_true [ -s "$out/flight.mp4" ]
until_true rests
turns
# Once more: the one that is there stays.
sum=$(cksum <"$out/flight.mp4")
press 387 358
until_true [ -s "$out/flight_0002.mp4" ]
until_true rests
turns
[ "$sum" = "$(cksum <"$out/flight.mp4")" ] || fail "another movie took the place of the first"
mv "$out/flight.mp4" "$out/made.mp4_"
mv "$out/flight_0002.mp4" "$out/made_again.mp4_"
press 320 257 # saves the flight
keys 0
turns
look made_movie
# A damaged file: what is open goes on, and the line can be copied.
copies() {
    for y in 65 79 93; do press 137 "$y"; done # under one to three lines
    "$client" copied >"$out/failure.txt" 2>/dev/null
}
"$client" drop "$window" "$damaged" || fail "the drop was not taken"
at_rest
until_true copies
titled terrain || fail "a damaged file took the window"
take
# Closed while it bakes.
press 750 63
press 732 182
until_true works_on
insist "$client" close "$window"
ended closed_baking

# Closed by its key, and told to stop, while it makes a movie. The panel is there again.
for step in closed_movie stopped_movie; do
    start_window terrain --size 900x600 --mode ml
    first_picture
    press 750 38
    press 750 63
    press 750 138
    press 837 358
    until_true works
    until_true writes_movie
    if [ "$step" = closed_movie ]; then insist keys ctrl+q; else kill -TERM "$pid"; fi
    ended "$step"
done
