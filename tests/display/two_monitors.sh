#!/bin/bash
# Runs a command on a desktop of two monitors: a desk's, 1025x768 at the left, and one of 3840x1080 whose first column
# and row are odd ones of the desktop, 1025 and 33. Needs Xorg with its driver "dummy", and xrandr: a virtual
# framebuffer has one monitor only.
#   two_monitors.sh FOLDER COMMAND ...
# Exit status 77: there is no such server here, and why is printed.
set -u
. "$(dirname "$0")/../support/start_server.sh"
folder=$1
shift
server=$(command -v /usr/lib/xorg/Xorg Xorg | head -n 1)
[ -n "$server" ] || { echo "Xorg is not installed"; exit 77; }
command -v xrandr >/dev/null || { echo "xrandr is not installed"; exit 77; }
cat >"$folder/xorg.conf" <<'END'
Section "Device"
  Identifier "device"
  Driver "dummy"
  VideoRam 256000
EndSection
Section "Monitor"
  Identifier "monitor"
  HorizSync 5-1000
  VertRefresh 5-200
EndSection
Section "Screen"
  Identifier "screen"
  Device "device"
  Monitor "monitor"
  DefaultDepth 24
  SubSection "Display"
    Depth 24
    Virtual 4865 1113
  EndSubSection
EndSection
END
start_server "$folder" "$server" -config "$folder/xorg.conf" -logfile "$folder/xorg.log" -novtswitch -sharevts ||
    { echo "Xorg does not start: $(tail -n 1 "$folder/server.txt")"; exit 77; }
# Clock and sums: columns x rows x refreshes a second.
mode() { xrandr --newmode "$1" "$(awk "BEGIN { print $2 * $3 * $4 / 1e6 }")" "$2" "$2" "$2" "$2" "$3" "$3" "$3" "$3"; }
{
    mode desk 1025 768 60 && mode glasses 3840 1080 120 &&
        xrandr --addmode DUMMY0 desk && xrandr --addmode DUMMY1 glasses &&
        xrandr --output DUMMY0 --primary --mode desk --pos 0x0 --output DUMMY1 --mode glasses --pos 1025x33 &&
        xrandr  # looks again: the second one counts as connected once it shows something
} >"$folder/xrandr.txt" 2>&1 || { echo "two monitors can not be had: $(tail -n 1 "$folder/xrandr.txt")"; exit 77; }
"$@"
