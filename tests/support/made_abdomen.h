// A CT of an abdomen around the generated colon: lungs cut at some height, a stomach, gas in small bowel, hip
// prostheses with their streaks; segments of the colon that collapsed or are full of fluid, and stool. The
// colon's lumen in it is known.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <random>
#include <vector>

#include "colon/built_in/built_in_colon.h"
#include "engine/volume/volume.h"
#include "tests/support/made_ct.h"

namespace stereonav::test {

struct AbdomenSetting {
    std::uint64_t seed = 1;
    glm::ivec3 size{224, 224, 180};
    double lungs = 0.04;        // height of the lungs in the scan in metres; 0: none
    double lungDensity = -850;  // mean in HU; emphysema is about -925
    bool stomach = true;
    bool prostheses = false;
    int smallBowel = 4;  // pieces of gas
    int collapsed = 1;   // collapsed segments of the colon
    int drowned = 1;     // segments full of fluid, every second one without a contrast agent
    int stool = 4;       // balls on the wall
};

struct Abdomen {
    GreyVolume scan;
    // 1: gas or tagged fluid of the colon; 2: lung; 3: stomach; 4: small bowel; 0: all else.
    MaskVolume truth;
};

constexpr std::uint8_t kTrueColon = 1, kTrueLung = 2, kTrueStomach = 3, kTrueSmallBowel = 4;

// Random numbers that are the same with every standard library.
class AbdomenChances {
public:
    explicit AbdomenChances(std::uint64_t seed)
        : mRandom(static_cast<std::uint32_t>(seed * 2654435761u + 7)) {}
    double between(double low, double high) { return low + (high - low) * mRandom() / 4294967295.0; }
    int below(int count) { return static_cast<int>(mRandom() % static_cast<std::uint32_t>(count)); }
    glm::dvec3 direction() {
        for (;;) {
            const glm::dvec3 d(between(-1, 1), between(-1, 1), between(-1, 1));
            if (const double l = glm::length(d); l > 0.1 && l < 1) return d / l;
        }
    }

private:
    std::mt19937 mRandom;
};

class AbdomenMaker {
public:
    explicit AbdomenMaker(const AbdomenSetting& setting) : mSetting(setting), mChance(setting.seed) {
        Progress progress;
        BuiltInColonSetting colon;
        colon.seed = setting.seed;
        colon.size = setting.size;
        BuiltInColon made = builtInColon(colon, progress);
        mAxis = std::move(made.axis.points);
        mMade.scan = std::move(made.grey);
        mMade.truth = MaskVolume(mMade.scan.frame);
        mAlong = Volume<std::uint16_t>(mMade.scan.frame);
        mAway = Volume<float>(mMade.scan.frame);
        mGap = Volume<float>(mMade.scan.frame);
        findColon();
        measureGap();
    }

    Abdomen make() {
        for (int n = 0; n < mSetting.collapsed; ++n) changeSegment(kTissue);
        for (int n = 0; n < mSetting.drowned; ++n) changeSegment(n % 2 ? 20 : 400);
        for (int n = 0; n < mSetting.stool; ++n) addStool();
        if (mSetting.lungs > 0) addLungs();
        if (mSetting.stomach) addStomach();
        for (int n = 0; n < mSetting.smallBowel; ++n) addSmallBowel();
        if (mSetting.prostheses) addProstheses();
        return std::move(mMade);
    }

private:
    static constexpr double kFarFromColon = 1, kWidestGap = 0.009;  // metres
    static constexpr double kTissue = 40, kGas = -1000;             // HU

    // Finds for each voxel near the axis its nearest point, and its distance beyond the tube's radius there.
    void findColon() {
        const VolumeFrame& frame = mMade.scan.frame;
        std::fill_n(mAway.values.data(), frame.count(), static_cast<float>(kFarFromColon));
        for (std::size_t n = 0; n < mAxis.size(); ++n)
            forBall(mAxis[n].position, mAxis[n].radius + 0.012, [&](const glm::ivec3& v, double distance) {
                const auto away = static_cast<float>(distance - mAxis[n].radius);
                if (away >= mAway.at(v)) return;
                mAway.at(v) = away;
                mAlong.at(v) = static_cast<std::uint16_t>(n);
            });
        for (std::size_t n = 0; n < frame.count(); ++n) {
            const int hu = mMade.scan.values[n];
            mMade.truth.values[n] = mAway.values[n] < 0.012 && (hu < -480 || hu > 220) ? kTrueColon : 0;
        }
    }

