#include "engine/peers/core_share.h"

#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <bit>

namespace stereonav {

ProcessPlace placeOfThisProcess() {
    ProcessPlace place;
    char name[256] = "";
    gethostname(name, sizeof name - 1);
    place.machine = name;
    cpu_set_t set;
    CPU_ZERO(&set);
    sched_getaffinity(0, sizeof set, &set);
    for (std::size_t core = 0; core < 64 * place.cores.size() && core < CPU_SETSIZE; ++core)
        if (CPU_ISSET(core, &set)) place.cores[core / 64] |= std::uint64_t{1} << core % 64;
    return place;
}

std::vector<int> coreShares(const std::vector<ProcessPlace>& places) {
    std::vector<int> shares;
    for (const ProcessPlace& place : places) {
        int cores = 0;
        for (const std::uint64_t word : place.cores) cores += std::popcount(word);
        const auto same = std::ranges::count_if(places, [&](const ProcessPlace& other) {
            return other.machine == place.machine && other.cores == place.cores;
        });
        shares.push_back(std::max(1, cores / static_cast<int>(same)));
    }
    return shares;
}

}  // namespace stereonav
