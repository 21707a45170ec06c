#include "terrain/scene/ground_shape.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "engine/base/parallel.h"
#include "engine/image/plane.h"
#include "terrain/built_in/noise.h"

namespace stereonav {
namespace {

constexpr double kNear = 6, kFar = 28;  // samples of the whole in a block of each scale
constexpr int kBroadOctaves = 4;
constexpr float kBroadSize = 23;  // samples of the whole

// Means of a run of samples, and a place among them.
struct BlockRow {
    int count;         // blocks
    double perSample;  // blocks a sample
    BlockRow(int samples, double block)
        : count(std::max(1, static_cast<int>(std::lround(samples / block)))),
          perSample(double(count) / samples) {}
    int first(int k) const { return static_cast<int>(std::lround(k / perSample)); }
};

// Heights averaged over blocks, and between these a quadratic B-spline: what is left of ground that a valley
// or a ridge is measured against.
class SmoothedHeights {
public:
    SmoothedHeights(const Heightfield& ground, const glm::dvec2& block)
        : mAcross(ground.width(), block.x),
          mUp(ground.height(), block.y),
          mMeans(mAcross.count + 2, mUp.count + 2) {
        parallelFor(mUp.count, [&](int b) {
            for (int a = 0; a < mAcross.count; ++a) mMeans.at(a + 1, b + 1) = meanOf(ground, a, b);
        });
        extend();
    }

    // A row of samples.
    class Row {
    public:
        Row(const SmoothedHeights& all, int j) : mAcross(all.mAcross), mLine(all.mMeans.width()) {
            int b = 0;
            float w[3];
            weights((j + 0.5) * all.mUp.perSample, all.mUp.count, b, w);
            for (int a = 0; a < all.mMeans.width(); ++a) {
                const auto mean = [&](int y) { return all.mMeans.at(a, b + y); };
                mLine[a] = weighted(w, mean(0), mean(1), mean(2));
            }
        }
        // Height at a sample; NaN where nothing is known around.
        float at(int i) const {
            int a = 0;
            float w[3];
            weights((i + 0.5) * mAcross.perSample, mAcross.count, a, w);
            return weighted(w, mLine[a], mLine[a + 1], mLine[a + 2]);
        }

    private:
        const BlockRow& mAcross;
        std::vector<float> mLine;  // means between which the row's samples lie
    };

private:
    // place: in blocks. first: the lowest of the three that count, in mMeans.
    static void weights(double place, int count, int& first, float* w) {
        const int block = std::clamp(static_cast<int>(place), 0, count - 1);
        const auto t = static_cast<float>(std::clamp(place - block, 0.0, 1.0));
        first = block;
        w[0] = 0.5f * (1 - t) * (1 - t);
        w[2] = 0.5f * t * t;
        w[1] = 1 - w[0] - w[2];
    }

    // The mean of three with weights that add up to 1, or of those that are known.
    static float weighted(const float* w, float a, float b, float c) {
        const float all = w[0] * a + w[1] * b + w[2] * c;
        if (std::isfinite(all)) return all;
        float sum = 0, known = 0;
        const float values[3] = {a, b, c};
        for (int k = 0; k < 3; ++k)
            if (std::isfinite(values[k])) {
                sum += w[k] * values[k];
                known += w[k];
            }
        return known > 0 ? sum / known : std::numeric_limits<float>::quiet_NaN();
    }

    float meanOf(const Heightfield& ground, int a, int b) const {
        double sum = 0;
        int known = 0;
        for (int j = mUp.first(b); j < mUp.first(b + 1); ++j)
            for (int i = mAcross.first(a); i < mAcross.first(a + 1); ++i)
                if (const float h = ground.sample(i, j); std::isfinite(h)) {
                    sum += h;
                    ++known;
                }
        return known ? static_cast<float>(sum / known) : std::numeric_limits<float>::quiet_NaN();
    }

