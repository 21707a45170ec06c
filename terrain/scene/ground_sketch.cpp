#include "terrain/scene/ground_sketch.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/parallel.h"

namespace stereonav {
namespace {

constexpr int kMostReads = 8;  // samples a place, each way

// Samples of the ground that a place stands for: from first on, `count` of them `step` apart.
struct PlaceSamples {
    int first, count, step;

    PlaceSamples(int place, int places, int samples) {
        const double across = double(samples - 1) / (places - 1);
        const double middle = place * across;
        const int low = std::clamp(static_cast<int>(std::ceil(middle - 0.5 * across)), 0, samples - 1),
                  high = std::clamp(static_cast<int>(std::floor(middle + 0.5 * across)), low, samples - 1);
        step = 1 + (high - low) / kMostReads;
        first = low;
        count = 1 + (high - low) / step;
    }
};

}  // namespace

GroundSketch::GroundSketch(const Heightfield& ground)
    : mWidth(std::min(ground.width(), kMostSide)),
      mHeight(std::min(ground.height(), kMostSide)),
      mHalf(0.5 * glm::dvec2(ground.width() - 1, ground.height() - 1) * ground.spacing()),
      mStep(2.0 * mHalf / glm::dvec2(mWidth - 1, mHeight - 1)),
      mMeans(static_cast<std::size_t>(mWidth) * mHeight),
      mTops(mMeans.size()),
      mLowest(ground.minHeight()) {
    parallelFor(mHeight, [&](int j) {
        const PlaceSamples rows(j, mHeight, ground.height());
        for (int i = 0; i < mWidth; ++i) {
            const PlaceSamples columns(i, mWidth, ground.width());
            double sum = 0;
            int count = 0;
            float top = -std::numeric_limits<float>::infinity();
            for (int r = 0; r < rows.count; ++r)
                for (int c = 0; c < columns.count; ++c) {
                    const float height =
                        ground.sample(columns.first + c * columns.step, rows.first + r * rows.step);
                    if (!std::isfinite(height)) continue;
                    sum += height;
                    ++count;
                    top = std::max(top, height);
                }
            const std::size_t k = static_cast<std::size_t>(j) * mWidth + i;
            mMeans[k] = count > 0 ? static_cast<float>(sum / count) : std::nanf("");
            mTops[k] = count > 0 ? top : std::nanf("");
        }
    });
    std::vector<float> known;
    mHighest = -std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < mMeans.size(); ++k) {
        if (!std::isfinite(mMeans[k])) continue;
        known.push_back(mMeans[k]);
        if (mMeans[k] <= mHighest) continue;
        mHighest = mMeans[k];
        mSummit = glm::dvec2(k % mWidth, k / mWidth) * mStep - mHalf;
    }
    if (known.empty()) {  // all that is known lies between the samples that were looked at
        mUsual = mHighest = ground.minHeight();
        return;
    }
    std::nth_element(known.begin(), known.begin() + known.size() / 2, known.end());
    mUsual = known[known.size() / 2];
}

GroundSketch::At GroundSketch::at(const glm::dvec2& world) const {
    const glm::dvec2 g = (world + mHalf) / mStep;
    if (!(g.x >= 0 && g.y >= 0 && g.x <= mWidth - 1 && g.y <= mHeight - 1)) return {std::nan(""), {}};
    const int i = std::min(static_cast<int>(g.x), mWidth - 2),
              j = std::min(static_cast<int>(g.y), mHeight - 2);
    const double u = g.x - i, v = g.y - j;
    const float* south = &mMeans[static_cast<std::size_t>(j) * mWidth + i];
    const float* north = south + mWidth;
    const double a = south[0], b = south[1], c = north[0], d = north[1];
    return {(1 - v) * ((1 - u) * a + u * b) + v * ((1 - u) * c + u * d),
            {((1 - v) * (b - a) + v * (d - c)) / mStep.x, ((1 - u) * (c - a) + u * (d - b)) / mStep.y}};
}

double GroundSketch::highestAround(const glm::dvec2& world, double distance) const {
    const auto inside = [](double place, int places) {
        return static_cast<int>(std::clamp(place, 0.0, places - 1.0));
    };
    const glm::dvec2 low = (world - distance + mHalf) / mStep, high = (world + distance + mHalf) / mStep;
    double highest = mLowest;
    for (int j = inside(std::floor(low.y), mHeight); j <= inside(std::ceil(high.y), mHeight); ++j)
        for (int i = inside(std::floor(low.x), mWidth); i <= inside(std::ceil(high.x), mWidth); ++i) {
            const float top = mTops[static_cast<std::size_t>(j) * mWidth + i];
            if (std::isfinite(top)) highest = std::max(highest, double(top));
        }
    return highest;
}

}  // namespace stereonav
