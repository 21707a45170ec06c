// Each call to the system fails once under each command: never a wrong file and exit status 0, never a lost
// one. STEREONAV_ALL_FAULTS=1 tries every call but of videos' writes, STEREONAV_FAULT_TABLE=FILE keeps what
// came of them.
#include <algorithm>
#include <fstream>

#include "tests/faults/fault_case.h"

namespace stereonav::test {
namespace {

constexpr std::uint64_t kSample = 1, kMost = 400;  // faults of a kind and command

class Faults : public FaultTest {
protected:
    void tryAll(const std::string& prefix, std::uint64_t sample) const {
        const bool whole = std::getenv("STEREONAV_ALL_FAULTS") != nullptr;
        int tried = 0;
        for (const FaultCase& one : cases()) {
            if (!one.name.starts_with(prefix)) continue;
            const auto tallies = tryFaults(one, whole ? kMost : sample);
            for (std::size_t k = 0; k < tallies.size(); ++k) {
                keep(one.name, kFaultKinds[k], tallies[k]);
                tried += tallies[k].tried;
            }
        }
        EXPECT_GT(tried, 0);
    }

    static void keep(const std::string& name, const std::string& kind, const FaultTally& tally) {
        const char* file = std::getenv("STEREONAV_FAULT_TABLE");
        if (!file || tally.calls == 0) return;
        std::ofstream(file, std::ios::app)
            << name << '\t' << kind << '\t' << tally.calls << '\t' << tally.tried << '\t' << tally.refused
            << '\t' << tally.whole << '\n';
    }
};

TEST_F(Faults, OfPictures) {
    tryAll("render", kSample);
}

TEST_F(Faults, OfFlights) {
    tryAll("play", kSample);
}

TEST_F(Faults, OfComparisons) {
    tryAll("compare", kSample);
}

TEST_F(Faults, OfMeshesAndCentrelines) {
    tryAll("mesh", kSample);
    tryAll("centreline", kSample);
}

TEST_F(Faults, OfInstrumentsOfColons) {
    for (const char* command : {"coverage", "findings", "register", "unfold"}) tryAll(command, kSample);
}

TEST_F(Faults, OfBakes) {
    tryAll("bake", kSample);
}

// A bake that can not be read now may be whole: it is not written over. One of these holds more than is asked
// for, so that a bake that was made anew would be another; of the others the exit status tells.
TEST_F(Faults, OfBakesThatAreThere) {
    const std::string scene = hills(), study = maskedTube();
    const auto tube = [&](const char* samples) {
        return std::vector<std::string>{"bake",  study,       "--no-cache", "--resolution",
                                        "0.2",   "--bounces", "0",          "--samples",
                                        samples, "--out",     "a.bake"};
    };
    const auto ground = [&](const char* what) {
        return std::vector<std::string>{"bake",         scene, "--what", what,
                                        "--resolution", "0.5", "--out",  "a.light"};
    };
    const FaultCase cases[] = {{"less of a volume", tube("1"), "", false, madeBy(tube("3"))},
                               {"more of a volume", tube("5"), "", false, madeBy(tube("3"))},
                               {"openness", ground("openness"), "", false, madeBy(ground("openness"))},
                               {"transfer", ground("transfer"), "", false, madeBy(ground("transfer"))}};
    for (const FaultCase& one : cases) {
        EXPECT_FALSE(one.there.empty()) << one.name;
        for (const std::string kind : {"read", "open"}) {
            const auto tallies = tryFaults(one, kMost, kind);
            const auto k = std::find(kFaultKinds.begin(), kFaultKinds.end(), kind) - kFaultKinds.begin();
            keep(one.name, kind, tallies[k]);
            EXPECT_GE(tallies[k].refused, kind == "read" ? 2 : 1) << one.name << ": " << kind;
        }
    }
}

TEST_F(Faults, OfFactsAndReports) {
    tryAll("info", kSample);
    tryAll("report", kSample);
}

// Sizes of which a library has copied frames into memory that it did not check for; and a codec whose only
// word about an allocation that failed is in its log.
TEST_F(Faults, OfMemoryUnderFramesWithOddRows) {
    const FaultCase video{"play odd rows",
                          {"play", hills(), "--size", "330x240", "--frames", "2", "--video", "a.mp4"},
                          "a.mp4"};
    EXPECT_GT(tryFaults(video, 40, "memory")[kFaultKinds.size() - 1].refused, 5);
}

// The layer itself: a run without a fault makes calls of each kind, and one that fails is seen.
TEST_F(Faults, AreSeen) {
    const FaultCase picture = cases().front();
    const auto tallies = tryFaults(picture, 1);
    for (std::size_t k = 0; k < tallies.size(); ++k) EXPECT_GT(tallies[k].calls, 0u) << kFaultKinds[k];
    EXPECT_EQ(tallies[0].refused, 1) << "a write that failed";
    EXPECT_EQ(tallies[2].refused, 1) << "a file that was not renamed";
}

}  // namespace
}  // namespace stereonav::test
