// Counts pixels by brick. A texel to either side of a pixel's cell belongs to what its neighbours look up.
#include "engine/light/transfer/seen_bricks.h"

#include <algorithm>
#include <bit>
#include <glm/common.hpp>
#include <utility>

namespace stereonav {
namespace {

// The texel cell of a place along one axis: between the texels, or just beyond the ends, where what lies
// around it is the outermost texel all the same. NaN: the first.
int cellOf(double place, int last) {
    const double bounded = place > -1 ? std::min(place, last + 1.0) : -1.0;
    return static_cast<int>(bounded + 1) - 1;  // floor, of what is not below -1
}

// A brick's pixels, and which of the 27 bricks around it their lookups and a texel more to either side touch:
// bit dx + 3 dy + 9 dz, each 0 to 2 for one back to one on.
struct Tally {
    int pixels = 0;
    std::uint32_t touched = 0;
};

class Tallies {
public:
    explicit Tallies(const IlluminationVolume& light)
        : mLast(light.frame.size - 1),
          mBricks(light.layout.bricks),
          mTallies(static_cast<std::size_t>(mBricks.x) * mBricks.y * mBricks.z) {}

    void count(const glm::dvec3& texel) {
        glm::ivec3 brick;
        std::uint32_t touched = 1;
        for (int axis = 0; axis < 3; ++axis) {
            const int cell = cellOf(texel[axis], mLast[axis]);
            const auto brickOf = [&](int t) { return std::clamp(t, 0, mLast[axis]) >> 3; };
            brick[axis] = brickOf(cell);
            const int back = brick[axis] - brickOf(cell - 1), on = brickOf(cell + 2) - brick[axis];
            const std::uint32_t along = 2u | static_cast<std::uint32_t>(back | on << 2);
            touched = spread(touched, along, axis);
        }
        Tally& tally = mTallies[numberOf(brick)];
        ++tally.pixels;
        tally.touched |= touched;
    }

    // Returns the number of pixels by brick. Bricks that are touched at their faces alone come last.
    std::vector<int> pixels() const {
        std::vector<int> counts(mTallies.size());
        for (std::size_t n = 0; n < mTallies.size(); ++n) {
            counts[n] += mTallies[n].pixels;
            for (std::uint32_t left = mTallies[n].touched; left != 0; left &= left - 1)
                ++counts[n + static_cast<std::size_t>(stepTo(std::countr_zero(left)))];
        }
        return counts;
    }

private:
    std::size_t numberOf(const glm::ivec3& b) const {
        return (static_cast<std::size_t>(b.z) * mBricks.y + b.y) * mBricks.x + b.x;
    }
    std::ptrdiff_t stepTo(int bit) const {
        const int x = bit % 3 - 1, y = bit / 3 % 3 - 1, z = bit / 9 - 1;
        return (static_cast<std::ptrdiff_t>(z) * mBricks.y + y) * mBricks.x + x;
    }
    // Bits of the axes before, once for each of three steps along this one.
    static std::uint32_t spread(std::uint32_t bits, std::uint32_t along, int axis) {
        const int step = axis == 0 ? 1 : axis == 1 ? 3 : 9;
        std::uint32_t all = 0;
        for (int n = 0; n < 3; ++n) all |= bits * (along >> n & 1u) << n * step;
        return all;
    }

    glm::ivec3 mLast, mBricks;
    std::vector<Tally> mTallies;
};

// Places of hits in the texels' grid: linear in pixel and depth, so that nothing is divided for each.
class TexelPlaces {
public:
    TexelPlaces(const EyeView& view, const VolumeFrame& frame)
        : mEye(frame.voxelFromWorld(view.eye)),
          mFirst(frame.voxelDirection(view.rayDirection(0.5, 0.5))),
          mAcross(frame.voxelDirection(view.right * view.pixelWidth())),
          mDown(frame.voxelDirection(-view.up * view.pixelHeight())) {}
    glm::dvec3 at(int x, int y, double depth) const {
        return mEye + depth * (mFirst + static_cast<double>(x) * mAcross + static_cast<double>(y) * mDown);
    }

private:
    glm::dvec3 mEye, mFirst, mAcross, mDown;
};

}  // namespace

std::vector<std::uint32_t> bricksSeen(const EyeView& view, const EyeImage& image,
                                      const IlluminationVolume& light, int every) {
    Tallies tallies(light);
    const TexelPlaces places(view, light.frame);
    for (int y = every / 2; y < image.height(); y += every)
        for (int x = every / 2; x < image.width(); x += every) {
            const double depth = image.viewDepth.at(x, y);
            if (depth > 0 && depth < kMissDepth) tallies.count(places.at(x, y, depth));
        }
    const std::vector<int> pixels = tallies.pixels();
    std::vector<std::pair<int, std::uint32_t>> sorted;
    for (std::size_t n = 0; n < pixels.size(); ++n)
        if (pixels[n] > 0) sorted.emplace_back(-pixels[n], static_cast<std::uint32_t>(n));
    std::sort(sorted.begin(), sorted.end());
    std::vector<std::uint32_t> numbers;
    numbers.reserve(sorted.size());
    for (const auto& [seen, number] : sorted) numbers.push_back(number);
    return numbers;
}

}  // namespace stereonav
