#include "app/command/together.h"

#include <algorithm>
#include <cstdio>
#include <string_view>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "engine/base/stop.h"
#include "engine/base/stopwatch.h"
#include "engine/peers/launch.h"
#include "engine/peers/naps.h"
#include "engine/peers/peers.h"
#include "engine/text/printed.h"

namespace stereonav {
namespace {

constexpr std::string_view kSharing[] = {"bake", "coverage", "play", "report"};
constexpr double kFirstTells_s = 3;  // time for the first process to report an error that all have

bool& joining() {
    static bool is = false;
    return is;
}

// Returns whether the first process reports the error, asked before processes can talk: where one fails the
// launcher ends all, and first sends a stop.
bool leftToTheFirst() {
    if (!joining() || launchOfThisProcess().rank == 0) return false;
    Naps naps;
    for (const Stopwatch watch; watch.elapsed_ms() < 1000 * kFirstTells_s; naps.nap(false))
        if (stopWished()) return true;
    return false;
}

}  // namespace

void joinOthers(int argc, char** argv) {
    if (argc < 2 || std::ranges::find(kSharing, std::string_view(argv[1])) == std::end(kSharing)) return;
    if (!launchOfThisProcess().several) return;
    joining() = true;
    std::string words;
    for (int n = 1; n < argc; ++n) words += std::string(argv[n]) + '\n';
    joinRun(words);
    // The report takes times on one process only, which then uses the whole machine.
    const int threads = peersOfThisRun().threads();
    if (threads > 0 && std::string_view(argv[1]) != "report") setThreadCount(threads);
    if (!peersOfThisRun().first() && !std::freopen("/dev/null", "w", stdout))
        throw Error("/dev/null", "", "can not be opened", "");
}

void leaveOthers() {
    Peers& peers = peersOfThisRun();
    if (!peers.alone() && stopWished()) peers.fail("");
    peers.leave();
}

int endWith(const std::string& line) {
    if (!peersOfThisRun().alone()) peersOfThisRun().fail(line);
    if (!leftToTheFirst()) printNote(line);
    return 1;
}

int endStopped() {
    if (!peersOfThisRun().alone()) peersOfThisRun().fail(peersOfThisRun().first() ? "stopped" : "");
    if (!joining() || launchOfThisProcess().rank == 0) printNote("stopped");
    return 1;
}

}  // namespace stereonav
