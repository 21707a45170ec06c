// Deals numbered pieces of work to threads: from the head of one queue, or by the static partitions of
// Wan et al. 2004, section 3. A piece also gets the number of its worker, which owns scratch memory.
#pragma once

#include <algorithm>
#include <atomic>

#include "engine/base/parallel.h"

namespace stereonav {

// Calls body(worker, piece) for every piece in [0, count), worker in [0, threadCount()); calls with the
// same worker do not overlap.
template <typename Body>
void forEachPiece(int count, Schedule schedule, const Body& body) {
    if (count <= 0) return;
    const int workers = std::min(threadCount(), count);
    std::atomic<int> next{0};
    const auto work = [&](int worker) {
        if (schedule == Schedule::Dynamic) {
            for (int i = next++; i < count; i = next++) body(worker, i);
        } else if (schedule == Schedule::Interleaved) {
            for (int i = worker; i < count; i += workers) body(worker, i);
        } else {
            const auto edge = [&](int w) {
                return static_cast<int>(static_cast<long long>(count) * w / workers);
            };
            for (int i = edge(worker); i < edge(worker + 1); ++i) body(worker, i);
        }
    };
    parallelFor(workers, work);
}

}  // namespace stereonav
