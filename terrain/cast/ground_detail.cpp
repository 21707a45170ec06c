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

constexpr double kSlope = 0.19;  // of an octave's relief, of steep ground; its gradient's rms is 0.8 of that
constexpr double kFlatter =
    0.93;  // each octave against the one before: natural relief has a Hurst exponent near 0.9
constexpr double kHalfRough =
    0.12;  // slope at which ground has half of that; level ground, as water, has none

double fadeOf(double t) {
    return t * t * t * (t * (t * 6 - 15) + 10);
}
double riseOfFade(double t) {
    return 30 * t * t * (1 - t) * (1 - t);
}

}  // namespace

GroundDetail::GroundDetail(const Heightfield& ground) : mSpacing(ground.spacing()), mWidth(ground.width()) {
    const Noise noise(4711);
    mValues.resize(static_cast<std::size_t>(kDetailPitch) * kDetailSide);
    for (int y = 0; y < kDetailSide; ++y)
        for (int x = 0; x < kDetailPitch; ++x)
            mValues[static_cast<std::size_t>(y) * kDetailPitch + x] =
                2 * noise.white(x & (kDetailSide - 1), y) - 1;
    mRough.resize(static_cast<std::size_t>(ground.width()) * ground.height());
    parallelFor(ground.height(), [&](int j) {
        for (int i = 0; i < ground.width(); ++i) {
            const double slope = glm::length(ground.gradientAtSample(i, j));
            mRough[static_cast<std::size_t>(j) * ground.width() + i] =
                std::isfinite(slope) ? static_cast<float>(slope / (slope + kHalfRough)) : 0.0f;
        }
    });
}

DetailData GroundDetail::forKernels(const TerrainLook& look) const {
    DetailData data;
    data.values = mValues.data();
    data.rough = mRough.data();
    data.roughPitch = mWidth;
    data.octaves = kDetailOctaves;
    data.perMetre = static_cast<float>(1 / std::sqrt(mSpacing.x * mSpacing.y));
    const glm::dvec3 sun = GroundLight(look).direct();
    std::complex<double> turn(1, 0);
    double slope = kSlope;
    for (DetailOctave& octave : data.octave) {
        turn *= std::complex<double>(2, 1);
        octave.a = static_cast<int>(std::lround(turn.real()));
        octave.b = static_cast<int>(std::lround(turn.imag()));
        const double fine = std::abs(turn);
        octave.cell = static_cast<float>(1 / fine);
        // Heights slope / fine * noise, in cells of the ground: the light falls by the sun's direction along
        // their gradient.
        octave.lightX = static_cast<float>(-slope / fine * (sun.x * turn.real() - sun.y * turn.imag()));
        octave.lightY = static_cast<float>(-slope / fine * (sun.x * turn.imag() + sun.y * turn.real()));
        slope *= kFlatter;
    }
    return data;
}

double detailAt(const DetailData& detail, int i, int j, double u, double v, double footprint) {
    double light = 0;
    for (const DetailOctave& octave : detail.octave) {
        const double weight = std::clamp(
            octave.cell / (kDetailPixels * std::max(footprint * detail.perMetre, 1e-9)) - 1, 0.0, 1.0);
        if (weight == 0) break;
        const double x = octave.a * u - octave.b * v, y = octave.b * u + octave.a * v;
        const double wholeX = std::floor(x), wholeY = std::floor(y), p = x - wholeX, q = y - wholeY;
        const int column = octave.a * i - octave.b * j + static_cast<int>(wholeX);
        const int row = octave.b * i + octave.a * j + static_cast<int>(wholeY);
        const auto value = [&](int dx, int dy) {
            return double(detail.values[((row + dy) & (kDetailSide - 1)) * kDetailPitch +
                                        ((column + dx) & (kDetailSide - 1))]);
        };
        const double a = value(0, 0), b = value(1, 0), c = value(0, 1), d = value(1, 1);
        const double alongX = riseOfFade(p) * ((b - a) + fadeOf(q) * ((d - c) - (b - a)));
        const double alongY = riseOfFade(q) * ((c - a) + fadeOf(p) * ((d - b) - (c - a)));
        light += weight * (octave.lightX * alongX + octave.lightY * alongY);
    }
    const float* const south = detail.rough + static_cast<std::size_t>(j) * detail.roughPitch + i;
    const float* const north = south + detail.roughPitch;
    const double rough = std::lerp(std::lerp(double(south[0]), double(south[1]), u),
                                   std::lerp(double(north[0]), double(north[1]), u), v);
    return std::clamp(rough * light, double(kDarkestDetail), double(kBrightestDetail));
}

}  // namespace stereonav
