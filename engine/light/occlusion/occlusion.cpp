// Cuts the volume into bands of rows, so that what lies between the two steps of the filters stays small and
// is used again by the next band; deals slices and rows to threads.
#include "engine/light/occlusion/occlusion.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <mutex>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "engine/light/occlusion/occlusion_kernel_types.h"
#include "engine/simd/kernel_sets.h"

namespace stereonav {

STEREONAV_EACH_SET(void filterOcclusionSlice(const OcclusionBand& band, int k,
                                             const OcclusionScratch& scratch);
                   void finishOcclusionRow(const OcclusionBand& band, int j,
                                           const OcclusionScratch& scratch);)

namespace {

OcclusionKernels kernelsFor(SimdTarget target) {
    return kernelsOf<OcclusionKernels>(target, {plain::filterOcclusionSlice, plain::finishOcclusionRow},
                                       {avx2::filterOcclusionSlice, avx2::finishOcclusionRow},
                                       {avx512::filterOcclusionSlice, avx512::finishOcclusionRow});
}

// Cuts pieces off a block of memory; without a block it only counts.
class Carver {
public:
    explicit Carver(std::byte* block) : mBlock(block) {}
    template <typename T>
    void take(T*& piece, std::size_t count) {
        if (mBlock) piece = reinterpret_cast<T*>(mBlock + mUsed);
        mUsed += (count * sizeof(T) + kAlign - 1) / kAlign * kAlign;
    }
    std::size_t used() const { return mUsed; }

private:
    static constexpr std::size_t kAlign = 64;
    std::byte* mBlock;
    std::size_t mUsed = 0;
};

std::size_t carve(OcclusionScratch& s, std::byte* block, int stride, int window) {
    constexpr std::size_t kStrip = kOcclusionStrip;
    const std::size_t row = static_cast<std::size_t>(stride) + (2 * kMostOcclusionRadius + 1);
    Carver carver(block);
    for (std::int16_t** p : {&s.suffixLows, &s.suffixHighs})
        carver.take(*p, kStrip * static_cast<std::size_t>(window));
    for (std::int16_t** p : {&s.runLows, &s.runHighs}) carver.take(*p, kStrip);
    for (std::int16_t** p : {&s.lows, &s.highs}) carver.take(*p, row);
    carver.take(s.prefix, row);
    carver.take(s.squaresPrefix, row);
    for (double** p : {&s.total, &s.totalSquares}) carver.take(*p, kStrip);
    for (std::int32_t** p : {&s.value, &s.low, &s.high, &s.out}) carver.take(*p, kStrip);
    return carver.used();
}

// Working memory for as many threads as ask at a time.
class ScratchPool {
public:
    ScratchPool(int stride, int window) : mStride(stride), mWindow(window) {}

    template <typename Body>
    void with(const Body& body) {
        const std::unique_ptr<Piece> piece = get();
        body(piece->scratch);
        const std::lock_guard lock(mMutex);
        mFree.push_back(std::make_unique<Piece>(std::move(*piece)));
    }

private:
    struct Piece {
        LazyArray<std::byte> memory;
        OcclusionScratch scratch{};
    };
    std::unique_ptr<Piece> get() {
        const std::lock_guard lock(mMutex);
        if (mFree.empty()) {
            auto piece = std::make_unique<Piece>();
            piece->memory = LazyArray<std::byte>(carve(piece->scratch, nullptr, mStride, mWindow));
            carve(piece->scratch, piece->memory.data(), mStride, mWindow);
            return piece;
        }
        std::unique_ptr<Piece> piece = std::move(mFree.back());
        mFree.pop_back();
        return piece;
    }
    int mStride, mWindow;
    std::mutex mMutex;
    std::vector<std::unique_ptr<Piece>> mFree;
};

// Memory for the boxes of a band.
constexpr std::size_t kBandBytes = std::size_t{16} << 20;
constexpr int kLeastBandRows = 8;

class BoxFilter {
public:
    BoxFilter(const GreyVolume& volume, BoxResult result, const glm::ivec3& radius, SimdTarget target)
        : mKernels(kernelsFor(target)), mTo(volume.frame) {
        const glm::ivec3 size = volume.frame.size;
        mBand.values = volume.values.data();
        mTo.values.preferLargePages();
        mBand.to = mTo.values.data();
        for (int axis = 0; axis < 3; ++axis) {
            mBand.size[axis] = size[axis];
            mBand.radius[axis] = std::min(radius[axis], size[axis] - 1);
        }
        mBand.result = result;
        mBand.turned = volume.scale < 0;
        mBand.stride = (size.x + kOcclusionStrip - 1) / kOcclusionStrip * kOcclusionStrip;
        countColumns();
        takeMemory();
    }

