#include "terrain/cast/ground_detail.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <glm/geometric.hpp>

#include "engine/base/parallel.h"
#include "terrain/built_in/noise.h"
#include "terrain/scene/ground_color.h"

namespace stereonav {
namespace {

constexpr double kSlope = 0.19;  // slope of a rough octave on steep ground; its gradient's rms is 0.8 of it
constexpr double kFlatter =
    0.93;  // each rough octave against the one before: natural relief has a Hurst exponent near 0.9
// RMS slope of the first weathered octave, and each against the one before: a Hurst exponent of 1.2.
constexpr double kWeatheredSlope = 0.11, kWeatheredFlatter = 0.87;
constexpr double kTone = 0.026, kToneFlatter = 1.0;  // rms of the first octave's tone; each against the last
constexpr double kHalfRough =
    0.12;                          // slope at which ground has half of that; level ground, as water, has none
constexpr double kMostSlopes = 4;  // rms slopes that the map's bits reach

// Gradient noise that repeats after `cells` each way: the lattice's gradients are those of Noise::at().
class RepeatingNoise {
public:
    RepeatingNoise(std::uint64_t seed, int cells) : mCells(cells) {
        const Noise noise(seed);
        for (int j = 0; j < cells; ++j)
            for (int i = 0; i < cells; ++i) {
                const double turn = 2 * 3.14159265358979 * noise.white(i, j);
                mGradients.emplace_back(std::cos(turn), std::sin(turn));
            }
    }
    double at(double x, double y) const {
        const double fx = std::floor(x), fy = std::floor(y), u = x - fx, v = y - fy;
        const int i = static_cast<int>(fx), j = static_cast<int>(fy);
        const auto corner = [&](int di, int dj) {
            const int a = (i + di) % mCells, b = (j + dj) % mCells;
            return glm::dot(mGradients[static_cast<std::size_t>(b) * mCells + a], glm::dvec2(u - di, v - dj));
        };
        const double s = fade(u), t = fade(v);
        return std::lerp(std::lerp(corner(0, 0), corner(1, 0), s), std::lerp(corner(0, 1), corner(1, 1), s),
                         t);
    }

private:
    static double fade(double t) { return t * t * t * (t * (t * 6 - 15) + 10); }

