// Divides cores among several processes: those that may run on the same cores share them evenly.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace stereonav {

// The machine of a process, and the cores that it may use there, one bit each.
struct ProcessPlace {
    std::string machine;
    std::array<std::uint64_t, 16> cores{};
};
ProcessPlace placeOfThisProcess();

// Returns how many threads each process gets, 1 or more.
std::vector<int> coreShares(const std::vector<ProcessPlace>& places);

}  // namespace stereonav
