#include "engine/stereo/error_prediction.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "engine/simd/kernel_sets.h"
#include "engine/simd/simd_target.h"

namespace stereonav {

STEREONAV_EACH_SET(void contrastRow(const ContrastRow&);)

namespace {

constexpr int kRowsOfTask = 16;
// Margin of a frame's error over the expected one where the scatter of frames is not known.
constexpr double kMarginOfOneFrame = 4;
constexpr double kBeyondWorst = 1.5;

double squareOfBytes(PackedColor a, PackedColor b) {
    const auto& bytes = srgbByteFromPacked();
    double sum = 0;
    for (const int shift : {0, 10, 20}) {
        const double d = 1.0 * bytes[a >> shift & 1023u] - bytes[b >> shift & 1023u];
        sum += d * d;
    }
    return sum / 3;
}

void addTo(ContrastCounts& sum, const ContrastCounts& part) {
    for (int c = 0; c < kContrastClasses; ++c) sum[c] += part[c];
}

ContrastRow rowOf(const Plane<std::uint32_t>& color, const Plane<std::uint8_t>& holes,
                  Plane<std::uint8_t>& classes, int y) {
    const int above = std::max(y - 1, 0), below = std::min(y + 1, color.height() - 1);
    return {color.row(above), color.row(y),     color.row(below), holes.row(above),
            holes.row(y),     holes.row(below), classes.row(y),   color.width()};
}

}  // namespace

ContrastFunction fastestContrast() {
    return kernelsOf<ContrastFunction>(SimdTarget::Auto, plain::contrastRow, avx2::contrastRow,
                                       avx512::contrastRow);
}

ContrastCounts findContrast(const Plane<std::uint32_t>& color, const Plane<std::uint8_t>& holes,
                            Plane<std::uint8_t>& classes) {
    classes.resize(color.width(), color.height());
    const ContrastFunction contrast = fastestContrast();
    const int tasks = (color.height() + kRowsOfTask - 1) / kRowsOfTask;
    std::vector<ContrastCounts> parts(static_cast<std::size_t>(tasks));
    parallelFor(tasks, [&](int task) {
        std::array<long long, 256> counts{};  // one for each value of a byte: no branch for holes
        for (int y = task * kRowsOfTask; y < std::min((task + 1) * kRowsOfTask, color.height()); ++y) {
            contrast(rowOf(color, holes, classes, y));
            const std::uint8_t* row = classes.row(y);
            for (int x = 0; x < color.width(); ++x) ++counts[row[x]];
        }
        std::copy_n(counts.begin(), kContrastClasses, parts[static_cast<std::size_t>(task)].begin());
    });
    ContrastCounts sum{};
    for (const ContrastCounts& part : parts) addTo(sum, part);
    return sum;
}

double ErrorCalibration::expectedMeanSquare(const ContrastCounts& counts, double pixels, int cast) const {
    double sum = 0;
    for (int c = 0; c < cast; ++c) sum += static_cast<double>(counts[c]) * meanSquare[c];
    return pixels > 0 ? sum / pixels : 0.0;
}

double ErrorCalibration::boundPsnr_db(const ContrastCounts& counts, double pixels, int cast) const {
    const double square = margin[cast] * expectedMeanSquare(counts, pixels, cast);
    return square > 0 ? std::min(10 * std::log10(255.0 * 255.0 / square), kMostPsnr_db) : kMostPsnr_db;
}

void ErrorCalibrator::add(const EyeImage& warped, const Plane<std::uint8_t>& holes, const EyeImage& full) {
    Plane<std::uint8_t> classes;
    Frame frame;
    frame.counts = findContrast(warped.color, holes, classes);
    for (int y = 0; y < warped.height(); ++y)
        for (int x = 0; x < warped.width(); ++x)
            if (const std::uint8_t c = classes.at(x, y); c != kNoContrast)
                frame.squares[c] += squareOfBytes(warped.color.at(x, y), full.color.at(x, y));
    mFrames.push_back(frame);
}

// Frames scatter about what is expected of them, roughly by factors that are normally distributed in their
// logarithm: 95 of 100 lie below 1.645 of its standard deviations, more of them where these are known from a
// few frames only (close to Student's t). Where the tail is longer than that, the worst frame seen tells.
double ErrorCalibrator::marginOf(const ErrorCalibration& calibration, int cast) const {
    std::vector<double> scatter;
    for (const Frame& frame : mFrames) {
        const double expected = calibration.expectedMeanSquare(frame.counts, 1.0, cast);
        const double found = std::accumulate(frame.squares.begin(), frame.squares.begin() + cast, 0.0);
        if (expected > 0 && found > 0) scatter.push_back(std::log(found / expected));
    }
    const double count = static_cast<double>(scatter.size());
    if (count < 2) return kMarginOfOneFrame;
    double mean = 0, square = 0;
    for (const double s : scatter) mean += s / count;
    for (const double s : scatter) square += (s - mean) * (s - mean) / (count - 1);
    const double student = 1.645 * (1 + 1.5 / (count - 1));
    const double worst = *std::max_element(scatter.begin(), scatter.end());
    return std::max(std::exp(mean + student * std::sqrt(square * (1 + 1 / count))),
                    kBeyondWorst * std::exp(worst));
}

ErrorCalibration ErrorCalibrator::result() const {
    if (mFrames.empty())
        throw Error("", "error calibration", "expected at least one frame, got none", "give views");
    ErrorCalibration calibration;
    double below = 0;
    for (int c = 0; c < kContrastClasses; ++c) {
        double squares = 0, count = 0;
        for (const Frame& frame : mFrames) {
            squares += frame.squares[c];
            count += static_cast<double>(frame.counts[c]);
        }
        calibration.meanSquare[c] = below = std::max(count > 0 ? squares / count : 0.0, below);
    }
    for (int cast = 0; cast <= kContrastClasses; ++cast)
        calibration.margin[cast] = marginOf(calibration, cast);
    return calibration;
}

int classToCast(const Refinement& refinement, const ContrastCounts& counts, double pixels) {
    const ErrorCalibration& known = *refinement.calibration;
    const double allowed =
        (1 - std::clamp(refinement.quality, 0.0, 1.0)) * known.expectedMeanSquare(counts, pixels);
    const auto reached = [&](int cast) {
        return known.expectedMeanSquare(counts, pixels, cast) <= allowed &&
               known.boundPsnr_db(counts, pixels, cast) >= std::min(refinement.targetPsnr_db, kMostPsnr_db);
    };
    double cast = 0;
    int lowest = kContrastClasses;
    while (lowest > 0 && !reached(lowest)) {
        cast += static_cast<double>(counts[lowest - 1]);
        if (cast > refinement.mostPixels * pixels) break;
        --lowest;
    }
    return lowest;
}

}  // namespace stereonav