    // Lets the border go on as it slopes, so that a plain slope has neither hollow nor ridge there.
    void extend() {
        const int w = mAcross.count, h = mUp.count;
        const auto beyond = [](float edge, float inner) {
            return std::isfinite(inner) ? 2 * edge - inner : edge;
        };
        for (int b = 1; b <= h; ++b) {
            mMeans.at(0, b) = beyond(mMeans.at(1, b), mMeans.at(std::min(2, w), b));
            mMeans.at(w + 1, b) = beyond(mMeans.at(w, b), mMeans.at(std::max(1, w - 1), b));
        }
        for (int a = 0; a < w + 2; ++a) {
            mMeans.at(a, 0) = beyond(mMeans.at(a, 1), mMeans.at(a, std::min(2, h)));
            mMeans.at(a, h + 1) = beyond(mMeans.at(a, h), mMeans.at(a, std::max(1, h - 1)));
        }
    }

    BlockRow mAcross, mUp;
    Plane<float> mMeans;  // with a border of one block
};

// From metres below what is around, as a share of the block's side, to -1 to 1; 0 where it is not known.
float squashed(double below) {
    if (!std::isfinite(below)) return 0;
    return static_cast<float>(below / std::sqrt(1 + below * below));
}

}  // namespace

GroundShape::GroundShape(const Heightfield& part, const Heightfield& whole, double unscale) : mGround(part) {
    const glm::dvec2 spacing = part.spacing();
    if (&part != &whole) {
        mFirst = whole.gridFromWorld(part.originWorld());
        mStep = spacing / whole.spacing();
    }
    const glm::dvec2 least(2.0), most(part.width(), part.height());
    const SmoothedHeights near(part, glm::clamp(kNear / mStep, least, glm::max(most, least))),
        far(part, glm::clamp(kFar / mStep, least, glm::max(most, least)));
    const double side = std::sqrt(whole.spacing().x * whole.spacing().y);
    const Noise broad(71);
    mSites.resize(static_cast<std::size_t>(part.width()) * part.height());
    parallelFor(part.height(), [&](int j) {
        const SmoothedHeights::Row nearHere(near, j), farHere(far, j);
        for (int i = 0; i < part.width(); ++i) {
            const auto kept = [](float share) {
                return static_cast<std::int16_t>(std::lround(std::clamp(share, -1.0f, 1.0f) * kWhole));
            };
            KeptSite& site = mSites[static_cast<std::size_t>(j) * part.width() + i];
            const double here = part.sample(i, j);
            const glm::dvec2 gradient = part.gradientAtSample(i, j);
            site.gradient = glm::vec2(gradient);
            const float hollow = squashed(8 * unscale * (nearHere.at(i) - here) / (kNear * side));
            const float valley = squashed(6 * unscale * (farHere.at(i) - here) / (kFar * side));
            const auto slope = static_cast<float>(unscale * glm::length(gradient));
            const float steep = std::isfinite(slope) ? slope / (slope + 0.25f) : 0.0f;
            site.hollow = kept(hollow);
            site.wet = kept(0.4f + 0.35f * hollow + 0.45f * valley - 0.8f * steep);
            const glm::vec2 at(inWhole({i, j}));
            site.broad = kept(broad.fractal(at.x / kBroadSize, at.y / kBroadSize, kBroadOctaves));
        }
    });
}

glm::dvec3 GroundShape::Site::normal() const {
    return glm::normalize(glm::dvec3(-glm::dvec2(gradient), 1.0));
}

GroundShape::Site GroundShape::siteAt(const glm::dvec2& grid) const {
    const double x = std::clamp(grid.x, 0.0, mGround.width() - 1.0),
                 y = std::clamp(grid.y, 0.0, mGround.height() - 1.0);
    const int i = std::min(static_cast<int>(x), mGround.width() - 2);
    const int j = std::min(static_cast<int>(y), mGround.height() - 2);
    const float u = static_cast<float>(x - i), v = static_cast<float>(y - j);
    const KeptSite* south = mSites.data() + static_cast<std::size_t>(j) * mGround.width() + i;
    const KeptSite* north = south + mGround.width();
    const auto between = [&](const auto& partOf) {
        return glm::mix(glm::mix(partOf(south[0]), partOf(south[1]), u),
                        glm::mix(partOf(north[0]), partOf(north[1]), u), v);
    };
    const auto share = [&](std::int16_t KeptSite::*part) {
        return between([&](const KeptSite& site) { return static_cast<float>(site.*part) / kWhole; });
    };
    return {between([](const KeptSite& site) { return site.gradient; }), share(&KeptSite::hollow),
            share(&KeptSite::wet), share(&KeptSite::broad)};
}

}  // namespace stereonav