    // For Variance the result of a squared stored number; for the others see OcclusionEstimate.
    void setPerVariance(double perVariance) { mBand.perVariance = static_cast<float>(perVariance); }
    void setShape(double beta, double deviations) {
        mBand.beta = static_cast<float>(beta);
        mBand.deviations = static_cast<float>(deviations);
    }

    Volume<std::uint8_t> run(Progress& progress) {
        const int height = mBand.size[1];
        const int window = 2 * std::max(mBand.radius[1], mBand.radius[2]) + 1;
        ScratchPool pool(mBand.stride, window);
        for (int first = 0; first < height; first += mRows) {
            progress.report(static_cast<double>(first) / height, "occlusion");
            mBand.first = first;
            mBand.end = std::min(first + mRows, height);
            parallelFor(mBand.size[2], [&](int k) {
                pool.with([&](const OcclusionScratch& s) { mKernels.filterSlice(mBand, k, s); });
            });
            parallelFor(mBand.end - mBand.first, [&](int n) {
                pool.with([&](const OcclusionScratch& s) { mKernels.finishRow(mBand, mBand.first + n, s); });
            });
        }
        progress.report(1, "occlusion");
        return std::move(mTo);
    }

private:
    void countColumns() {
        mCounts.assign(static_cast<std::size_t>(mBand.stride), 1.0);
        const int n = mBand.size[0], radius = mBand.radius[0];
        for (int i = 0; i < n; ++i)
            mCounts[static_cast<std::size_t>(i)] = std::min(i + radius, n - 1) - std::max(i - radius, 0) + 1;
        mBand.columnCounts = mCounts.data();
    }

    // Extrema along j begin anew with each band, by looking at a whole window: not too often, then.
    int bandRows(std::size_t bytes) const {
        const auto fit = static_cast<int>(std::min<std::size_t>(kBandBytes / bytes, 1u << 20));
        return std::min(std::max({fit, kLeastBandRows, mBand.radius[1] / 2}), mBand.size[1]);
    }

    void takeMemory() {
        const std::size_t voxels = static_cast<std::size_t>(mBand.stride) * mBand.size[2];
        mRows = bandRows(voxels * (4 + (mBand.extrema() ? 4 : 0) + (mBand.moments() ? 8 : 0)));
        const std::size_t count = voxels * static_cast<std::size_t>(mRows);
        take(mSums, mBand.sums, count);
        take(mLastSums, mBand.lastSums, voxels);
        if (mBand.extrema()) {
            take(mLows, mBand.lows, count);
            take(mHighs, mBand.highs, count);
        }
        if (mBand.moments()) {
            take(mSquares, mBand.squares, count);
            take(mLastSquares, mBand.lastSquares, voxels);
        }
    }
    template <typename T>
    static void take(LazyArray<T>& memory, T*& pointer, std::size_t count) {
        memory = LazyArray<T>(count);
        memory.preferLargePages();
        pointer = memory.data();
    }

