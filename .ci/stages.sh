# Shell functions that .ci/run and .ci/nightly share: stages that all run, and a table of how long each took.
# Sourced after setup.sh, never run.

logs="$root/build/ci"
failed=()
table=()

# stage NAME COMMAND...: runs it with its output in build/ci/NAME.log too; a failure ends no other stage
stage() {
    local name="$1" start=$SECONDS status result=passed
    shift
    mkdir -p "$logs"
    echo "== $name"
    ("$@") 2>&1 | tee "$logs/$name.log"
    status=${PIPESTATUS[0]}
    [[ $status -eq 0 ]] || { result=FAILED; failed+=("$name"); }
    echo "== $name: $result in $((SECONDS - start)) s"
    table+=("$(printf '%-12s %6.1f min  %s' "$name" "$(minutes $((SECONDS - start)))" "$result")")
}

minutes() { awk -v seconds="$1" 'BEGIN { printf "%.1f", seconds / 60 }'; }

# stage_table [LIMIT]: a line each stage, and their sum; says so where that is more than LIMIT minutes
stage_table() {
    local sum
    sum="$(minutes "$SECONDS")"
    printf '%s\n' "${table[@]}" "$(printf '%-12s %6.1f min' whole "$sum")"
    [[ -z ${1:-} ]] || awk -v sum="$sum" -v limit="$1" 'BEGIN { exit !(sum > limit) }' || return 0
    [[ -z ${1:-} ]] || say "this took more than its $1 minutes: take away as much as was added, or move it to .ci/nightly"
}

# The sets that STEREONAV_SIMD can leave of this processor's, without its widest.
narrower_sets() {
    local flags
    flags=" $(sed -n 's/^flags[[:space:]]*://p' /proc/cpuinfo 2>/dev/null | head -n 1) "
    [[ $flags != *" avx512vl "* ]] || echo avx2
    [[ $flags != *" avx2 "* ]] || echo plain
}
