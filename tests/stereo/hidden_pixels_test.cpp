// The hidden-pixel rule of the inverse warp (Wan et al. 2004, section 2.4: right to left, no depth buffer)
// against a depth buffer in double precision. The surface that the left eye knows is the line through its
// pixels; each of its segments is drawn into the right row, and at every pixel's centre the nearest wins. A
// warped pixel must show that place, and a hole must have a reason. Runs over the oracle and every
// instruction set.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "engine/stereo/paint_row.h"
#include "engine/stereo/row_kernels.h"
#include "tests/oracle/warp_oracle.h"
#include "tests/stereo/row_buffers.h"

namespace stereonav {
namespace {

double unit(std::mt19937& random) {
    return std::uniform_real_distribution<double>(0, 1)(random);
}

struct Kernel {
    std::string name;
    ResampleFunction function;
};

std::vector<Kernel> kernels() {
    std::vector<Kernel> all{{"oracle", resampleRowOracle}};
    for (const SimdTarget target : simdTargets())
        all.push_back({std::string(nameOf(target)), resampler(target)});
    return all;
}

constexpr float kMinStretch = 0.5f, kMaxStretch = 1.4f;
constexpr int kCode = 14;  // levels of a left pixel's colour above its left neighbour's

// The line through the left pixels as the right eye sees it.
class DepthBuffer {
public:
    DepthBuffer(const RowBuffers& row, double shift, double scale) {
        for (int i = 0; i < row.width; ++i) {
            const double near = 1 / static_cast<double>(row.leftDepth.at(i, 0)), moved = scale * near;
            mNearness.push_back(near);
            mColumn.push_back(i + 0.5 + (shift - moved));
            // Each operation of the kernels' column is rounded once to 2^-24 of its result.
            mRounding.push_back(0x1p-24 *
                                (3 * moved + shift + std::abs(shift - moved) + std::abs(mColumn[i])));
        }
    }
    int width() const { return static_cast<int>(mColumn.size()); }
    double column(int i) const { return mColumn[i]; }
    double rounding(int i) const { return mRounding[i]; }

    struct Place {
        int segment;      // from this left pixel to the next
        double x;         // continuous column of the left eye
        double nearness;  // 1 / depth
    };
    // The nearest of what lies at the right column c beyond doubt.
    std::optional<Place> nearestAt(double c) const {
        std::optional<Place> found;
        for (int i = 0; i + 1 < width(); ++i) {
            if (!covers(i, c)) continue;
            const Place place = placeOn(i, c);
            if (!found || place.nearness > found->nearness) found = place;
        }
        return found;
    }
    // Returns whether some segment may lie at c, within rounding and `more`.
    bool maybeAt(int i, double c, double more) const {
        const auto [low, high] = std::minmax(mColumn[i], mColumn[i + 1]);
        const double doubt = mRounding[i] + mRounding[i + 1] + more;
        return low - doubt <= c && c <= high + doubt;
    }
    // Returns whether pixel i is seen by the right eye beyond doubt: no segment may lie in front, and the
    // line does not turn back there, in front of itself.
    bool surelySeen(int i) const {
        const double right = mColumn[i] + mRounding[i];
        if (i + 1 < width() && mColumn[i + 1] - mRounding[i + 1] <= right) return false;
        for (int k = 0; k + 1 < width(); ++k) {
            if (k == i || k + 1 == i || !maybeAt(k, mColumn[i], 2 * mRounding[i])) continue;
            if (std::max(mNearness[k], mNearness[k + 1]) >= mNearness[i]) return false;
        }
        return true;
    }
    // Returns whether the link from pixel i to the next holds beyond doubt.
    bool surelyLinked(int i) const {
        if (i < 0 || i + 1 >= width()) return false;
        const double gap = mColumn[i + 1] - mColumn[i], doubt = mRounding[i] + mRounding[i + 1] + 1e-6;
        return gap >= kMinStretch + doubt && gap <= kMaxStretch - doubt && surelySeen(i) && surelySeen(i + 1);
    }

