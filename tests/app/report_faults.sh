#!/usr/bin/env bash
# report_faults.sh PROGRAM: whether `report --compare` catches a deliberate slow-down and a deliberate error, and
# passes where there is none. PROGRAM: built with -DSTEREONAV_FAULTS=ON. A machine that others use may hide a
# slow-down in its noise, never an error.
set -euo pipefail
program="$1"
folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT

# report NAME [VARIABLE=VALUE ...] -- [arguments]: the right eye's part into NAME; tells the exit status
report() {
    local name="$1" status=0
    shift
    local settings=()
    while [[ $1 != -- ]]; do settings+=("$1"); shift; done
    shift
    env "${settings[@]}" "$program" report --quick --minutes 0.1 --threads 1 --parts right-eye --out "$folder/$name" "$@" \
        > "$folder/$name.txt" 2>&1 || status=$?
    echo "$status"
}
# verdict NAME KIND: how many figures of a kind the comparison calls worse
worse() {
    { grep -o '<td>[^<]*/'"$2"'</td>.*<td>worse</td>' "$folder/$1/index.html" || true; } | wc -l
}
fail() { echo "report_faults: $*" >&2; cat "$folder"/*.txt >&2; exit 1; }

[[ $(report old --) == 0 ]] || fail "the first report failed"
old="$folder/old/report.json"
status="$(report error STEREONAV_FAULT_ERROR=0.2 -- --compare "$old")"
[[ $status == 1 && $(worse error error) -gt 0 ]] || fail "a deliberate error was not caught (status $status)"
status="$(report slow STEREONAV_FAULT_SLOW=9 -- --compare "$old")"
[[ $status == 1 && $(worse slow time) -gt 0 ]] || fail "a deliberate slow-down was not caught (status $status)"
[[ $(worse slow error) == 0 ]] || fail "a slow-down was taken for an error"
report same -- --compare "$old" > /dev/null
[[ $(worse same error) == 0 ]] || fail "the same error was called worse"
echo "caught: $(worse error error) errors, $(worse slow time) slow-downs; without a fault $(worse same time) times were called worse"
