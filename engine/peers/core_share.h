// How many cores each of several processes gets: those that may run on the same ones share them evenly.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace stereonav {

// Where a process runs: its machine, and the cores there that it may use, a bit each.
struct ProcessPlace {
    std::string machine;
    std::array<std::uint64_t, 16> cores{};
};
ProcessPlace placeOfThisProcess();

// Returns how many threads each process gets, 1 or more.
std::vector<int> coreShares(const std::vector<ProcessPlace>& places);

}  // namespace stereonav
