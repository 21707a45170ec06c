#include "engine/base/pages.h"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <vector>

namespace stereonav {
namespace {

// bytes: a multiple of 64.
bool allZero(const unsigned char* from, std::size_t bytes) {
    for (const unsigned char* end = from + bytes; from < end; from += 64) {
        std::uint64_t words[8], any = 0;
        std::memcpy(words, from, sizeof words);
        for (const std::uint64_t word : words) any |= word;
        if (any != 0) return false;
    }
    return true;
}

}  // namespace

std::size_t residentBytes(const void* start, std::size_t bytes) {
    if (bytes == 0) return 0;
    const auto page = static_cast<std::size_t>(sysconf(_SC_PAGE_SIZE));
    std::vector<unsigned char> held((bytes + page - 1) / page);
    if (mincore(const_cast<void*>(start), held.size() * page, held.data()) != 0) return bytes;
    const auto count = std::count_if(held.begin(), held.end(), [](unsigned char c) { return c & 1; });
    return std::min(bytes, page * static_cast<std::size_t>(count));
}

void releaseZeroPages(const void* start, std::size_t bytes) {
    const auto page = static_cast<std::size_t>(sysconf(_SC_PAGE_SIZE));
    const auto before = reinterpret_cast<std::uintptr_t>(start) % page;
    const std::size_t skipped = before == 0 ? 0 : page - before;
    if (bytes < skipped + page) return;
    const auto* at = static_cast<const unsigned char*>(start) + skipped;
    const auto* const end = at + (bytes - skipped) / page * page;
    while (at < end) {
        const auto* zeros = at;
        while (zeros < end && allZero(zeros, page)) zeros += page;
        if (zeros > at) madvise(const_cast<unsigned char*>(at), zeros - at, MADV_DONTNEED);
        at = zeros + page;
    }
}

}  // namespace stereonav