    // Measures the distance to the colon in metres.
    void measureGap() {
        const VolumeFrame& frame = mMade.scan.frame;
        std::fill_n(mGap.values.data(), frame.count(), static_cast<float>(kFarFromColon));
        for (int k = 1; k < frame.size.z - 1; ++k)
            for (int j = 1; j < frame.size.y - 1; ++j)
                for (int i = 1; i < frame.size.x - 1; ++i) {
                    if (mMade.truth.at(i, j, k) == kTrueColon) mGap.at(i, j, k) = 0;
                    if (!onBorder({i, j, k})) continue;
                    forBall(frame.worldFromVoxel(glm::dvec3(i, j, k)), kWidestGap,
                            [&](const glm::ivec3& v, double distance) {
                                mGap.at(v) = std::min(mGap.at(v), static_cast<float>(distance));
                            });
                }
    }

    bool onBorder(const glm::ivec3& v) const {
        if (mMade.truth.at(v) != kTrueColon) return false;
        for (int axis = 0; axis < 3; ++axis)
            for (const int step : {-1, 1}) {
                glm::ivec3 to = v;
                to[axis] += step;
                if (mMade.truth.at(to) != kTrueColon) return true;
            }
        return false;
    }

    template <typename Use>
    void forBall(const glm::dvec3& middle, double radius, const Use& use) {
        const VolumeFrame& frame = mMade.scan.frame;
        const glm::dvec3 centre = frame.voxelFromWorld(middle), reach = radius / frame.spacing;
        const glm::ivec3 first = glm::max(glm::ivec3(glm::ceil(centre - reach)), 0);
        const glm::ivec3 last = glm::min(glm::ivec3(glm::floor(centre + reach)), frame.size - 1);
        for (int k = first.z; k <= last.z; ++k)
            for (int j = first.y; j <= last.y; ++j)
                for (int i = first.x; i <= last.x; ++i) {
                    const glm::ivec3 v(i, j, k);
                    const double distance = glm::length(frame.worldFromVoxel(glm::dvec3(v)) - middle);
                    if (distance <= radius) use(v, distance);
                }
    }

    void put(const glm::ivec3& v, double hu, std::uint8_t truth) {
        const std::size_t n = mMade.scan.frame.index(v.x, v.y, v.z);
        mMade.scan.values[n] = static_cast<std::int16_t>(std::lround(hu + 15 * noiseAt(n)));
        mMade.truth.values[n] = truth;
    }

    bool inTissue(const glm::ivec3& v, double fromColon) const {
        return mGap.at(v) > fromColon && mMade.truth.at(v) == 0 && mMade.scan.at(v) > -150;
    }

    // Fills a piece of the colon.
    void changeSegment(double hu) {
        const int length = 20 + mChance.below(60), count = static_cast<int>(mAxis.size());
        const int from = 60 + mChance.below(std::max(1, count - length - 120));
        for (std::size_t n = 0; n < mMade.truth.values.size(); ++n)
            if (mMade.truth.values[n] == kTrueColon && mAlong.values[n] >= from &&
                mAlong.values[n] < from + length) {
                const glm::ivec3 size = mMade.scan.frame.size;
                const auto at = static_cast<int>(n);
                put({at % size.x, at / size.x % size.y, at / size.x / size.y}, hu, hu > 200 ? kTrueColon : 0);
            }
    }

    void addStool() {
        const auto& point = mAxis[static_cast<std::size_t>(mChance.below(static_cast<int>(mAxis.size())))];
        const glm::dvec3 middle = point.position + mChance.direction() * point.radius * 0.9;
        const double tagging = mChance.between(60, 350);
        forBall(middle, mChance.between(0.003, 0.008), [&](const glm::ivec3& v, double) {
            if (mMade.truth.at(v) == kTrueColon) put(v, tagging, 0);
        });
    }

    // Adds lungs from the diaphragm's two domes upwards, with vessels.
    void addLungs() {
        const VolumeFrame& frame = mMade.scan.frame;
        const double top = frame.worldFromVoxel(glm::dvec3(frame.size - 1)).z;
        for (const double side : {-1.0, 1.0}) {
            const glm::dvec3 half(0.055, 0.085, 0.12);
            const glm::dvec3 middle(side * 0.085, 0.01, top - mSetting.lungs + half.z);
            forBall(middle, half.z + 0.001, [&](const glm::ivec3& v, double) {
                const glm::dvec3 world = frame.worldFromVoxel(glm::dvec3(v)), q = (world - middle) / half;
                if (glm::dot(q, q) > 1 || !inTissue(v, 0.008)) return;
                const glm::dvec3 cell = glm::fract(world / 0.019);
                const bool vessel = glm::length(glm::dvec2(cell.x, cell.y) - 0.5) < 0.14;
                const double texture = 35 * noiseAt(frame.index(v.x, v.y, v.z) * 7 + 1);
                if (vessel)
                    put(v, kTissue, 0);
                else
                    put(v, mSetting.lungDensity + texture, kTrueLung);
            });
        }
    }