    int mCells;
    std::vector<glm::dvec2> mGradients;
};

// Heights of the map, in words: two lattices of the same size, of which one is shifted and turned by the
// map's own diagonal, hide each other's axes.
std::vector<double> reliefHeights() {
    constexpr int kCells = kReliefSide / kReliefWords, kOther = 53;
    const RepeatingNoise one(4711, kCells), other(4712, kOther);
    std::vector<double> heights(static_cast<std::size_t>(kReliefSide) * kReliefSide);
    parallelFor(kReliefSide, [&](int y) {
        for (int x = 0; x < kReliefSide; ++x) {
            const double px = double(x) / kReliefWords, py = double(y) / kReliefWords;
            const double share = double(kOther) / kReliefSide;
            heights[static_cast<std::size_t>(y) * kReliefSide + x] =
                one.at(px + 0.37, py + 0.61) + 0.8 * other.at(x * share + 0.21, y * share + 0.83);
        }
    });
    return heights;
}

double rmsOf(const std::vector<glm::dvec3>& words, bool slopes) {
    double sum = 0;
    for (const glm::dvec3& w : words) sum += slopes ? w.x * w.x + w.y * w.y : w.z * w.z;
    return std::sqrt(sum / static_cast<double>(words.size()));
}

// Returns a value in `bits` bits around their middle, where `most` is the largest.
std::uint32_t inBits(double value, double most, int bits) {
    const double half = std::ldexp(1.0, bits - 1);
    return static_cast<std::uint32_t>(
        std::clamp(std::round(half + value / most * (half - 1)), 0.0, 2 * half - 1));
}

}  // namespace

GroundDetail::GroundDetail(const Heightfield& ground, Kind kind)
    : mKind(kind), mSpacing(ground.spacing()), mWidth(ground.width()) {
    if (kind == Kind::Weathered) {
        makeRelief();
    } else {
        const Noise noise(4711);
        mValues.resize(static_cast<std::size_t>(kDetailPitch) * kDetailSide);
        for (int y = 0; y < kDetailSide; ++y)
            for (int x = 0; x < kDetailPitch; ++x)
                mValues[static_cast<std::size_t>(y) * kDetailPitch + x] =
                    2 * noise.white(x & (kDetailSide - 1), y) - 1;
    }
    mRough.resize(static_cast<std::size_t>(ground.width()) * ground.height());
    parallelFor(ground.height(), [&](int j) {
        for (int i = 0; i < ground.width(); ++i) {
            const double slope = glm::length(ground.gradientAtSample(i, j));
            mRough[static_cast<std::size_t>(j) * ground.width() + i] =
                std::isfinite(slope) ? static_cast<float>(slope / (slope + kHalfRough)) : 0.0f;
        }
    });
}

// Slopes by central differences, and tones, which are heights; both in bits.
void GroundDetail::makeRelief() {
    const std::vector<double> heights = reliefHeights();
    const auto height = [&](int x, int y) {
        return heights[static_cast<std::size_t>(y & (kReliefSide - 1)) * kReliefSide +
                       (x & (kReliefSide - 1))];
    };
    std::vector<glm::dvec3> words;
    words.reserve(heights.size());
    for (int y = 0; y < kReliefSide; ++y)
        for (int x = 0; x < kReliefSide; ++x)
            words.emplace_back(height(x + 1, y) - height(x - 1, y), height(x, y + 1) - height(x, y - 1),
                               height(x, y));
    double mean = 0;
    for (const glm::dvec3& w : words) mean += w.z / static_cast<double>(words.size());
    for (glm::dvec3& w : words) w.z -= mean;
    const double slope = kMostSlopes * rmsOf(words, true), tone = kMostSlopes * rmsOf(words, false);
    mSlopeUnit = 1023 / kMostSlopes;
    mToneUnit = 511 / kMostSlopes;
    mRelief.resize(static_cast<std::size_t>(kReliefPitch) * kReliefSide);
    for (int y = 0; y < kReliefSide; ++y)
        for (int x = 0; x < kReliefPitch; ++x) {
            const glm::dvec3& w = words[static_cast<std::size_t>(y) * kReliefSide + (x & (kReliefSide - 1))];
            mRelief[static_cast<std::size_t>(y) * kReliefPitch + x] =
                inBits(w.x, slope, 11) | inBits(w.y, slope, 11) << 11 | inBits(w.z, tone, 10) << 22;
        }
}

double GroundDetail::rmsSlope() const {
    const bool weathered = mKind == Kind::Weathered;
    double square = 0, slope = weathered ? kWeatheredSlope : 0.8 * std::sqrt(2.0) * kSlope;
    for (int k = 0; k < kDetailOctaves; ++k, slope *= weathered ? kWeatheredFlatter : kFlatter)
        square += slope * slope;
    return std::sqrt(square);
}

DetailData GroundDetail::forKernels(const TerrainLook& look) const {
    const bool weathered = mKind == Kind::Weathered;
    DetailData data;
    data.values = mValues.data();
    data.relief = weathered ? mRelief.data() : nullptr;
    data.rough = mRough.data();
    data.roughPitch = mWidth;
    data.octaves = kDetailOctaves;
    data.perMetre = static_cast<float>(1 / std::sqrt(mSpacing.x * mSpacing.y));
    const glm::dvec3 sun = GroundLight(look).direct();
    const double words = weathered ? kReliefWords : 1;
    std::complex<double> turn(1, 0);
    double slope = weathered ? kWeatheredSlope / mSlopeUnit : kSlope;
    double tone = weathered ? kTone / mToneUnit : 0;
    for (DetailOctave& octave : data.octave) {
        turn *= std::complex<double>(2, 1);
        octave.a = static_cast<int>(std::lround(words * turn.real()));
        octave.b = static_cast<int>(std::lround(words * turn.imag()));
        const double fine = std::abs(turn);
        octave.cell = static_cast<float>(1 / fine);
        // Heights slope / fine * noise, in cells of the ground: the light falls by the sun's direction along
        // their gradient.
        octave.lightX = static_cast<float>(-slope / fine * (sun.x * turn.real() - sun.y * turn.imag()));
        octave.lightY = static_cast<float>(-slope / fine * (sun.x * turn.imag() + sun.y * turn.real()));
        octave.tone = static_cast<float>(tone);
        slope *= weathered ? kWeatheredFlatter : kFlatter;
        tone *= kToneFlatter;
    }
    return data;
}

}  // namespace stereonav
