#include "terrain/cast/ground_detail.h"

#include <cmath>
#include <complex>
#include <glm/geometric.hpp>

#include "engine/base/parallel.h"
#include "terrain/built_in/noise.h"
#include "terrain/scene/ground_color.h"

namespace stereonav {
namespace {

constexpr double kSlope = 0.19;  // slope of an octave on steep ground; its gradient's rms is 0.8 of it
constexpr double kFlatter =
    0.93;  // each octave against the one before: natural relief has a Hurst exponent near 0.9
constexpr double kHalfRough =
    0.12;  // slope at which ground has half of that; level ground, as water, has none

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

}  // namespace stereonav
