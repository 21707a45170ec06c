#include "engine/light/bake/bake_rate.h"

#include <sys/resource.h>

#include <algorithm>
#include <atomic>
#include <glm/common.hpp>
#include <numeric>
#include <random>

#include "engine/base/parallel.h"
#include "engine/base/stopwatch.h"
#include "engine/light/skies/spherical_harmonics.h"

namespace stereonav {
namespace {

template <typename Piece>
std::vector<std::size_t> sizesOf(const std::vector<Piece>& pieces) {
    std::vector<std::size_t> sizes;
    sizes.reserve(pieces.size());
    for (const Piece& piece : pieces) sizes.push_back(piece.size());
    return sizes;
}

std::size_t litOf(const std::vector<TexelSum>& sums) {
    return static_cast<std::size_t>(
        std::count_if(sums.begin(), sums.end(), [](const TexelSum& s) { return s.samples > 0; }));
}

}  // namespace

std::vector<TexelPiece> shuffledBricks(const glm::ivec3& size, unsigned seed) {
    std::vector<TexelPiece> bricks;
    for (int k = 0; k < size.z; k += 8)
        for (int j = 0; j < size.y; j += 8)
            for (int i = 0; i < size.x; i += 8) {
                TexelPiece brick;
                const glm::ivec3 end = glm::min(glm::ivec3(i, j, k) + 8, size);
                for (int z = k; z < end.z; ++z)
                    for (int y = j; y < end.y; ++y)
                        for (int x = i; x < end.x; ++x) brick.push_back({x, y, z});
                bricks.push_back(std::move(brick));
            }
    std::shuffle(bricks.begin(), bricks.end(), std::mt19937(seed));
    return bricks;
}

std::vector<TexelPiece> inSmallPieces(const std::vector<TexelPiece>& pieces) {
    constexpr std::size_t kPiece = 64;
    std::vector<TexelPiece> small;
    for (const TexelPiece& piece : pieces)
        for (std::size_t n = 0; n < piece.size(); n += kPiece)
            small.emplace_back(
                piece.begin() + static_cast<std::ptrdiff_t>(n),
                piece.begin() + static_cast<std::ptrdiff_t>(std::min(n + kPiece, piece.size())));
    std::shuffle(small.begin(), small.end(), std::mt19937(2));
    return small;
}

double processorSeconds() {
    rusage use{};
    getrusage(RUSAGE_SELF, &use);
    return static_cast<double>(use.ru_utime.tv_sec + use.ru_stime.tv_sec) +
           1e-6 * static_cast<double>(use.ru_utime.tv_usec + use.ru_stime.tv_usec);
}

BakeRate bakeRate(std::span<const std::size_t> sizes, double seconds, int samples,
                  const std::function<std::size_t(std::size_t)>& light) {
    std::atomic<std::size_t> next{0}, done{0}, lit{0};
    const std::size_t all = std::accumulate(sizes.begin(), sizes.end(), std::size_t{0});
    const Stopwatch watch;
    const double before = processorSeconds();
    parallelFor(threadCount(), [&](int) {
        do {
            const std::size_t n = next++;
            if (n >= sizes.size()) return;
            lit += light(n);
            done += sizes[n];
        } while (watch.elapsed_ms() < 1000 * seconds);
    });
    const double took = watch.elapsed_ms() / 1000;
    const double used = processorSeconds() - before;
    BakeRate rate;
    rate.part = static_cast<double>(done) / static_cast<double>(all);
    rate.processor_s = used / rate.part;
    rate.texels = static_cast<double>(done) / took;
    rate.all_s = static_cast<double>(all) / rate.texels;
    rate.onSurface = static_cast<double>(lit) / static_cast<double>(done);
    rate.samples_s = static_cast<double>(lit) * samples / used;
    return rate;
}

BakeRate irradianceRate(const TexelLighter& lighter, const std::vector<TexelPiece>& pieces, int samples,
                        double seconds) {
    return bakeRate(sizesOf(pieces), seconds, samples, [&](std::size_t n) {
        std::vector<TexelSum> sums(pieces[n].size());
        lighter.addIrradiance(pieces[n], samples, sums);
        return litOf(sums);
    });
}

BakeRate transferRate(const TexelLighter& lighter, const std::vector<TexelPiece>& pieces, int samples,
                      int order, int channels, double seconds) {
    const auto numbers = static_cast<std::size_t>(harmonicsCount(order)) * channels;
    return bakeRate(sizesOf(pieces), seconds, samples, [&](std::size_t n) {
        std::vector<float> sums(pieces[n].size() * numbers);
        std::vector<std::uint8_t> alive(pieces[n].size());
        lighter.addTransfer(pieces[n], 0, samples, order, channels, sums, alive);
        return static_cast<std::size_t>(std::count(alive.begin(), alive.end(), std::uint8_t{1}));
    });
}

BakeRate pointRate(const TexelLighter& lighter, const std::vector<PointPiece>& pieces, int samples,
                   double seconds) {
    return bakeRate(sizesOf(pieces), seconds, samples, [&](std::size_t n) {
        std::vector<TexelSum> sums(pieces[n].size());
        lighter.addIrradianceAt(pieces[n], samples, sums);
        return pieces[n].size();
    });
}

}  // namespace stereonav
