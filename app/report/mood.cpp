#include "app/report/mood.h"

#include <algorithm>
#include <vector>

#include "engine/base/parallel.h"
#include "engine/base/stopwatch.h"

namespace stereonav {

double triadRate() {
    constexpr int kChunk = 1 << 15, kChunks = 128, kRuns = 5;  // doubles
    constexpr std::size_t kCount = static_cast<std::size_t>(kChunk) * kChunks;
    std::vector<double> a(kCount, 0.0), b(kCount, 1.0), c(kCount, 2.0);
    double best = 0;
    for (int run = 0; run < kRuns; ++run) {
        const double k = 0.5 + run;
        const Stopwatch watch;
        parallelFor(
            kChunks,
            [&](int chunk) {
                const std::size_t first = static_cast<std::size_t>(chunk) * kChunk;
                for (std::size_t n = first; n < first + kChunk; ++n) a[n] = b[n] + k * c[n];
            },
            Schedule::Contiguous);
        best = std::max(best, 24e-6 * static_cast<double>(kCount) / watch.elapsed_ms());
    }
    return best;
}

double fixedWork_ms() {
    double least = 1e300;
    for (int run = 0; run < 3; ++run) {
        const Stopwatch watch;
        double x = 0.5;
        for (int n = 0; n < 500'000; ++n) x = 3.7 * x * (1 - x);  // each step depends on the one before
        least = std::min(least, watch.elapsed_ms() + (x < 0 ? 1 : 0));
    }
    return least;
}

}  // namespace stereonav
