#include "tests/oracle/plain_detail.h"

#include <algorithm>
#include <cmath>

namespace stereonav {
namespace {

double fadeOf(double t) {
    return t * t * t * (t * (t * 6 - 15) + 10);
}
double riseOfFade(double t) {
    return 30 * t * t * (1 - t) * (1 - t);
}

// What is at a place of the ground's samples, bilinear.
double roughnessAt(const DetailData& detail, int i, int j, double u, double v) {
    const float* const south = detail.rough + static_cast<std::size_t>(j) * detail.roughPitch + i;
    const float* const north = south + detail.roughPitch;
    return std::lerp(std::lerp(double(south[0]), double(south[1]), u),
                     std::lerp(double(north[0]), double(north[1]), u), v);
}

double weightOf(const DetailData& detail, const DetailOctave& octave, double footprint) {
    return std::clamp(octave.cell / (kDetailPixels * std::max(footprint * detail.perMetre, 1e-9)) - 1, 0.0,
                      1.0);
}

double weatheredAt(const DetailData& detail, int i, int j, double u, double v, double footprint) {
    double light = 0, tone = 0;
    for (const DetailOctave& octave : detail.octave) {
        const double weight = weightOf(detail, octave, footprint);
        if (weight == 0) break;
        const double x = octave.a * u - octave.b * v, y = octave.b * u + octave.a * v;
        const double wholeX = std::floor(x), wholeY = std::floor(y), p = x - wholeX, q = y - wholeY;
        const int column = octave.a * i - octave.b * j + static_cast<int>(wholeX);
        const int row = octave.b * i + octave.a * j + static_cast<int>(wholeY);
        // Bits from `shift` on, without the middle of their range.
        const auto part = [&](int shift, int bits) {
            const auto at = [&](int dx, int dy) {
                const std::uint32_t word = detail.relief[((row + dy) & (kReliefSide - 1)) * kReliefPitch +
                                                         ((column + dx) & (kReliefSide - 1))];
                return double(word >> shift & ((1u << bits) - 1)) - (1 << (bits - 1));
            };
            return std::lerp(std::lerp(at(0, 0), at(1, 0), p), std::lerp(at(0, 1), at(1, 1), p), q);
        };
        light += weight * (octave.lightX * part(0, 11) + octave.lightY * part(11, 11));
        tone += weight * octave.tone * part(22, 10);
    }
    const double rough = roughnessAt(detail, i, j, u, v);
    return std::clamp(rough * light + std::min(4 * rough, 1.0) * tone, double(kDarkestDetail),
                      double(kBrightestDetail));
}

}  // namespace

double detailAt(const DetailData& detail, int i, int j, double u, double v, double footprint) {
    if (detail.relief) return weatheredAt(detail, i, j, u, v, footprint);
    double light = 0;
    for (const DetailOctave& octave : detail.octave) {
        const double weight = weightOf(detail, octave, footprint);
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
    const double rough = roughnessAt(detail, i, j, u, v);
    return std::clamp(rough * light, double(kDarkestDetail), double(kBrightestDetail));
}

}  // namespace stereonav
