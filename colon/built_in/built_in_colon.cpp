// Samples the built-in anatomy into a CT: tissue, fat and the air around the body, the lumen with its tagged
// fluid, the scanner's blur and noise. Blocks of voxels far from the lumen skip the implicit function. Edges
// have the profile of a flat wall under a Gaussian blur: the lumen's share of a voxel is the cumulative
// normal distribution of the voxel's distance to the wall.
#include "colon/built_in/built_in_colon.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "colon/built_in/built_in_anatomy.h"
#include "engine/base/parallel.h"

namespace stereonav {
namespace {

constexpr glm::dvec3 kExtent_mm{358.4, 358.4, 328.8};  // 512 x 512 x 411 voxels of 0.7 x 0.7 x 0.8 mm
constexpr double kAir = -1000, kTissue = 40, kFat = -90, kFluid = 400;  // HU
constexpr double kBlur = 0.7;                                           // mm: sigma of the blur
constexpr double kNoise = 15;                                           // HU: sigma of the noise
constexpr int kBlock = 8;                                               // voxels along each side of a block
constexpr double kReach = 4;  // mm: voxels further from the wall hold one material alone

// A table of the cumulative normal distribution from -4 to 4 sigma, in steps of sigma / 32.
struct EdgeProfile {
    static constexpr int kSteps = 256;
    float share[kSteps + 2];
    double perMm;
    explicit EdgeProfile(double sigma) : perMm(kSteps / (8 * sigma)) {
        for (int n = 0; n <= kSteps + 1; ++n)
            share[n] = static_cast<float>(0.5 * std::erfc(-(n * 8.0 / kSteps - 4) / std::sqrt(2.0)));
    }
    double at(double mm) const {
        const double x = std::clamp(mm * perMm + kSteps / 2.0, 0.0, kSteps - 1e-6);
        const int n = static_cast<int>(x);
        return share[n] + (x - n) * (share[n + 1] - share[n]);
    }
};

// Returns noise that is about normally distributed, with sigma 1: the sum of the four bytes of a hash of the
// voxel's number (Irwin-Hall distribution).
float noiseAt(std::uint32_t seed, std::uint32_t voxel) {
    std::uint32_t z = voxel * 0x9E3779B1u ^ seed;
    z = (z ^ (z >> 16)) * 0x85EBCA6Bu;
    z = (z ^ (z >> 13)) * 0xC2B2AE35u;
    z ^= z >> 16;
    const std::uint32_t pairs = (z & 0x00FF00FFu) + ((z >> 8) & 0x00FF00FFu);
    const int sum = static_cast<int>((pairs & 0xFFFF) + (pairs >> 16));
    return static_cast<float>(sum - 510) * (1 / 147.8f);
}

class Sampler {
public:
    Sampler(const BuiltInAnatomy& anatomy, GreyVolume& grey, std::uint64_t seed)
        : mAnatomy(anatomy),
          mGrey(grey),
          mSpacing(grey.frame.spacing * 1000.0),
          mOrigin(grey.frame.origin * 1000.0),
          mEdge(std::max(kBlur, 0.45 * std::max({mSpacing.x, mSpacing.y, mSpacing.z}))),
          mSeed(static_cast<std::uint32_t>(seed * 0x9E3779B97F4A7C15ull >> 32)) {
        makeBody();
    }

    void fillSlab(int slab) {
        const int k0 = slab * kBlock, k1 = std::min(k0 + kBlock, mGrey.frame.size.z);
        for (int k = k0; k < k1; ++k) std::ranges::copy(mBody, &mGrey.at(0, 0, k));
        std::vector<int> candidates(mAnatomy.axis().size());
        for (int j0 = 0; j0 < mGrey.frame.size.y; j0 += kBlock)
            for (int i0 = 0; i0 < mGrey.frame.size.x; i0 += kBlock) fillBlock({i0, j0, k0}, candidates);
        for (int k = k0; k < k1; ++k)
            for (int j = 0; j < mGrey.frame.size.y; ++j) addNoise(j, k);
    }

private:
    glm::dvec3 placeOf(const glm::dvec3& voxel) const { return mOrigin + voxel * mSpacing; }

    // Makes a slice of the body, which is the same at every height: a superellipse with muscle and organs
    // inside a layer of fat.
    void makeBody() {
        const glm::ivec3 size = mGrey.frame.size;
        mBody.resize(static_cast<std::size_t>(size.x) * size.y);
        parallelFor(size.y, [&](int j) {
            const double y = std::abs(mOrigin.y + j * mSpacing.y) / 140, yy = y * y * std::sqrt(y);
            for (int i = 0; i < size.x; ++i) {
                const double x = std::abs(mOrigin.x + i * mSpacing.x) / 175,
                             shape = x * x * std::sqrt(x) + yy;
                const double skin = (std::pow(shape, 0.4) - 1) * 140;  // mm outside the skin, about
                const double inside = mEdge.at(-skin), organs = mEdge.at(-skin - 6);
                mBody[static_cast<std::size_t>(j) * size.x + i] = static_cast<std::int16_t>(
                    std::lround(kAir + inside * (kFat - kAir) + organs * (kTissue - kFat)));
            }
        });
    }

    void fillBlock(const glm::ivec3& first, std::vector<int>& candidates) {
        const glm::ivec3 last = glm::min(first + kBlock, mGrey.frame.size);
        const glm::dvec3 low = placeOf(glm::dvec3(first)), high = placeOf(glm::dvec3(last - 1));
        const glm::dvec3 middle = 0.5 * (low + high);
        const double half = 0.5 * glm::length(high - low);
        const int count = findCandidates(middle, half, candidates);
        if (count == 0) return;
        for (int k = first.z; k < last.z; ++k)
            for (int j = first.y; j < last.y; ++j)
                for (int i = first.x; i < last.x; ++i) fillVoxel({i, j, k}, candidates.data(), count);
    }

