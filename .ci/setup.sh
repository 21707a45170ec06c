# Shell functions that run.sh, test.sh and .ci/run share: install what is missing, configure, build.
# Sourced, never run. All messages go to standard error, so that a program's output stays its own.

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"

say() { echo "$(basename "$0"): $*" >&2; }
fail() { say "$*"; exit 1; }

# packages_for GROUP...: names from packages.txt of these groups
packages_for() {
    local groups=" $* " name group
    while read -r name group; do
        [[ -n $name && $name != \#* && $groups == *" $group "* ]] && echo "$name"
    done < "$root/.ci/packages.txt"
    return 0
}

# missing_packages NAME...: those that dpkg does not know as installed
missing_packages() {
    local installed name
    installed=" $(dpkg-query -W -f='${db:Status-Status}:${Package} ' "$@" 2>/dev/null || true) "
    for name in "$@"; do
        [[ $installed == *" installed:$name "* ]] || echo "$name"
    done
}

# install_missing GROUP...
install_missing() {
    local wanted missing as_root=()
    if ! command -v dpkg-query >/dev/null; then
        say "this is not a Debian system: nothing is installed; .ci/packages.txt names what is needed"
        return
    fi
    mapfile -t wanted < <(packages_for "$@")
    mapfile -t missing < <(missing_packages "${wanted[@]}")
    [[ ${#missing[@]} -gt 0 ]] || return 0
    if [[ $(id -u) -ne 0 ]]; then
        command -v sudo >/dev/null ||
            fail "needs packages, but this is not root and there is no sudo; as root run:" \
                 "apt-get install --no-install-recommends ${missing[*]}"
        as_root=(sudo)
    fi
    say "installing ${#missing[@]} Debian packages${as_root[0]:+ through sudo}: ${missing[*]}"
    apt_get update || say "the package lists could not be renewed, going on with those that are there"
    apt_get install -y --no-install-recommends "${missing[@]}" ||
        fail "the packages could not be installed; see apt's message above, or install them by hand:" \
             "${missing[*]}"
}

# apt_get ARGUMENTS...: quiet but for errors and progress; uses as_root of install_missing
apt_get() {
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q "$@" >&2
}

# configure PRESET [CMAKE ARGUMENTS...]: does nothing while the preset's folder is current
configure() {
    local preset="$1" folder="$root/build/$1" stamp wanted
    shift
    stamp="$folder/.configured"
    wanted="$root $*"
    if [[ -f $folder/build.ninja && ! $root/CMakePresets.json -nt $stamp &&
          $(cat "$stamp" 2>/dev/null) == "$wanted" ]]; then
        return
    fi
    say "configuring $preset in build/$preset"
    (cd "$root" && cmake --fresh --preset "$preset" "$@" >&2) ||
        fail "cmake failed for the preset $preset; its message is above"
    echo "$wanted" > "$stamp"
}

# build PRESET [TARGETS...]
build() {
    local preset="$1"
    shift
    ninja -C "$root/build/$preset" "$@" >&2 || fail "the build of preset $preset failed; the first error is above"
}

# with_display COMMAND...: under a virtual display of its own, so that no window opens on the user's
with_display() {
    env -u WAYLAND_DISPLAY xvfb-run -a -n "$((200 + $$ % 30000))" -s "-noreset -screen 0 1280x1024x24" "$@"
}

# run_tests PRESET [CTEST ARGUMENTS...]: under a virtual display; then how many tests there were and what was skipped
run_tests() {
    local preset="$1" status=0
    shift
    (cd "$root" && with_display ctest --preset "$preset" --no-tests=error -j "$(nproc)" "$@") || status=$?
    "$root/.ci/skipped" "$root/build/$preset/Testing/Temporary/LastTest.log"
    return "$status"
}
