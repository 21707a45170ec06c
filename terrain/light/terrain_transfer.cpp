#include "terrain/light/terrain_transfer.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "engine/light/skies/spherical_harmonics.h"
#include "engine/math/constants.h"

namespace stereonav {
namespace {

// The integral of sqrt(1 - z^2) from -1 to z.
double circlePart(double z) {
    return 0.5 * (std::asin(z) + z * std::sqrt(std::max(0.0, 1 - z * z)) + kPi / 2);
}

// Azimuth in degrees of |m| at which sin(|m| phi) is 1, and 0 for m >= 0: there a harmonic is its part in z.
double azimuthOfFullValue(int m) {
    return m < 0 ? kPi / (2 * -m) : 0.0;
}

struct Band {
    int l, m;
};
Band bandOf(int k) {
    const int l = static_cast<int>(std::sqrt(k + 0.5));
    return {l, k - l * (l + 1)};
}

// The even coefficients without their azimuth's factor at sine z.
void polarParts(double z, int order, double* values) {
    double all[kMaxHarmonics];
    const double level = std::sqrt(std::max(0.0, 1 - z * z));
    for (int m = 1 - order; m < order; ++m) {
        const double phi = azimuthOfFullValue(m);
        evaluateHarmonics(glm::dvec3(level * std::cos(phi), level * std::sin(phi), z), order, all);
        for (int n = 0; n < lightHarmonics(order); ++n)
            if (bandOf(lightHarmonic(n)).m == m) values[n] = all[lightHarmonic(n)];
    }
}

// A well-mixed 64-bit number (the finalizer of splitmix64).
std::uint64_t mixed(std::uint64_t x) {
    x += 0x9e3779b97f4a7c15ull;
    x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9ull;
    x = (x ^ x >> 27) * 0x94d049bb133111ebull;
    return x ^ x >> 31;
}

double share(std::uint64_t bits) {
    return static_cast<double>(bits >> 11) * 0x1p-53;
}

double fraction(double x) {
    return x - std::floor(x);
}

// Adds weight times the field at a place on the ground.
void addField(const LightGrid& grid, const glm::dvec2& place, const TransferField& field, int count,
              float weight, float* sum) {
    const LightGrid::Place x = grid.placeX(place.x), y = grid.placeY(place.y);
    for (int c = 0; c < 4; ++c) {
        const float w = weight * (c & 1 ? x.next : 1 - x.next) * (c & 2 ? y.next : 1 - y.next);
        const std::size_t at = static_cast<std::size_t>(y.index + (c >> 1)) * grid.width + x.index + (c & 1);
        const std::int16_t* from = &field[at * count];
        for (int k = 0; k < count; ++k) sum[k] += w * static_cast<float>(from[k]);
    }
}

// Directions into the ground that a sample sees: a wedge by its share, in it anywhere, with the weight that
// makes the mean right. Low-discrepancy: strata for the wedge, and Roberts' R2 sequence (2018) shifted
// by a number of the sample's own for the place in it.
class GroundDirections {
public:
    GroundDirections(const SkyWedges& wedges, std::uint64_t seed, int count)
        : mWedges(wedges), mCount(count), mSum(wedges.wedges().size() + 1, 0.0) {
        for (std::size_t a = 0; a < wedges.wedges().size(); ++a)
            mSum[a + 1] = mSum[a] + wedges.wedges()[a].ground;
        std::uint64_t state = seed;
        for (double& s : mShift) s = share(state = mixed(state));
    }

    double total() const { return mSum.back(); }