    // Finds the axis points that may be the nearest one to some voxel of the block. Returns how many there
    // are, 0 where the whole block is far from the lumen.
    int findCandidates(const glm::dvec3& middle, double half, std::vector<int>& candidates) const {
        const std::vector<AxisPoint>& axis = mAnatomy.axis();
        double least = 1e30;
        for (std::size_t n = 0; n < axis.size(); n += 2)
            least = std::min(least, glm::length(middle - axis[n].place) - axis[n].radius);
        // The margin of 3 mm is for the points in between: only every second one was tested. They lie 1 mm
        // apart, and the radius changes by less than 1 mm from one to the next.
        if (least > half + std::max(kReach, 4 / mEdge.perMm * 32) + 3) return 0;
        int count = 0;
        for (std::size_t n = 0; n < axis.size(); ++n)
            if (glm::length(middle - axis[n].place) - axis[n].radius <= least + 2 * half + 2)
                candidates[count++] = static_cast<int>(n);
        return count;
    }

    void fillVoxel(const glm::ivec3& v, const int* candidates, int count) {
        const glm::dvec3 p = placeOf(glm::dvec3(v));
        const BuiltInAnatomy::Place place = mAnatomy.placeOf(p, candidates, count);
        const double lumen = mEdge.at(-place.wall);
        if (lumen <= 0) return;
        const FluidLevel& fluid = mAnatomy.fluid();
        double content = kAir;
        if (place.along > fluid.from && place.along < fluid.to)
            content += mEdge.at(p.y - fluid.y) * (kFluid - kAir);
        std::int16_t& value = mGrey.at(v);
        value = static_cast<std::int16_t>(std::lround(value + lumen * (content - value)));
    }

    void addNoise(int j, int k) {
        std::int16_t* row = &mGrey.at(0, j, k);
        const std::uint32_t start = static_cast<std::uint32_t>(mGrey.frame.index(0, j, k));
        for (int i = 0; i < mGrey.frame.size.x; ++i) {
            const float noisy =
                static_cast<float>(row[i]) +
                static_cast<float>(kNoise) * noiseAt(mSeed, start + static_cast<std::uint32_t>(i));
            row[i] = static_cast<std::int16_t>(static_cast<int>(noisy + 2048.5f) - 2048);
        }
    }

    const BuiltInAnatomy& mAnatomy;
    GreyVolume& mGrey;
    glm::dvec3 mSpacing, mOrigin;  // mm
    EdgeProfile mEdge;
    std::uint32_t mSeed;
    std::vector<std::int16_t> mBody;  // a slice without the colon
};

VolumeFrame frameOf(const glm::ivec3& size) {
    VolumeFrame frame;
    frame.size = size;
    frame.spacing = kExtent_mm * 0.001 / glm::dvec3(size);
    frame.origin = -0.5 * frame.spacing * glm::dvec3(size - 1);
    return frame;
}

void checkSize(const glm::ivec3& size) {
    const int low = std::min({size.x, size.y, size.z}), high = std::max({size.x, size.y, size.z});
    if (low < 32 || high > 1024)
        throw Error("built-in colon", "size",
                    fmt::format("expected 32 to 1024 voxels along each axis, got {} x {} x {}", size.x,
                                size.y, size.z),
                    "512 x 512 x 411 is a good size");
}

void checkBend(double bend, double inflation) {
    if (!(bend >= 0 && bend <= 0.03 && inflation >= 0.7 && inflation <= 1.4))
        throw Error("built-in colon", "bend",
                    fmt::format("expected 0 to 0.03 m and an inflation of 0.7 to 1.4, got {:g} and {:g}",
                                bend, inflation),
                    "0 and 1 leave it as it is");
}

Centreline axisLine(const BuiltInAnatomy& anatomy) {
    Centreline line;
    for (const AxisPoint& point : anatomy.axis())
        line.points.push_back(
            {point.place * 0.001, std::max(-anatomy.placeOf(point.place).wall, 0.0) * 0.001, 1});
    return line;
}
}  // namespace

BuiltInColon builtInColon(const BuiltInColonSetting& setting, Progress& progress) {
    checkSize(setting.size);
    checkBend(setting.bend, setting.inflation);
    BuiltInColon colon;
    colon.grey = GreyVolume(frameOf(setting.size));
    const glm::dvec3 spacing = colon.grey.frame.spacing * 1000.0;
    // Walls of two and a half voxels at least, or loops would join on coarse grids.
    const double gap = std::max(4.0, 2.5 * std::max({spacing.x, spacing.y, spacing.z}));
    const BuiltInAnatomy anatomy(setting.seed, gap, 1000 * setting.bend, setting.inflation);
    Sampler sampler(anatomy, colon.grey, setting.seed);
    const int slabs = (setting.size.z + kBlock - 1) / kBlock;
    ProgressSteps filled(progress, slabs, "making the built-in colon");
    parallelFor(slabs, [&](int slab) {
        sampler.fillSlab(slab);
        filled.done();
    });
    for (const BuiltInPolyp& polyp : anatomy.polyps()) colon.polyps.push_back(polyp.data);
    colon.axis = axisLine(anatomy);
    return colon;
}

}  // namespace stereonav
