#!/bin/bash
# Runs a command on a virtual display of its own, however many others do.
#   own_display.sh FOLDER COMMAND ...
set -u
. "$(dirname "$0")/../support/start_server.sh"
folder=$1
shift
start_server "$folder" Xvfb -screen 0 1280x1024x24 ||
    { echo "Xvfb does not start: $(tail -n 1 "$folder/server.txt")" >&2; exit 1; }
"$@"
