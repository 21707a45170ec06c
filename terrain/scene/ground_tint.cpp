#include "terrain/scene/ground_tint.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <span>

#include "engine/base/parallel.h"
#include "engine/image/packed_color.h"

namespace stereonav {
namespace {

using glm::vec3;

// Patterson and Jenny's scales: sRGB bytes at metres.
struct Stop {
    float metres;
    int red, green, blue;
};
constexpr std::array<Stop, 8> kHighlands{{{1000, 212, 201, 180},
                                          {2000, 212, 184, 163},
                                          {3000, 212, 193, 179},
                                          {4000, 212, 207, 204},
                                          {5000, 220, 220, 220},
                                          {6000, 235, 235, 237},
                                          {7000, 245, 245, 245},
                                          {9000, 245, 245, 245}}};
constexpr std::array<Stop, 5> kArid{{{-400, 146, 136, 129},
                                     {0, 160, 152, 141},
                                     {50, 170, 160, 150},
                                     {200, 180, 170, 158},
                                     {600, 202, 190, 174}}};
constexpr std::array<Stop, 5> kWarm{{{-400, 106, 153, 135},
                                     {0, 114, 164, 141},
                                     {50, 120, 172, 149},
                                     {200, 134, 184, 159},
                                     {600, 169, 192, 166}}};
constexpr std::array<Stop, 5> kCold{{{-400, 112, 147, 141},
                                     {0, 120, 159, 152},
                                     {50, 130, 165, 159},
                                     {200, 145, 177, 171},
                                     {600, 180, 192, 180}}};
constexpr std::array<Stop, 8> kPolar{{{0, 149, 169, 196},
                                      {50, 164, 180, 203},
                                      {200, 171, 192, 213},
                                      {600, 185, 201, 224},
                                      {1000, 201, 214, 231},
                                      {2000, 218, 226, 239},
                                      {3000, 239, 243, 252},
                                      {4000, 241, 245, 254}}};
constexpr double kGrassEnds = 2000, kGreyEnds = 5000;  // metres on the scales: tree line, snow line

const vec3 kOnGround(0.40f, 0.395f, 0.345f);  // from paper to ground, which is darker and warmer
constexpr float kSaturation = 1.25f;
const vec3 kRock(0.180f, 0.162f, 0.141f), kSnow(0.76f, 0.79f, 0.84f), kSea(0.030f, 0.075f, 0.110f);
const vec3 kShallow(0.090f, 0.200f, 0.240f), kDeep(0.012f, 0.035f, 0.075f);

// The lowest dry land lies at -430 m, by the Dead Sea: what goes deeper is a sea floor.
constexpr double kLowestLand = -450;

constexpr double kReach = 6;        // samples around that tell hollows from ridges
constexpr int kZones = 17;          // nodes from south to north
constexpr double kMostSpan = 1500;  // metres on the scales that stretching may lead up to

vec3 linearOf(const Stop& s) {
    return vec3(linearFromSrgb(s.red / 255.0f), linearFromSrgb(s.green / 255.0f),
                linearFromSrgb(s.blue / 255.0f));
}

// A scale that is asked at any height: linear light between its stops.
class Scale {
public:
    explicit Scale(std::span<const Stop> lower, std::span<const Stop> upper = {}) {
        for (const auto part : {lower, upper})
            for (const Stop& s : part) {
                mMetres.push_back(s.metres);
                mColors.push_back(linearOf(s));
            }
    }
    vec3 at(float metres) const {
        if (!(metres > mMetres.front())) return mColors.front();
        const auto next = std::upper_bound(mMetres.begin(), mMetres.end(), metres);
        if (next == mMetres.end()) return mColors.back();
        const auto k = static_cast<std::size_t>(next - mMetres.begin());
        return glm::mix(mColors[k - 1], mColors[k],
                        (metres - mMetres[k - 1]) / (mMetres[k] - mMetres[k - 1]));
    }

private:
    std::vector<float> mMetres;
    std::vector<vec3> mColors;
};

struct Scales {
    Scale arid{kArid, kHighlands}, warm{kWarm, kHighlands}, cold{kCold, kHighlands}, polar{kPolar};
};

vec3 onGround(const vec3& paper) {
    vec3 color = paper * kOnGround;
    color.z -= 0.45f * std::max(0.0f, color.y - color.x);  // printed greens are bluer than grass
    const float gray = 0.2126f * color.x + 0.7152f * color.y + 0.0722f * color.z;
    return glm::max(vec3(gray) + kSaturation * (color - gray), vec3(0.004f));
}

// Colours of a scale height, every kTableStep metres: all stops lie on them.
constexpr float kTableLow = -400, kTableStep = 50;
constexpr int kTableSize = 189;  // to 9,000 m

std::vector<vec3> tableOf(float arid, float cold, float polar) {
    static const Scales s;
    std::vector<vec3> table(kTableSize);
    for (int k = 0; k < kTableSize; ++k) {
        const float metres = kTableLow + kTableStep * static_cast<float>(k);
        const vec3 humid = (1 - cold - polar) * s.warm.at(metres) + cold * s.cold.at(metres);
        table[k] = onGround(glm::mix(humid, s.arid.at(metres), arid) + polar * s.polar.at(metres));
    }
    return table;
}

vec3 fromTable(const std::vector<vec3>& table, float metres) {
    const float x = std::clamp((metres - kTableLow) / kTableStep, 0.0f, float(kTableSize - 1));
    const int k = std::min(static_cast<int>(x), kTableSize - 2);
    return glm::mix(table[k], table[k + 1], x - static_cast<float>(k));
}

double rangeStep(double low, double high, double x) {
    const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

// How far a sample lies below those around it, at `reach` samples: -1 on ridges to 1 in hollows.
float hollowOf(const Heightfield& ground, int reach, int i, int j) {
    constexpr int kX[8] = {1, 1, 0, -1, -1, -1, 0, 1}, kY[8] = {0, 1, 1, 1, 0, -1, -1, -1};
    const int across = (7 * reach + 9) / 10;  // the same distance on the diagonals
    double sum = 0;
    int known = 0;
    for (int k = 0; k < 8; ++k) {
        const int step = kX[k] * kY[k] != 0 ? across : reach;
        const float h = ground.sample(std::clamp(i + step * kX[k], 0, ground.width() - 1),
                                      std::clamp(j + step * kY[k], 0, ground.height() - 1));
        if (!std::isfinite(h)) continue;
        sum += h;
        ++known;
    }
    const float here = ground.sample(i, j);
    if (known == 0 || !std::isfinite(here)) return 0;
    const double side = reach * std::sqrt(ground.spacing().x * ground.spacing().y);
    const double below = 4 * (sum / known - here) / side;
    return static_cast<float>(below / std::sqrt(1 + below * below));
}

}  // namespace

GrowthLines growthLines(double latitude) {
    constexpr std::array<double, 10> kTree{3900, 3900, 4000, 3900, 3100, 2200, 1000, 200, 0, 0};
    constexpr std::array<double, 10> kSnowLine{4900, 5100, 5600, 5300, 4200, 2900, 1700, 900, 300, 0};
    const double x = std::clamp(std::abs(latitude) * 18 / std::numbers::pi, 0.0, 9.0);
    const int k = std::min(static_cast<int>(x), 8);
    const auto at = [&](const std::array<double, 10>& table) {
        return std::lerp(table[k], table[k + 1], x - k);
    };
    return {at(kTree), at(kSnowLine)};
}

bool isLevelSea(const Heightfield& ground, const glm::dvec2& grid) {
    const int i = static_cast<int>(std::floor(grid.x)), j = static_cast<int>(std::floor(grid.y));
    for (int dj = -1; dj <= 2; ++dj)
        for (int di = -1; di <= 2; ++di)
            if (ground.sample(std::clamp(i + di, 0, ground.width() - 1),
                              std::clamp(j + dj, 0, ground.height() - 1)) != 0)
                return false;
    return true;
}

GroundTint::GroundTint(const Heightfield& ground, const TintPlace& place, const Heightfield& whole)
    : mGround(ground), mWhole(whole), mUnscale(1 / place.verticalScale), mFine(72) {
    const glm::dvec2 spacing = ground.spacing();
    if (&ground != &whole) {
        mFirst = whole.gridFromWorld(ground.originWorld());
        mStep = spacing / whole.spacing();
    }
    mMetresPerStep = std::max(spacing.x, spacing.y);
    const int reach = std::clamp(std::min(ground.width(), ground.height()) / 4, 1, int(kReach));
    mSites.resize(static_cast<std::size_t>(ground.width()) * ground.height());
    const Noise broad(71);
    parallelFor(ground.height(), [&](int j) {
        for (int i = 0; i < ground.width(); ++i) {
            const glm::vec2 at(inWhole({i, j}));
            mSites[static_cast<std::size_t>(j) * ground.width() + i] = {
                glm::vec2(ground.gradientAtSample(i, j)), hollowOf(ground, reach, i, j),
                broad.fractal(at.x / 23, at.y / 23, 4)};
        }
    });
    const double low = whole.minHeight() * mUnscale, high = whole.maxHeight() * mUnscale;
    mLow = low;
    mPerMetre = high > low ? 1 / (high - low) : 0;
    mPlaced = !place.latitudes.empty();
    mSeaFloor = mPlaced && low < kLowestLand;
    // Slopes of coarse samples are those of smoothed ground: of relief with a Hurst exponent of 0.8 they fall
    // with the fifth root of the spacing.
    const double smoothed = mPlaced ? std::clamp(std::pow(mMetresPerStep / 10, -0.2), 0.3, 1.0) : 0.8;
    mRockFrom = static_cast<float>(std::tan(0.60) * smoothed);
    mRockFull = static_cast<float>(std::tan(0.92) * smoothed);
    if (mPlaced) {
        const auto& given = place.latitudes;
        for (int k = 0; k < kZones; ++k) {
            const double x = k * double(given.size() - 1) / (kZones - 1);
            const auto a = std::min(static_cast<std::size_t>(x), given.size() - 1);
            const double latitude =
                std::lerp(given[a], given[std::min(a + 1, given.size() - 1)], x - double(a));
            const double degrees = std::abs(latitude) * 180 / std::numbers::pi;
            Zone zone;
            zone.lines = growthLines(latitude);
            const auto polar = static_cast<float>(rangeStep(64, 76, degrees));
            const float cold = static_cast<float>(rangeStep(30, 50, degrees)) * (1 - polar);
            const auto arid =
                static_cast<float>(rangeStep(8, 22, degrees) * (1 - rangeStep(30, 44, degrees)));
            zone.colors = tableOf(arid, cold, polar);
            zone.poleward = (latitude < 0 ? -1 : 1) * rangeStep(5, 25, degrees);
            mZones.push_back(std::move(zone));
        }
    } else {
        mZones.push_back({{}, 0, tableOf(0, 0.4f, 0)});
    }
    // Ground that spans little of the scale shows more of it, as far as its relief is one and no noise.
    const double side = std::min(whole.width() * whole.spacing().x, whole.height() * whole.spacing().y);
    const double relief = rangeStep(0, 0.03, (high - low) / side);
    const GrowthLines middle = mZones[mZones.size() / 2].lines;
    const double from = scaleHeight(middle, low), to = scaleHeight(middle, high);
    const double wanted = (mPlaced ? 700 : 1600) * relief;
    if (to > from && (!mPlaced || to - from < wanted)) {
        mStretch = mPlaced ? wanted / (to - from) : relief;
        mMiddle = 0.5 * (from + to);
        const double above = mMiddle + 0.5 * mStretch * (to - from),
                     below = mMiddle - 0.5 * mStretch * (to - from);
        if (above > std::max(to, kMostSpan)) mShift = std::max(to, kMostSpan) - above;
        if (below + mShift < std::min(from, 0.0)) mShift = std::min(from, 0.0) - below;
    }
}

// Returns where on the scales a height above the sea lies.
double GroundTint::scaleHeight(const GrowthLines& lines, double metres) const {
    if (!mPlaced) return 1800 * (metres - mLow) * mPerMetre;
    if (!(metres > 0)) return metres;
    const double tree = std::max(lines.tree, 200.0), snow = std::max(lines.snow, tree + 300);
    if (metres < tree) {
        // The green part, up to 600 m of the scale, is the lower third.
        const double third = tree / 3;
        return metres < third ? metres * 600 / third
                              : 600 + (metres - third) / (tree - third) * (kGrassEnds - 600);
    }
    if (metres < snow) return kGrassEnds + (metres - tree) / (snow - tree) * (kGreyEnds - kGrassEnds);
    return kGreyEnds + (metres - snow);
}

glm::dvec3 GroundTint::Site::normal() const {
    return glm::normalize(glm::dvec3(-glm::dvec2(gradient), 1.0));
}

GroundTint::Site GroundTint::siteAt(const glm::dvec2& grid) const {
    const double x = std::clamp(grid.x, 0.0, mGround.width() - 1.0),
                 y = std::clamp(grid.y, 0.0, mGround.height() - 1.0);
    const int i = std::min(static_cast<int>(x), mGround.width() - 2);
    const int j = std::min(static_cast<int>(y), mGround.height() - 2);
    const float u = static_cast<float>(x - i), v = static_cast<float>(y - j);
    const Site* south = mSites.data() + static_cast<std::size_t>(j) * mGround.width() + i;
    const Site* north = south + mGround.width();
    const auto between = [&](auto Site::*part) {
        return glm::mix(glm::mix(south[0].*part, south[1].*part, u),
                        glm::mix(north[0].*part, north[1].*part, u), v);
    };
    return {between(&Site::gradient), between(&Site::hollow), between(&Site::broad)};
}

glm::vec3 GroundTint::at(const glm::dvec2& grid, double height, const Site& site) const {
    const double metres = (std::isfinite(height) ? height : double(mWhole.minHeight())) * mUnscale;
    if (mSeaFloor && metres < 0) {
        const auto deep = static_cast<float>(std::sqrt(std::clamp(metres / mLow, 0.0, 1.0)));
        return glm::mix(kShallow, kDeep, deep);
    }
    if (mPlaced && metres == 0 && isLevelSea(mGround, grid)) return kSea;
    const glm::dvec2 place = inWhole(grid);
    const double north = std::clamp(place.y / (mWhole.height() - 1), 0.0, 1.0) * double(mZones.size() - 1);
    const auto node = static_cast<std::size_t>(north);
    const Zone &a = mZones[node], &b = mZones[std::min(node + 1, mZones.size() - 1)];
    const double t = north - double(node);
    const GrowthLines lines{std::lerp(a.lines.tree, b.lines.tree, t),
                            std::lerp(a.lines.snow, b.lines.snow, t)};
    const float hollow = site.hollow, broad = site.broad;
    const float fine =
        0.7f * mFine.at(static_cast<float>(place.x) / 2.9f, static_cast<float>(place.y) / 2.9f);
    const double on = mMiddle + (scaleHeight(lines, metres) - mMiddle) * mStretch + mShift;
    // A share of how high it is on the scale, so that lowlands do not leave their colours.
    const double some = std::clamp(0.25 * on, 30.0, 400.0);
    const auto shown = static_cast<float>(on - some * (0.9 * hollow - 0.8 * broad));
    vec3 color = glm::mix(fromTable(a.colors, shown), fromTable(b.colors, shown), static_cast<float>(t));
    color *= 1 + 0.12f * fine + 0.11f * broad;
    const auto slope = static_cast<float>(glm::length(site.gradient) * mUnscale);
    const float bare = slope * (1 + 0.35f * fine + 0.25f * broad - 0.2f * hollow);
    color = glm::mix(color, kRock * (1 + 0.25f * fine), 0.8f * smoothStep(mRockFrom, mRockFull, bare));
    if (mPlaced) {
        const double down = -site.gradient.y / std::sqrt(1 + glm::dot(site.gradient, site.gradient));
        const double line = lines.snow - 250 * hollow + 300 * broad + 80 * fine -
                            300 * down * std::lerp(a.poleward, b.poleward, t);
        const float snow = smoothStep(static_cast<float>(line - 80), static_cast<float>(line + 160),
                                      static_cast<float>(metres)) *
                           (1 - smoothStep(1.1f * mRockFull, 1.6f * mRockFull, bare));
        color = glm::mix(color, kSnow, snow);
    }
    return color;
}

}  // namespace stereonav
