#include "engine/base/pages.h"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <vector>

namespace stereonav {

std::size_t residentBytes(const void* start, std::size_t bytes) {
    if (bytes == 0) return 0;
    const auto page = static_cast<std::size_t>(sysconf(_SC_PAGE_SIZE));
    std::vector<unsigned char> held((bytes + page - 1) / page);
    if (mincore(const_cast<void*>(start), held.size() * page, held.data()) != 0) return bytes;
    const auto count = std::count_if(held.begin(), held.end(), [](unsigned char c) { return c & 1; });
    return std::min(bytes, page * static_cast<std::size_t>(count));
}

}  // namespace stereonav