    OcclusionKernels mKernels;
    Volume<std::uint8_t> mTo;
    OcclusionBand mBand;
    int mRows = 1;
    std::vector<double> mCounts;
    LazyArray<std::int32_t> mSums, mLastSums;
    LazyArray<std::int16_t> mLows, mHighs;
    LazyArray<double> mSquares;
    LazyArray<std::int64_t> mLastSquares;
};

void checkInput(const GreyVolume& volume, const glm::ivec3& radius) {
    const glm::ivec3 size = volume.frame.size;
    if (volume.empty() || size.x < 1 || size.y < 1 || size.z < 1)
        throw Error(
            "", "occlusion",
            fmt::format("expected a volume of at least one voxel, got {}x{}x{}", size.x, size.y, size.z),
            "load a volume first");
    const bool within = std::min({radius.x, radius.y, radius.z}) >= 0 &&
                        std::max({radius.x, radius.y, radius.z}) <= kMostOcclusionRadius;
    if (!within || radius == glm::ivec3(0))
        throw Error("", "occlusion radius",
                    fmt::format("expected 0 to {} voxels along each axis and not 0 along all, got {}, {}, {}",
                                kMostOcclusionRadius, radius.x, radius.y, radius.z),
                    "choose a radius of 1 to 64 voxels");
    if (!std::isfinite(volume.scale))
        throw Error("", "occlusion", fmt::format("expected a finite scale of values, got {}", volume.scale),
                    "check the volume's header");
}

void checkPositive(double value, const char* name) {
    if (!(value > 0 && std::isfinite(value)))
        throw Error("", name, fmt::format("expected a number above 0, got {}", value), "choose a larger one");
}

void checkEstimate(const OcclusionEstimate& estimate) {
    const bool fitted = estimate.beta == 0;
    if (!fitted && !(estimate.beta >= kLeastBeta && estimate.beta <= kMostBeta))
        throw Error("", "beta of t^beta",
                    fmt::format("expected {:g} to {:g}, got {:g}", kLeastBeta, kMostBeta, estimate.beta),
                    "leave it out to fit it to the mean");
    if (!(estimate.deviations >= kLeastDeviations && estimate.deviations <= kMostDeviations))
        throw Error("", "deviations of drawn-in ends",
                    fmt::format("expected {:g} to {:g}, got {:g}", kLeastDeviations, kMostDeviations,
                                estimate.deviations),
                    "3 is usual");
}

BoxResult resultOf(OcclusionMethod method) {
    switch (method) {
        case OcclusionMethod::Gaussian:
            return BoxResult::Gaussian;
        case OcclusionMethod::Chebyshev:
            return BoxResult::Chebyshev;
        case OcclusionMethod::DrawnIn:
            return BoxResult::DrawnIn;
        default:
            return BoxResult::Reconstructed;
    }
}

constexpr std::uint8_t kHalfOpen = 128;  // 1/2, rounded as the kernels do

}  // namespace

double largestOcclusionRadius(const VolumeFrame& frame) {
    double largest = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis)
        if (frame.size[axis] - 1 > kMostOcclusionRadius)
            largest = std::min(largest, kMostOcclusionRadius * frame.spacing[axis]);
    return largest;
}

glm::ivec3 occlusionRadius(const VolumeFrame& frame, double radius) {
    checkPositive(radius, "occlusion radius");
    constexpr double kRounding = 1 + 1e-6;  // a figure that was printed is taken again
    if (const double largest = largestOcclusionRadius(frame); radius > largest * kRounding)
        throw Error("", "occlusion radius",
                    fmt::format("expected at most {:.6g} mm in this volume, {} voxels, got {:.6g}",
                                1000 * largest, kMostOcclusionRadius, 1000 * radius),
                    "choose a smaller one");
    glm::ivec3 voxels(0);
    for (int axis = 0; axis < 3; ++axis) {
        const double exact = std::min<double>(radius / frame.spacing[axis], kMostOcclusionRadius);
        const int whole = static_cast<int>(std::lround(exact));
        voxels[axis] = whole < kMostOcclusionRadius ? whole : std::clamp(frame.size[axis] - 1, 1, whole);
    }
    if (voxels == glm::ivec3(0))
        for (int axis = 0; axis < 3; ++axis)
            if (frame.spacing[axis] == std::min({frame.spacing.x, frame.spacing.y, frame.spacing.z}))
                voxels[axis] = 1;
    return voxels;
}

OpennessVolume estimateOpenness(const GreyVolume& volume, const OcclusionEstimate& estimate,
                                const glm::ivec3& radius, Progress& progress, SimdTarget target) {
    checkInput(volume, radius);
    checkEstimate(estimate);
    if (volume.scale == 0) {
        OpennessVolume even(volume.frame);
        std::fill_n(even.values.data(), even.values.size(), kHalfOpen);
        progress.report(0, "occlusion");
        progress.report(1, "occlusion");
        return even;
    }
    BoxFilter filter(volume, resultOf(estimate.method), radius, target);
    filter.setShape(estimate.beta, estimate.deviations);
    return filter.run(progress);
}

Volume<std::uint8_t> varianceModulation(const GreyVolume& volume, const glm::ivec3& radius, double sigmaMax,
                                        Progress& progress, SimdTarget target) {
    checkInput(volume, radius);
    checkPositive(sigmaMax, "sigma of the opacity modulation");
    const double ratio = volume.scale / sigmaMax;
    const double most = std::numeric_limits<float>::max();
    BoxFilter filter(volume, BoxResult::Variance, radius, target);
    filter.setPerVariance(std::min(ratio * ratio, most));
    return filter.run(progress);
}

}  // namespace stereonav