    // Returns the place on the line through pixels i and i + 1. Nearness is linear in the column; from its
    // smaller end on, no digits are lost.
    Place placeOn(int i, double c) const {
        const double gap = mColumn[i + 1] - mColumn[i], u = (c - mColumn[i]) / gap;
        const int far = mNearness[i] <= mNearness[i + 1] ? i : i + 1, near = far == i ? i + 1 : i;
        const double share = (c - mColumn[far]) / (mColumn[near] - mColumn[far]);
        return {i, i + 0.5 + u, mNearness[far] + share * (mNearness[near] - mNearness[far])};
    }

private:
    bool covers(int i, double c) const {
        const int left = mColumn[i] <= mColumn[i + 1] ? i : i + 1, right = left == i ? i + 1 : i;
        return mColumn[left] + mRounding[left] <= c && c <= mColumn[right] - mRounding[right];
    }
    std::vector<double> mNearness, mColumn, mRounding;
};

struct Count {
    long long warped = 0, decided = 0, holes = 0;
};

// A warped pixel shows, by its colour, a place where the left row lies, nothing is in front of it, and its
// depth.
void checkWarped(const RowBuffers& row, const DepthBuffer& buffer, int p, bool surface, Count& count) {
    const double centre = p + 0.5, shown = (row.color.at(p, 0) & 1023u) / double{kCode} + 0.5;
    const int link = std::clamp(static_cast<int>(shown - 0.5), 0, row.width - 2);
    const int first = std::max(0, link - 1), last = std::min(link + 1, row.width - 2);
    // Colours have whole levels, places on a link the rounding of its ends over its length.
    const auto doubt = [&](int i) {
        return 0.6 / kCode + 2 * (buffer.rounding(i) + buffer.rounding(i + 1)) / kMinStretch + 1e-6;
    };
    bool there = false;
    for (int i = first; i <= last; ++i)
        there = there ||
                (buffer.maybeAt(i, centre, 0) && std::abs(buffer.placeOn(i, centre).x - shown) <= doubt(i));
    ASSERT_TRUE(there) << "left column " << shown << " is not here";
    if (const auto nearest = buffer.nearestAt(centre)) {
        ASSERT_LE(nearest->x, shown + doubt(link))
            << "something nearer, from left pixel " << nearest->segment;
        ++count.decided;
    }
    // The depth is of one of the linked pixels, or between them.
    const float depth = row.depth.at(p, 0);
    bool known = false;
    for (int i = first; i <= last; ++i) {
        const auto [low, high] = std::minmax(row.leftDepth.at(i, 0), row.leftDepth.at(i + 1, 0));
        known = known || (surface ? depth >= low * (1 - 1e-6f) && depth <= high * (1 + 1e-6f) : depth == low);
    }
    ASSERT_TRUE(known) << depth;
}

// A hole has a reason: nothing of the left row lies there, or what is nearest is no link, or one whose
// neighbours do not hold, or it is in doubt.
void checkHole(const RowBuffers& row, const DepthBuffer& buffer, int p, int reach) {
    ASSERT_EQ(row.color.at(p, 0), 0u);
    ASSERT_EQ(row.depth.at(p, 0), 0.0f);
    const double centre = p + 0.5;
    const auto nearest = buffer.nearestAt(centre);
    if (!nearest) return;
    for (int i = 0; i + 1 < row.width; ++i)  // what may be in front of it
        if (i > nearest->segment && buffer.maybeAt(i, centre, 0)) return;
    bool holds = true;
    for (int i = nearest->segment - (reach > 1); i <= nearest->segment + (reach > 0); ++i)
        holds = holds && buffer.surelyLinked(i);
    ASSERT_FALSE(holds) << "links " << nearest->segment << " hold";
}

void checkRow(const Kernel& kernel, RowBuffers row, float shift, float scale, int mode, Count& count) {
    const bool cubic = mode == 2, surface = mode == 1;
    const int reach = cubic ? 2 : mode == 3 ? 0 : 1;
    for (int i = 0; i < row.width; ++i) row.leftColor.at(i, 0) = gray(kCode * i);
    kernel.function(row.resample(shift, scale, cubic, reach, surface, kMinStretch, kMaxStretch));
    const DepthBuffer buffer(row, shift, scale);
    for (int p = 0; p < row.width; ++p) {
        SCOPED_TRACE("pixel " + std::to_string(p) + " of " + std::to_string(row.width) + ", mode " +
                     std::to_string(mode));
        if (row.hole(p)) {
            ++count.holes;
            if (!surface) checkHole(row, buffer, p, reach);  // surface and sky are not linked: another rule
        } else {
            ++count.warped;
            checkWarped(row, buffer, p, surface, count);
        }
        if (testing::Test::HasFatalFailure()) return;
    }
}

using Fill = std::function<void(RowBuffers&, std::mt19937&)>;

// Rows of every kind, widths 1 to 70, each kernel and way to link. `leastWarped`: of all pixels, so that the
// rows show something.
void checkRows(const Fill& fill, double leastWarped) {
    for (const Kernel& kernel : kernels()) {
        SCOPED_TRACE(kernel.name);
        std::mt19937 random(7);
        Count count;
        for (int width = 1; width <= 70; ++width)
            for (int n = 0; n < 12; ++n) {
                RowBuffers row(width);
                fill(row, random);
                const float scale = std::vector<float>{0.5f, 3, 20, 60, 400}[random() % 5];
                checkRow(kernel, row, scale * static_cast<float>(0.04 + 0.2 * unit(random)), scale, n % 4,
                         count);
                if (testing::Test::HasFatalFailure()) return;
            }
        EXPECT_GT(static_cast<double>(count.warped),
                  leastWarped * static_cast<double>(count.warped + count.holes));
        EXPECT_GT(count.decided, count.warped / 2);
        EXPECT_GT(count.holes, 1000);
    }
}

// Runs of pixels with a depth each; next(run's first pixel, the run before): the depth of its i-th pixel.
void fillRuns(RowBuffers& row, std::mt19937& random, int longest,
              const std::function<std::function<float(int)>()>& next) {
    for (int i = 0; i < row.width;) {
        const int end = std::min(row.width, i + 1 + static_cast<int>(random() % longest));
        const auto depthOf = next();
        for (int k = 0; i < end; ++i, ++k) row.leftDepth.at(i, 0) = depthOf(k);
    }
}

TEST(HiddenPixels, layersAreWhatADepthBufferShows) {
    const auto layers = [](RowBuffers& row, std::mt19937& random) {
        fillRuns(row, random, 15, [&] {
            const auto depth = static_cast<float>(2 + 60 * unit(random) * unit(random));
            return [=](int) { return depth; };
        });
    };
    checkRows(layers, 0.3);
}

TEST(HiddenPixels, slantsAreWhatADepthBufferShows) {
    const auto slants = [](RowBuffers& row, std::mt19937& random) {
        fillRuns(row, random, 25, [&] {  // planes: 1 / depth is linear
            const double near = 0.02 + 0.4 * unit(random), slope = 0.02 * (unit(random) - 0.5);
            return [=](int k) { return static_cast<float>(1 / std::max(1e-3, near + slope * k)); };
        });
    };
    checkRows(slants, 0.15);
}

TEST(HiddenPixels, everyPixelADepthOfItsOwnIsWhatADepthBufferShows) {
    const auto noise = [](RowBuffers& row, std::mt19937& random) {
        for (int i = 0; i < row.width; ++i)
            row.leftDepth.at(i, 0) = static_cast<float>(20 * (1 + 0.1 * (unit(random) - 0.5)));
    };
    checkRows(noise, 0.2);
}

TEST(HiddenPixels, equalDepthsAreWhatADepthBufferShows) {
    const auto wall = [](RowBuffers& row, std::mt19937& random) {
        const auto depth = static_cast<float>(2 + 40 * unit(random));
        for (int i = 0; i < row.width; ++i) row.leftDepth.at(i, 0) = depth;
    };
    checkRows(wall, 0.4);
}

// Down to 1e-30 m and up to 1e30, and nothing at all.
TEST(HiddenPixels, tinyHugeAndInfiniteDepthsAreWhatADepthBufferShows) {
    const auto extremes = [](RowBuffers& row, std::mt19937& random) {
        const float depths[] = {1e-30f, 1e-6f, 0.01f, 3, 10, 10.01f, 1e4f, 1e30f, kSky};
        fillRuns(row, random, 12, [&] {
            const float depth = depths[random() % 9];
            return [=](int) { return depth; };
        });
    };
    checkRows(extremes, 0.1);
}

// Regions I and II of Wan et al. 2004, fig. 2: what leaves the right picture at its left, or lies beyond its
// right border, has no part in any pixel of it. So its colours do not matter.
TEST(RegionsIAndII, whatLeavesThePictureIsNotDrawn) {
    std::mt19937 random(9);
    long long outside = 0, shown = 0;
    for (int n = 0; n < 400; ++n) {
        RowBuffers row(1 + n % 70);
        fillRuns(row, random, 15, [&] {
            const auto depth = static_cast<float>(2 + 60 * unit(random) * unit(random));
            return [=](int) { return depth; };
        });
        const float scale = 60, shift = static_cast<float>(20 * unit(random));
        RowBuffers other = row;
        for (int i = 0; i < row.width; ++i) {
            row.leftColor.at(i, 0) = static_cast<std::uint32_t>(random()) & 0x3fffffffu;
            const double column = i + 0.5 + shift - scale / row.leftDepth.at(i, 0);
            // Four taps and splats reach two pixels across the border.
            const bool away = column < -3 || column > row.width + 3;
            outside += away;
            other.leftColor.at(i, 0) = away ? 0x3fffffffu : row.leftColor.at(i, 0);
        }
        std::vector<std::function<void(RowBuffers&)>> warps{
            [&](RowBuffers& b) { splatRow(b.splat(shift, scale)); },
            [&](RowBuffers& b) { paintRow(b.paint(shift, scale)); }};
        for (const Kernel& kernel : kernels())
            for (const bool cubic : {false, true})
                warps.push_back([&shift, &scale, kernel, cubic](RowBuffers& b) {
                    kernel.function(b.resample(shift, scale, cubic, 2, false, kMinStretch, kMaxStretch));
                });
        for (std::size_t w = 0; w < warps.size(); ++w) {
            warps[w](row);
            warps[w](other);
            for (int p = 0; p < row.width; ++p) {
                ASSERT_EQ(row.color.at(p, 0), other.color.at(p, 0)) << "row " << n << " warp " << w;
                shown += !row.hole(p);
            }
        }
    }
    EXPECT_GT(outside, 1000);
    EXPECT_GT(shown, 10000);
}

}  // namespace
}  // namespace stereonav
