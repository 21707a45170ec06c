# For scripts that need an X server of their own; sourced by them.

# start_server FOLDER COMMAND ...: the command is that of a server. It takes a free number by itself, so that many can
# start at once, and ends with this script; DISPLAY is set to it. False where it does not start: FOLDER/server.txt says
# why.
start_server() {
    local folder=$1 end=$((SECONDS + 300))
    shift
    rm -f "$folder/number"
    "$@" -noreset -nolisten tcp -displayfd 3 3>"$folder/number" >"$folder/server.txt" 2>&1 &
    server_pid=$!
    trap 'kill $server_pid 2>/dev/null; wait $server_pid 2>/dev/null' EXIT
    until [ -s "$folder/number" ]; do
        kill -0 "$server_pid" 2>/dev/null || return 1
        [ "$SECONDS" -lt "$end" ] || return 1
        sleep 0.05
    done
    export DISPLAY=":$(cat "$folder/number")"
    unset WAYLAND_DISPLAY XAUTHORITY
}