    // Adds a stomach to the left at the front; its gas lies in front of its fluid.
    void addStomach() {
        const VolumeFrame& frame = mMade.scan.frame;
        const glm::dvec3 half(mChance.between(0.03, 0.05), mChance.between(0.02, 0.03),
                              mChance.between(0.025, 0.04));
        const glm::dvec3 middle(mChance.between(0.03, 0.07), mChance.between(-0.06, -0.03),
                                mChance.between(0.07, 0.11));
        const double level = middle.y + mChance.between(-0.2, 0.6) * half.y;
        forBall(middle, std::max({half.x, half.y, half.z}), [&](const glm::ivec3& v, double) {
            const glm::dvec3 world = frame.worldFromVoxel(glm::dvec3(v)), q = (world - middle) / half;
            if (glm::dot(q, q) > 1 || !inTissue(v, 0.005)) return;
            if (world.y < level)
                put(v, kGas, kTrueStomach);
            else
                put(v, 30, 0);
        });
    }

    void addSmallBowel() {
        glm::dvec3 place(mChance.between(-0.06, 0.06), mChance.between(-0.05, 0.04),
                         mChance.between(-0.10, 0.05));
        glm::dvec3 direction = mChance.direction();
        const double radius = mChance.between(0.004, 0.010), length = mChance.between(0.01, 0.09);
        for (double along = 0; along < length; along += 0.002) {
            forBall(place, radius, [&](const glm::ivec3& v, double) {
                if (inTissue(v, 0.004)) put(v, kGas, kTrueSmallBowel);
            });
            direction = glm::normalize(direction + 0.25 * mChance.direction());
            place += 0.002 * direction;
        }
    }

    // Adds two balls of metal, with a dark streak between them and bright ones beside them.
    void addProstheses() {
        const VolumeFrame& frame = mMade.scan.frame;
        const double low = frame.worldFromVoxel(glm::dvec3(0)).z + 0.03;
        for (const double side : {-1.0, 1.0})
            forBall({side * 0.105, 0.01, low}, 0.022, [&](const glm::ivec3& v, double) {
                if (inTissue(v, 0.002)) put(v, 3000, 0);
            });
        for (int k = 0; k < frame.size.z; ++k)
            for (int j = 0; j < frame.size.y; ++j)
                for (int i = 0; i < frame.size.x; ++i) {
                    const glm::dvec3 world = frame.worldFromVoxel(glm::dvec3(i, j, k));
                    if (std::abs(world.z - low) > 0.015 || std::abs(world.x) > 0.085) continue;
                    const double away = (world.y - 0.01) / 0.006;
                    const double streak =
                        -850 * std::exp(-away * away) + 250 * std::exp(-(away - 3) * (away - 3));
                    std::int16_t& value = mMade.scan.at(i, j, k);
                    value = static_cast<std::int16_t>(std::clamp(value + streak, -1024.0, 3000.0));
                }
    }

    AbdomenSetting mSetting;
    AbdomenChances mChance;
    std::vector<CentrelinePoint> mAxis;
    Abdomen mMade;
    Volume<std::uint16_t> mAlong;
    Volume<float> mAway;  // distance beyond the tube's radius
    Volume<float> mGap;   // distance from the lumen in metres
};

// Returns a setting with random variations between studies.
inline AbdomenSetting anyAbdomen(std::uint64_t seed) {
    AbdomenChances chance(seed + 1000);
    AbdomenSetting setting;
    setting.seed = seed;
    setting.lungs = chance.below(5) == 0 ? 0 : chance.between(0.004, 0.06);
    setting.lungDensity = chance.below(5) == 0 ? -925 : chance.between(-870, -780);
    setting.stomach = chance.below(4) != 0;
    setting.prostheses = chance.below(5) == 0;
    setting.smallBowel = chance.below(7);
    setting.collapsed = chance.below(4);
    setting.drowned = chance.below(3);
    setting.stool = chance.below(10);
    return setting;
}

inline Abdomen madeAbdomen(const AbdomenSetting& setting) {
    return AbdomenMaker(setting).make();
}

}  // namespace stereonav::test
