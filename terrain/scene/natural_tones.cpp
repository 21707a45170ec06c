#include "terrain/scene/natural_tones.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

namespace stereonav {
namespace {

using glm::vec3;

const vec3 kBroadleaf(0.098f, 0.110f, 0.046f), kConifer(0.060f, 0.080f, 0.043f);
const vec3 kMeadow(0.158f, 0.162f, 0.070f), kShrub(0.128f, 0.124f, 0.072f);
const vec3 kDryGrass(0.240f, 0.205f, 0.118f), kEarth(0.310f, 0.245f, 0.168f);
const vec3 kTundra(0.165f, 0.152f, 0.105f), kScree(0.222f, 0.204f, 0.178f);
const vec3 kGreyRock(0.142f, 0.135f, 0.122f), kWarmRock(0.220f, 0.184f, 0.142f);
const vec3 kSnow(0.76f, 0.79f, 0.84f), kIce(0.62f, 0.68f, 0.75f);
const vec3 kSea(0.030f, 0.075f, 0.110f), kShallow(0.090f, 0.200f, 0.240f), kDeep(0.012f, 0.035f, 0.075f);

constexpr double kLowestLand = -450;  // metres: below the shore of the Dead Sea
constexpr int kBelts = 17;            // nodes from south to north
constexpr float kFineSize = 3.3f;     // samples of the whole

// smoothStep() between two numbers that the compiler knows.
template <int kLow, int kHigh>  // hundredths
float ramp(float x) {
    constexpr float kScale = 100.0f / (kHigh - kLow);
    const float t = std::clamp((x - 0.01f * kLow) * kScale, 0.0f, 1.0f);
    return t * t * (3 - 2 * t);
}

float rangeStep(double low, double high, double x) {
    return smoothStep(static_cast<float>(low), static_cast<float>(high), static_cast<float>(x));
}

}  // namespace

NaturalTones::NaturalTones(const Heightfield& part, const TintPlace& place, const Heightfield& whole)
    : mGround(part),
      mWhole(whole),
      mShape(part, whole, 1 / place.verticalScale),
      mUnscale(1 / place.verticalScale),
      mLow(whole.minHeight() * mUnscale),
      mPlaced(!place.latitudes.empty()),
      mSeaFloor(mPlaced && mLow < kLowestLand),
      mFine(72) {
    const glm::dvec2 spacing = part.spacing();
    // Slopes of coarse samples are those of smoothed ground: of relief with a Hurst exponent of 0.8 they fall
    // with the fifth root of the spacing.
    const double smoothed =
        mPlaced ? std::clamp(std::pow(std::max(spacing.x, spacing.y) / 10, -0.2), 0.3, 1.0) : 0.8;
    mRockFrom = static_cast<float>(0.94 * smoothed);
    mRockFull = static_cast<float>(1.45 * smoothed);
    if (!mPlaced) {
        const double high = whole.maxHeight() * mUnscale, range = std::max(high - mLow, 1.0);
        mBelts.push_back(
            {static_cast<float>(0.85 * range), static_cast<float>(9 * range), 0.12f, 0.5f, 0, 0});
        return;
    }
    const auto& given = place.latitudes;
    for (int k = 0; k < kBelts; ++k) {
        const double x = k * double(given.size() - 1) / (kBelts - 1);
        const auto a = std::min(static_cast<std::size_t>(x), given.size() - 1);
        const double latitude = std::lerp(given[a], given[std::min(a + 1, given.size() - 1)], x - double(a));
        const double degrees = std::abs(latitude) * 180 / std::numbers::pi;
        const GrowthLines lines = growthLines(latitude);
        Belt belt;
        belt.tree = static_cast<float>(lines.tree);
        belt.snow = static_cast<float>(std::max(lines.snow, lines.tree));
        belt.arid = rangeStep(8, 22, degrees) * (1 - rangeStep(30, 44, degrees));
        belt.cold = rangeStep(30, 55, degrees);
        belt.polar = rangeStep(64, 76, degrees);
        belt.poleward = (latitude < 0 ? -1.0f : 1.0f) * rangeStep(5, 25, degrees);
        mBelts.push_back(belt);
    }
}

NaturalTones::Belt NaturalTones::beltAt(double north) const {
    const double place = std::clamp(north, 0.0, 1.0) * double(mBelts.size() - 1);
    const auto node = static_cast<std::size_t>(place);
    const Belt &a = mBelts[node], &b = mBelts[std::min(node + 1, mBelts.size() - 1)];
    const auto t = static_cast<float>(place - double(node));
    const auto between = [&](float Belt::*part) { return a.*part + t * (b.*part - a.*part); };
    return {between(&Belt::tree), between(&Belt::snow),  between(&Belt::arid),
            between(&Belt::cold), between(&Belt::polar), between(&Belt::poleward)};
}

// 0 where nothing grows to 1 in a wood.
float NaturalTones::moistureOf(const Belt& belt, const GroundShape::Site& site, const Spot& spot) {
    const float higher = ramp<15, 60>(spot.up);
    return 0.78f - belt.arid * (0.60f - 0.44f * higher) + (0.15f + 0.12f * belt.arid) * site.wet +
           (0.07f + 0.04f * belt.arid) * site.hollow + (0.18f + 0.36f * belt.arid) * spot.north +
           0.26f * site.broad + 0.16f * spot.fine;
}

// Colour of what grows, without rock and snow.
vec3 NaturalTones::grownOver(const Belt& belt, const GroundShape::Site& site, const Spot& spot) {
    const float moist = moistureOf(belt, site, spot);
    vec3 ground = glm::mix(kEarth, kDryGrass, ramp<0, 28>(moist));
    ground = glm::mix(ground, kShrub, (0.25f + 0.65f * belt.arid) * ramp<22, 44>(moist));
    ground = glm::mix(ground, kMeadow, ramp<34, 68>(moist));
    // Metres on the tree line's scale: it is uneven, higher on sunny slopes, lower where snow slides and
    // lies.
    const float line =
        spot.metres + 170 * site.broad + 110 * spot.fine + 110 * site.hollow + 150 * spot.north;
    const float span = std::max(belt.snow - belt.tree, 300.0f);
    ground = glm::mix(ground, kTundra, 0.9f * smoothStep(belt.tree - 250, belt.tree + 0.25f * span, line));
    ground = glm::mix(ground, kScree, smoothStep(belt.tree + 0.15f * span, belt.tree + 0.8f * span, line));
    float trees = ramp<53, 68>(moist) * (1 - smoothStep(belt.tree - 260, belt.tree + 90, line));
    // Plains are fields and meadows where they are not dry.
    const float plain = (1 - ramp<2, 10>(spot.slope)) * (1 - ramp<30, 70>(spot.up));
    trees *= 1 - 0.6f * plain;
    const vec3 wood = glm::mix(
        kBroadleaf, kConifer,
        std::clamp(std::max(belt.cold, ramp<20, 70>(spot.up)) + 0.6f * site.broad - 0.25f * site.hollow, 0.0f,
                   1.0f));
    return glm::mix(ground, wood * (1 + 0.26f * spot.fine), 0.92f * trees);
}

vec3 NaturalTones::withRock(const vec3& color, const Belt& belt, const GroundShape::Site& site,
                            const Spot& spot) const {
    const float bare = spot.slope * (1 + 0.45f * spot.fine + 0.30f * site.broad - 0.25f * site.hollow);
    // Above the trees rock shows on gentler slopes.
    const float easier = 1 - 0.3f * smoothStep(belt.tree - 200, belt.tree + 300, spot.metres);
    const vec3 rock =
        glm::mix(kGreyRock, kWarmRock, belt.arid) * (1 + 0.16f * spot.fine + 0.08f * site.broad);
    return glm::mix(color, rock, 0.85f * smoothStep(easier * mRockFrom, easier * mRockFull, bare));
}

vec3 NaturalTones::colorAt(const glm::dvec2& grid, double height, const GroundShape::Site& site) const {
    const double metres = (std::isfinite(height) ? height : double(mWhole.minHeight())) * mUnscale;
    if (mSeaFloor && metres < 0)
        return glm::mix(kShallow, kDeep, static_cast<float>(std::sqrt(std::clamp(metres / mLow, 0.0, 1.0))));
    if (mPlaced && metres == 0 && isLevelSea(mGround, grid)) return kSea;
    const glm::dvec2 place = mShape.inWhole(grid);
    const Belt belt = beltAt(place.y / (mWhole.height() - 1));
    Spot spot;
    spot.metres = static_cast<float>(mPlaced ? metres : metres - mLow);
    spot.up = spot.metres / std::max(belt.tree, 200.0f);
    const glm::vec2 gradient = site.gradient * static_cast<float>(mUnscale);
    const float square = gradient.x * gradient.x + gradient.y * gradient.y;
    spot.slope = std::sqrt(square);
    spot.north = -gradient.y / std::sqrt(1 + square) * belt.poleward;
    spot.fine = 1.1f * mFine.fractal(static_cast<float>(place.x) / kFineSize,
                                     static_cast<float>(place.y) / kFineSize, 2);
    vec3 color = withRock(grownOver(belt, site, spot), belt, site, spot);
    color *= 1 + 0.08f * spot.fine + 0.11f * site.broad;
    const float line = belt.snow - 320 * site.hollow + 260 * site.broad + 130 * spot.fine - 380 * spot.north -
                       120 * site.wet;
    const float bare = spot.slope * (1 + 0.3f * spot.fine + 0.2f * site.broad);
    const float snow = smoothStep(line - 60, line + 190, spot.metres) *
                       (1 - smoothStep(1.1f * mRockFull, 1.7f * mRockFull, bare));
    const vec3 white = glm::mix(kSnow, kIce, std::max(0.0f, 0.4f * site.hollow * belt.polar));
    return glm::mix(color, white, mPlaced ? snow : 0.0f);
}

GroundTone NaturalTones::at(const glm::dvec2& grid, double height) const {
    const GroundShape::Site site = mShape.siteAt(grid);
    return {colorAt(grid, height, site), site.normal()};
}

}  // namespace stereonav
