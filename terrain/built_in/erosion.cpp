// Stream-power erosion on a grid. One thread: a sweep follows the rivers, and takes milliseconds.
#include "terrain/built_in/erosion.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

#include "terrain/built_in/noise.h"

namespace stereonav {
namespace {

struct Step {
    int dx, dy;
    float length;  // in samples
};
constexpr std::array<Step, 8> kSteps{{{1, 0, 1},
                                      {0, 1, 1},
                                      {-1, 0, 1},
                                      {0, -1, 1},
                                      {1, 1, 1.41421356f},
                                      {-1, 1, 1.41421356f},
                                      {-1, -1, 1.41421356f},
                                      {1, -1, 1.41421356f}}};

// Least fall along a river, metres a metre: keeps the order of heights strict.
constexpr float kLeastSlope = 2e-4f;

bool onBorder(int x, int y, int size) {
    return x == 0 || y == 0 || x == size - 1 || y == size - 1;
}

// The neighbour down the steepest slope, with slopes weighed by up to a half at random.
void findReceivers(Landscape& land, const Noise& noise) {
    const int n = land.size;
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
            const int i = y * n + x;
            land.receiver[i] = i;
            if (onBorder(x, y, n)) continue;
            float steepest = 0;
            for (int k = 0; k < 8; ++k) {
                const int j = i + kSteps[k].dy * n + kSteps[k].dx;
                const float fall = (land.height[i] - land.height[j]) / kSteps[k].length;
                if (fall <= 0) continue;
                const float weighed = fall * (0.5f + 0.5f * noise.white(8 * x + k, y));
                if (weighed <= steepest) continue;
                steepest = weighed;
                land.receiver[i] = j;
            }
        }
}

// Indices by rising height. Radix sort: heights are not negative, so their bits order as they do.
std::vector<std::int32_t> byHeight(const std::vector<float>& height) {
    constexpr int kBits = 11, kBuckets = 1 << kBits;
    const std::size_t count = height.size();
    std::vector<std::int32_t> order(count), next(count);
    for (std::size_t i = 0; i < count; ++i) order[i] = static_cast<std::int32_t>(i);
    for (int shift = 0; shift < 32; shift += kBits) {
        std::array<std::size_t, kBuckets> start{};
        const auto bucket = [&](std::int32_t i) {
            return std::bit_cast<std::uint32_t>(height[i]) >> shift & (kBuckets - 1);
        };
        for (std::int32_t i : order) ++start[bucket(i)];
        std::size_t sum = 0;
        for (auto& s : start) sum += std::exchange(s, sum);
        for (std::int32_t i : order) next[start[bucket(i)]++] = i;
        order.swap(next);
    }
    return order;
}

float distanceToReceiver(const Landscape& land, std::int32_t i) {
    const std::int32_t d = std::abs(land.receiver[i] - i);
    return land.spacing * (d == 1 || d == land.size ? 1.0f : 1.41421356f);
}

void accumulateDrainage(Landscape& land, const std::vector<std::int32_t>& order) {
    std::fill(land.drainage.begin(), land.drainage.end(), land.spacing * land.spacing);
    for (auto it = order.rbegin(); it != order.rend(); ++it)
        if (land.receiver[*it] != *it) land.drainage[land.receiver[*it]] += land.drainage[*it];
}

}  // namespace

void fillDepressions(Landscape& land) {
    using Entry = std::pair<float, std::int32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
    const int n = land.size;
    std::vector<bool> seen(land.height.size(), false);
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x)
            if (onBorder(x, y, n)) {
                seen[y * n + x] = true;
                open.push({land.height[y * n + x], y * n + x});
            }
    while (!open.empty()) {
        const auto [height, i] = open.top();
        open.pop();
        const int x = i % n, y = i / n;
        for (const Step& step : kSteps) {
            const int nx = x + step.dx, ny = y + step.dy;
            if (nx < 0 || ny < 0 || nx >= n || ny >= n || seen[ny * n + nx]) continue;
            const int j = ny * n + nx;
            seen[j] = true;
            land.height[j] = std::max(land.height[j], height + kLeastSlope * land.spacing * step.length);
            open.push({land.height[j], j});
        }
    }
}

void erode(Landscape& land, float dt, float erodibility, std::uint64_t seed) {
    land.receiver.resize(land.height.size());
    land.drainage.resize(land.height.size());
    findReceivers(land, Noise(seed));
    const auto order = byHeight(land.height);
    accumulateDrainage(land, order);
    for (const std::int32_t i : order) {
        const std::int32_t r = land.receiver[i];
        if (r == i) continue;
        const float distance = distanceToReceiver(land, i);
        const float cut = erodibility * dt * std::sqrt(land.drainage[i]) / distance;
        const float raised = land.height[i] + land.uplift[i] * dt;
        const float balanced = (raised + cut * land.height[r]) / (1 + cut);
        land.height[i] = std::clamp(balanced, land.height[r] + kLeastSlope * distance,
                                    land.height[r] + land.talus[i] * distance);
    }
}

}  // namespace stereonav
