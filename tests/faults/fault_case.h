// A command under the fault layer (layer/fault_layer.cpp): run once without a fault, then with one call of
// one kind failing in turn, each time over old files that must survive.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "tests/app/volume_input.h"

namespace stereonav::test {

constexpr std::array kFaultKinds = {"write", "sync", "rename", "create", "read", "open", "memory"};
constexpr std::size_t kLeastAllocation = 200'000;  // bytes: of those that count as calls

using FaultCounts = std::array<std::uint64_t, kFaultKinds.size()>;

struct FaultCase {
    std::string name;
    std::vector<std::string> arguments;
    std::string old;     // a file in the place that holds something before each run; "": none
    bool timed = false;  // what is written holds times, so that two runs differ in figures
    // Content by name: other files in the place before each run. Where there are some, only calls on the
    // place's files fail.
    std::map<std::string, std::string> there = {};
};

// What came of the runs of one command with one kind of call.
struct FaultTally {
    std::uint64_t calls = 0;  // without a fault
    int tried = 0, refused = 0, whole = 0;
};

class FaultTest : public VolumeTest {
protected:
    void SetUp() override;

    // Every command that writes, and some that only read.
    std::vector<FaultCase> cases() const;

    // Returns what the command leaves in the place, which is empty before: content by name.
    std::map<std::string, std::string> madeBy(const std::vector<std::string>& arguments) const;

    // most: faults that are tried of each kind, spread over the calls; asserts for each.
    // only: of this kind alone; "": of all.
    std::array<FaultTally, kFaultKinds.size()> tryFaults(const FaultCase& one, std::uint64_t most,
                                                         const std::string& only = "") const;

private:
    using Files = std::map<std::string, std::string>;  // content by name below the place

    struct Ended {
        Outcome outcome;
        FaultCounts calls{};
        Files files;
    };
    Ended runWith(const FaultCase& one, const char* kind, std::uint64_t at) const;
    void expectNothingLost(const FaultCase& one, const Ended& whole, const Ended& now) const;
    Files filesInPlace() const;
    void clearPlace() const;
};

}  // namespace stereonav::test