    struct Direction {
        glm::dvec3 unit;
        double weight;  // relative to the others'
    };
    Direction at(int m) {
        constexpr double kG = 1.32471795724474602596;  // the plastic number
        const double u = (m + mShift[0]) / mCount * total();
        while (mWedge + 1 < mSum.size() - 1 && mSum[mWedge + 1] <= u) ++mWedge;
        const SkyWedges::Wedge& w = mWedges.wedges()[mWedge];
        const double turn = (fraction(mShift[1] + m / kG) - 0.5) * 2 * kPi / (mSum.size() - 1);
        const double z = w.bottom + (w.top - w.bottom) * fraction(mShift[2] + m / (kG * kG));
        const double level = std::sqrt(std::max(0.0, 1 - z * z));
        const double c = std::cos(turn) * level, s = std::sin(turn) * level;
        const glm::dvec3 d(c * w.dx - s * w.dy, c * w.dy + s * w.dx, z);
        const double cosine = std::max(0.0, glm::dot(d, mWedges.normal()));
        return {d, w.ground > 0 ? cosine * (w.top - w.bottom) / w.ground : 0.0};
    }

private:
    const SkyWedges& mWedges;
    int mCount;
    std::vector<double> mSum;
    double mShift[3];
    std::size_t mWedge = 0;
};

}  // namespace

SkyWedges::SkyWedges(int azimuths) : mWedges(static_cast<std::size_t>(azimuths) * kSteps) {
    for (std::size_t a = 0; a < mWedges.size(); ++a) {
        const glm::dvec2 d = azimuthDirection(static_cast<double>(a), static_cast<int>(mWedges.size()));
        mWedges[a] = {d.x, d.y, 0, 0, 0, 0};
    }
}

void SkyWedges::set(const glm::dvec3& normal, const std::uint8_t* horizon, std::size_t planeSize) {
    mNormal = normal;
    const std::size_t azimuths = mWedges.size() / kSteps;
    const double perWedge = 2.0 / static_cast<double>(mWedges.size());  // dphi / pi
    mOpenness = 0;
    for (std::size_t a = 0; a < mWedges.size(); ++a) {
        Wedge& w = mWedges[a];
        const std::size_t before = a / kSteps, after = (before + 1) % azimuths;
        const double t = static_cast<double>(a % kSteps) / kSteps;
        const double sine = ((1 - t) * horizon[before * planeSize] + t * horizon[after * planeSize]) / 255;
        w.along = normal.x * w.dx + normal.y * w.dy;
        const double run = std::sqrt(w.along * w.along + normal.z * normal.z);
        w.bottom = run > 0 ? std::clamp(-w.along / run, -1.0, 1.0) : 0.0;
        w.top = std::max(sine, w.bottom);
        const double toTop = circlePart(w.top), sky = kPi / 2 - toTop;
        const auto weight = [&](double circle, double from, double to) {
            return w.along * circle + 0.5 * normal.z * (to * to - from * from);
        };
        w.ground = std::max(0.0, perWedge * weight(toTop - circlePart(w.bottom), w.bottom, w.top));
        // Where the hemisphere itself begins below the horizontal and nothing stands above it, the light
        // from below is none.
        mOpenness += std::max(0.0, perWedge * weight(sky, w.top, 1.0));
    }
    mOpenness = std::min(mOpenness, 1.0);
}

SkyTransfer::SkyTransfer(int order, int azimuths) : mCount(lightHarmonics(order)) {
    const int steps = azimuths * SkyWedges::kSteps;
    mIntegrals.assign(static_cast<std::size_t>(kEntries + 1) * mCount * 2, 0.0f);
    // Gauss-Legendre of 3 points in each interval, summed from the zenith down.
    constexpr double kNode[3] = {-0.77459666924148338, 0, 0.77459666924148338};
    constexpr double kWeight[3] = {5.0 / 9, 8.0 / 9, 5.0 / 9};
    std::vector<double> sum(2 * static_cast<std::size_t>(mCount), 0.0);
    double parts[kMaxHarmonics];
    for (int e = kEntries - 1; e >= 0; --e) {
        for (int g = 0; g < 3; ++g) {
            const double z = (e + 0.5 + 0.5 * kNode[g]) / kEntries, w = 0.5 * kWeight[g] / kEntries;
            polarParts(z, order, parts);
            for (std::size_t k = 0; 2 * k < sum.size(); ++k) {
                sum[2 * k] += w * parts[k] * std::sqrt(1 - z * z);
                sum[2 * k + 1] += w * parts[k] * z;
            }
        }
        std::copy(sum.begin(), sum.end(), mIntegrals.begin() + static_cast<std::ptrdiff_t>(e) * mCount * 2);
    }
    for (int a = 0; a < steps; ++a)
        for (int k = 0; k < mCount; ++k) {
            const int m = bandOf(lightHarmonic(k)).m;
            const double phi = a * 2 * kPi / steps;
            mAzimuth.push_back(
                static_cast<float>(2.0 / steps * (m < 0 ? std::sin(-m * phi) : std::cos(m * phi))));
        }
}

void SkyTransfer::direct(const SkyWedges& wedges, float* transfer) const {
    std::fill_n(transfer, mCount, 0.0f);
    const float up = static_cast<float>(wedges.normal().z);
    const float* factor = mAzimuth.data();
    const std::ptrdiff_t count = mCount;
    for (const SkyWedges::Wedge& w : wedges.wedges()) {
        const float at = static_cast<float>(std::clamp(w.top, 0.0, 1.0) * kEntries);
        const int e = std::min(static_cast<int>(at), kEntries - 1);
        const float next = at - static_cast<float>(e), along = static_cast<float>(w.along);
        const float* low = &mIntegrals[static_cast<std::size_t>(e) * mCount * 2];
        const float* high = low + 2 * count;
        for (std::ptrdiff_t k = 0; k < count; ++k) {
            const float level = low[2 * k] + next * (high[2 * k] - low[2 * k]);
            const float rise = low[2 * k + 1] + next * (high[2 * k + 1] - low[2 * k + 1]);
            transfer[k] += factor[k] * (along * level + up * rise);
        }
        factor += mCount;
    }
}

void gatherBounce(const GroundRays& rays, const glm::ivec2& sample, std::uint64_t number,
                  const SkyWedges& wedges, const SentLight& sent, const GatherSetting& setting,
                  float* transfer) {
    std::fill_n(transfer, setting.count, 0.0f);
    const Heightfield& ground = rays.ground();
    GroundDirections directions(wedges, mixed(setting.seed) ^ number, setting.rays);
    if (!(directions.total() > 0)) return;
    const glm::dvec2 world = ground.worldFromGrid(sample);
    const double height = ground.sample(sample.x, sample.y) - rays.centreHeight() + rays.lift();
    double weights = 0;
    float sum[kMaxHarmonics] = {};
    for (int first = 0; first < setting.rays; first += RayPacket::kSize) {
        RayPacket packet;
        double weight[RayPacket::kSize];
        for (int k = 0; k < RayPacket::kSize; ++k) {
            const auto direction = directions.at(first + k);
            weight[k] = direction.weight;
            weights += direction.weight;
            packet.originX[k] = static_cast<float>(world.x);
            packet.originY[k] = static_cast<float>(world.y);
            packet.originZ[k] = static_cast<float>(height);
            packet.directionX[k] = static_cast<float>(direction.unit.x);
            packet.directionY[k] = static_cast<float>(direction.unit.y);
            packet.directionZ[k] = static_cast<float>(direction.unit.z);
            packet.nearest[k] = 0;
        }
        rays.intersect(packet, (1u << RayPacket::kSize) - 1);
        for (int k = 0; k < RayPacket::kSize; ++k) {
            const double t = packet.distance[k];
            if (!std::isfinite(t) || !(weight[k] > 0)) continue;
            const glm::dvec2 hit = world + t * glm::dvec2(packet.directionX[k], packet.directionY[k]);
            addField(sent.grid, sent.ground.gridFromWorld(hit + sent.offset), sent.field, setting.count,
                     static_cast<float>(weight[k]), sum);
        }
    }
    if (!(weights > 0)) return;
    const auto scale = static_cast<float>(setting.albedo * directions.total() / weights);
    for (int k = 0; k < setting.count; ++k) transfer[k] = scale * sum[k];
}

}  // namespace stereonav
