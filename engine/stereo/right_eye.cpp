// The pipeline of the right eye: rows warped in bands, region V, colours shaded again where they depend
// on the view, holes cast.
#include "engine/stereo/right_eye.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <numeric>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/stopwatch.h"
#include "engine/stereo/border_occluders.h"
#include "engine/stereo/depth_splat.h"
#include "engine/stereo/error_prediction.h"
#include "engine/stereo/hole_fill.h"
#include "engine/stereo/packed_resample.h"
#include "engine/stereo/paint_row.h"
#include "engine/stereo/row_kernels.h"
#include "engine/stereo/splat_row.h"
#include "engine/stereo/work_queue.h"

namespace stereonav {
namespace {

constexpr int kRowsOfWarpTask = 8;  // rows of a warp task: some ten microseconds

struct Scratch {
    std::vector<float> column, inverse, accumulators;
    std::vector<std::int32_t> source;

    void resize(int width, bool splats) {
        const std::size_t size = static_cast<std::size_t>(width) + kRowPadding;
        column.resize(size);
        inverse.resize(size);
        source.resize(size);
        if (splats) accumulators.resize(static_cast<std::size_t>(splatScratchSize(width)));
    }
};

bool isInverse(RightEyeMethod method) {
    return method == RightEyeMethod::Linear || method == RightEyeMethod::Cubic ||
           method == RightEyeMethod::NoFill || method == RightEyeMethod::Selective;
}

struct WarpJob {
    const StereoViews& views;
    const EyeImage& left;
    const WarpSetting& setting;
    EyeImage& right;
    Plane<std::uint8_t>& mask;
    ViewDependence dependence;
    bool airDiffers;  // colours have the left eye's air before them

    int width() const { return left.width(); }
    float shift() const { return static_cast<float>(views.shiftAtInfinity); }
    float scale() const { return static_cast<float>(views.parallaxScale); }
    // What moves from eye to eye: colours, or the normals from which colours follow.
    bool movesNormals() const { return dependence == ViewDependence::Normal; }
    const Plane<std::uint32_t>& from() const { return movesNormals() ? left.normal : left.color; }
    Plane<std::uint32_t>& to() const { return movesNormals() ? right.normal : right.color; }
};

ResampleRow resampleRowOf(const WarpJob& job, Scratch& scratch, int y) {
    ResampleRow row{};
    row.leftColor = job.from().row(y);
    row.leftDepth = job.left.viewDepth.row(y);
    row.color = job.to().row(y);
    row.depth = job.right.viewDepth.row(y);
    row.holes = job.mask.row(y);
    row.width = job.width();
    row.stride = job.left.color.stride();
    row.shift = job.shift();
    row.scale = job.scale();
    row.minStretch = job.setting.minStretch;
    row.maxStretch = job.setting.maxStretch;
    row.cubic = job.setting.method == RightEyeMethod::Cubic;
    // Four taps must not cross a silhouette. Two can not, but a near thing's last pixel before a gap is
    // cut anywhere within it: cast, it gains more than it costs (compare on real terrain: 0.2 to 3.8 dB for
    // 0.4 to 0.6 % more rays).
    row.reach = row.cubic ? 2 : 1;
    row.column = scratch.column.data();
    row.inverse = scratch.inverse.data();
    row.source = scratch.source.data();
    row.surface = job.movesNormals();
    if (job.setting.method == RightEyeMethod::Selective && !job.left.depthSpread.empty()) {
        row.leftSpread = job.left.depthSpread.row(y);
        row.mostSpread = job.setting.mostSpread;
    }
    return row;
}

// Depths alone are wanted; the colours come along and are cast anew.
ResampleRow depthRowOf(const WarpJob& job, Scratch& scratch, int y) {
    ResampleRow row = resampleRowOf(job, scratch, y);
    row.minStretch = 0.0f;  // what is drawn together is known the better
    row.reach = 0;
    row.surface = false;
    return row;
}

SplatRow splatRowOf(const WarpJob& job, Scratch& scratch, int y) {
    return {job.from().row(y),
            job.left.viewDepth.row(y),
            job.to().row(y),
            job.right.viewDepth.row(y),
            job.mask.row(y),
            job.width(),
            job.shift(),
            job.scale(),
            job.setting.weightThreshold,
            scratch.accumulators.data(),
            scratch.source.data()};
}

PaintRow paintRowOf(const WarpJob& job, Scratch& scratch, int y) {
    return {job.from().row(y),    job.left.viewDepth.row(y),
            job.to().row(y),      job.right.viewDepth.row(y),
            job.mask.row(y),      job.width(),
            job.shift(),          job.scale(),
            scratch.source.data()};
}

// What a highlight needs: base colour between the two linked pixels (or of the nearest one), and the
// normal of the nearer end.
void warpHighlight(const WarpJob& job, const Scratch& scratch, int y) {
    const PackedColor* leftBase = job.left.baseColor.row(y);
    const std::uint32_t* leftNormal = job.left.normal.row(y);
    PackedColor* base = job.right.baseColor.row(y);
    std::uint32_t* normal = job.right.normal.row(y);
    const std::uint8_t* holes = job.mask.row(y);
    const bool between = isInverse(job.setting.method);
    for (int p = 0; p < job.width(); ++p) {
        const int s = scratch.source[p];
        if (holes[p] || s < 0) {
            base[p] = normal[p] = 0;
        } else if (between) {
            const float t = ((static_cast<float>(p) + 0.5f) - scratch.column[s]) * scratch.inverse[s];
            base[p] = lerpPacked(leftBase[s], leftBase[s + 1], t);
            normal[p] = leftNormal[t < 0.5f ? s : s + 1];
        } else {
            base[p] = leftBase[s];
            normal[p] = leftNormal[s];
        }
    }
}

// The forward warps know the nearest of the splats, which is what rays may start from; shading needs the
// depth of the pixel itself.
void useOwnDepths(const WarpJob& job, const Scratch& scratch, int y) {
    const float* leftDepth = job.left.viewDepth.row(y);
    float* depth = job.right.viewDepth.row(y);
    const std::uint8_t* holes = job.mask.row(y);
    for (int p = 0; p < job.width(); ++p)
        if (!holes[p]) depth[p] = leftDepth[scratch.source[p]];
}

// Runs of warped surface; holes are cast for the right eye anyway, sky has no surface.
void shadeHighlightAgain(const EyeRenderer& renderer, const WarpJob& job, int y) {
    const float* depth = job.right.viewDepth.row(y);
    const std::uint8_t* holes = job.mask.row(y);
    const auto surface = [&](int x) { return !holes[x] && depth[x] < kMissDepth; };
    for (int x = 0; x < job.width();) {
        if (!surface(x)) {
            ++x;
            continue;
        }
        int end = x + 1;
        while (end < job.width() && surface(end)) ++end;
        renderer.shadeAgain(job.views.right, y, x, end, job.right);
        x = end;
    }
}

void splatDepths(const WarpJob& job, ResampleFunction resample, Scratch& scratch, int y) {
    const ResampleRow row = depthRowOf(job, scratch, y);
    resample(row);
    shortenDepths(
        {row.depth, row.holes, row.width, job.setting.depthMargin, job.setting.depthRangeMargin, row.column});
}

// Holes that stay holes; what shades whole rows leaves anything there.
void blackenHoles(const WarpJob& job, int y) {
    const std::uint8_t* holes = job.mask.row(y);
    PackedColor* color = job.right.color.row(y);
    for (int p = 0; p < job.width(); ++p) color[p] = holes[p] ? 0u : color[p];
}

// The depth before which the ray of a hole meets nothing. The right ray of column p crosses the left rays
// from the right, that of column x at the depth scale / (x + shift - p). What the left eye saw at the hole's
// right end, the pixel b, survived: nothing that it saw further right lies in front of the ray. So the ray is
// free up to where it crosses the left ray of b; one pixel of margin stands for what lies between left rays.
void startHoles(const WarpJob& job, int y) {
    constexpr float kMargin = 1.0f;
    const std::uint8_t* holes = job.mask.row(y);
    float* depth = job.right.viewDepth.row(y);
    const float perPixel = 1.0f / job.scale();
    // Eight pixels at a time, most of which are none; the row's padding is.
    for (int first = (job.width() - 1) / 8 * 8; first >= 0; first -= 8) {
        std::uint64_t word;
        std::memcpy(&word, holes + first, sizeof word);
        if (word == 0) continue;
        for (int p = std::min(first + 7, job.width() - 1); p >= first; --p) {
            if (!holes[p] || p + 1 == job.width()) continue;
            const float inverse =
                holes[p + 1] ? 1.0f / depth[p + 1] : 1.0f / depth[p + 1] + kMargin * perPixel;
            depth[p] = 1.0f / (inverse + perPixel);
        }
    }
}

// Does it with the pixels' own depths; afterwards the row holds those that rays may start from again.
template <typename Shade>
void withOwnDepths(const WarpJob& job, Scratch& scratch, int y, const Shade& shade) {
    if (isInverse(job.setting.method)) return shade();
    float* depth = job.right.viewDepth.row(y);
    std::copy_n(depth, job.width(), scratch.column.begin());
    useOwnDepths(job, scratch, y);
    shade();
    std::copy_n(scratch.column.begin(), job.width(), depth);
}

void shadeAgain(const EyeRenderer& renderer, const WarpJob& job, Scratch& scratch, int y) {
    if (job.dependence == ViewDependence::Highlight) {
        warpHighlight(job, scratch, y);
        withOwnDepths(job, scratch, y, [&] { shadeHighlightAgain(renderer, job, y); });
    } else if (job.dependence == ViewDependence::Normal) {
        if (!isInverse(job.setting.method)) useOwnDepths(job, scratch, y);
        renderer.shadeAgain(job.views.right, y, 0, job.width(), job.right);
        if (leavesHoles(job.setting.method)) blackenHoles(job, y);
    }
}

void warpRow(const EyeRenderer& renderer, const WarpJob& job, ResampleFunction resample, Scratch& scratch,
             int y) {
    switch (job.setting.method) {
        case RightEyeMethod::DepthSplat:
            return splatDepths(job, resample, scratch, y);
        case RightEyeMethod::Paper:
            splatRow(splatRowOf(job, scratch, y));
            break;
        case RightEyeMethod::McMillan:
            paintRow(paintRowOf(job, scratch, y));
            break;
        default:
            resample(resampleRowOf(job, scratch, y));
            break;
    }
    shadeAgain(renderer, job, scratch, y);
    if (job.airDiffers) renderer.changeAir(job.views.left, job.views.right, y, job.right);
    if (isInverse(job.setting.method) && !leavesHoles(job.setting.method) && renderer.startsAtKnownDepth())
        startHoles(job, y);
}

// What can be shaded again: images without the planes for it are warped as they are.
ViewDependence dependenceOf(const EyeRenderer& renderer, const EyeImage& left) {
    const ViewDependence dependence = renderer.viewDependence();
    if (dependence == ViewDependence::Depths)
        return left.depthSpread.empty() ? ViewDependence::None : dependence;
    const bool base = dependence != ViewDependence::Highlight || !left.baseColor.empty();
    return base && !left.normal.empty() ? dependence : ViewDependence::None;
}

void checkSizes(const StereoViews& views, const EyeImage& left) {
    const EyeView& view = views.right;
    if (left.width() != view.width || left.height() != view.height || left.width() < 1 ||
        left.viewDepth.width() != left.width() || left.viewDepth.height() != left.height())
        throw Error("", "left eye",
                    fmt::format("expected an image of {}x{} pixels, the size of the views, got {}x{}",
                                view.width, view.height, left.width(), left.height()),
                    "cast the left eye with the same views");
}

void copyPlane(const Plane<std::uint32_t>& from, Plane<std::uint32_t>& to) {
    if (!from.empty()) std::memcpy(to.row(0), from.row(0), from.byteCount());
}

void fillMask(Plane<std::uint8_t>& mask, int value) {
    if (!mask.empty()) std::memset(mask.row(0), value, mask.byteCount());
}

}  // namespace

bool leavesHoles(RightEyeMethod method) {
    return method == RightEyeMethod::McMillan || method == RightEyeMethod::NoFill;
}

struct RightEye::State {
    Plane<std::uint8_t> mask;
    Plane<std::uint8_t> contrast;  // only where warped pixels are refined
    std::vector<Scratch> scratch;  // one for each worker
    HoleFill holeFill;
    ResampleFunction resample = resampler();

    void resize(int width, int height, bool splats) {
        mask.resize(width, height);
        scratch.resize(static_cast<std::size_t>(threadCount()));
        for (Scratch& s : scratch) s.resize(width, splats);
    }

    void warp(const EyeRenderer& renderer, const WarpJob& job);
    void copy(const WarpJob& job);
    void refine(const WarpJob& job, RightEyeTimings& timings);
    // Both give the number of pixels that were not known.
    long long fill(const EyeRenderer& renderer, const WarpJob& job);
    long long castFromDepths(const EyeRenderer& renderer, const WarpJob& job) const;
};

void RightEye::State::warp(const EyeRenderer& renderer, const WarpJob& job) {
    const int height = job.left.height();
    const int tasks = (height + kRowsOfWarpTask - 1) / kRowsOfWarpTask;
    forEachPiece(tasks, job.setting.warpSchedule, [&](int worker, int task) {
        const int end = std::min(height, (task + 1) * kRowsOfWarpTask);
        for (int y = task * kRowsOfWarpTask; y < end; ++y)
            warpRow(renderer, job, resample, scratch[worker], y);
    });
    if (job.setting.method != RightEyeMethod::McMillan)
        markBorderOccluders(renderer, job.views, mask, job.right);
}

// Without parallax the right eye is the left one.
void RightEye::State::copy(const WarpJob& job) {
    copyPlane(job.left.color, job.right.color);
    std::memcpy(job.right.viewDepth.row(0), job.left.viewDepth.row(0), job.left.viewDepth.byteCount());
    if (job.dependence == ViewDependence::Highlight) copyPlane(job.left.baseColor, job.right.baseColor);
    copyPlane(job.left.normal, job.right.normal);
    fillMask(mask, 0);
}

// Adds to the holes what is expected to be worth a ray.
void RightEye::State::refine(const WarpJob& job, RightEyeTimings& timings) {
    const Refinement& wanted = job.setting.refinement;
    const ContrastCounts counts = findContrast(job.right.color, mask, contrast);
    const double pixels = static_cast<double>(job.width()) * job.right.height();
    const int lowest = classToCast(wanted, counts, pixels);
    timings.refinedPixels = std::accumulate(counts.begin() + lowest, counts.end(), 0ll);
    timings.boundPsnr_db = wanted.calibration->boundPsnr_db(counts, pixels, lowest);
    if (timings.refinedPixels == 0) return;
    const int tasks = (job.right.height() + kRowsOfWarpTask - 1) / kRowsOfWarpTask;
    parallelFor(tasks, [&](int task) {
        for (int y = task * kRowsOfWarpTask; y < std::min((task + 1) * kRowsOfWarpTask, job.right.height());
             ++y) {
            std::uint8_t* holes = mask.row(y);
            const std::uint8_t* classes = contrast.row(y);
            float* depth = job.right.viewDepth.row(y);
            for (int x = 0; x < job.width(); ++x)
                if (classes[x] >= lowest && classes[x] != kNoContrast) {
                    holes[x] = 255;
                    depth[x] = 0;
                }
        }
    });
}

long long RightEye::State::fill(const EyeRenderer& renderer, const WarpJob& job) {
    return holeFill.fill(renderer, job.views.right, mask, job.setting.fillSchedule, job.right);
}

long long RightEye::State::castFromDepths(const EyeRenderer& renderer, const WarpJob& job) const {
    const EyeView& view = job.views.right;
    forEachPiece(renderer.tileCount(view), job.setting.fillSchedule,
                 [&](int, int tile) { renderer.renderTileFromDepth(view, tile, job.right); });
    long long unknown = 0;
    for (int y = 0; y < mask.height(); ++y)
        unknown += std::count(mask.row(y), mask.row(y) + mask.width(), std::uint8_t{255});
    return unknown;
}

RightEye::RightEye() : mState(std::make_unique<State>()) {}
RightEye::~RightEye() = default;
RightEye::RightEye(RightEye&&) noexcept = default;
RightEye& RightEye::operator=(RightEye&&) noexcept = default;

RightEyeTimings RightEye::render(const EyeRenderer& renderer, const StereoViews& views, const EyeImage& left,
                                 const WarpSetting& setting, EyeImage& right) {
    checkSizes(views, left);
    const int width = left.width(), height = left.height();
    const ViewDependence dependence = dependenceOf(renderer, left);
    // Of several depths nothing is asked of the right eye.
    right.resize(width, height, dependence == ViewDependence::Depths ? ViewDependence::None : dependence);
    mState->resize(width, height, setting.method == RightEyeMethod::Paper);
    const bool again = dependence == ViewDependence::Highlight || dependence == ViewDependence::Normal;
    const bool airDiffers = !again && renderer.airDiffers(glm::distance(views.left.eye, views.right.eye));
    const WarpJob job{views, left, setting, right, mState->mask, dependence, airDiffers};

    RightEyeTimings timings;
    Stopwatch watch;
    const bool refines = setting.refinement.calibration && isInverse(setting.method);
    const bool all = refines && setting.refinement.quality >= 1 && setting.refinement.mostPixels >= 1;
    if (setting.method == RightEyeMethod::Full || all) {
        timings.boundPsnr_db = setting.refinement.calibration ? kMostPsnr_db : 0;
        fillMask(mState->mask, 255);
        watch.lap_ms();
        renderEye(renderer, views.right, right);
        timings.fill_ms = watch.lap_ms();
        timings.holePixels = static_cast<long long>(width) * height;
        return timings;
    }
    const bool parallax = views.parallaxScale > 0;
    if (parallax)
        mState->warp(renderer, job);
    else
        mState->copy(job);
    if (refines && parallax && !leavesHoles(setting.method)) mState->refine(job, timings);
    timings.warp_ms = watch.lap_ms();
    if (!parallax || leavesHoles(setting.method)) return timings;
    timings.holePixels = setting.method == RightEyeMethod::DepthSplat ? mState->castFromDepths(renderer, job)
                                                                      : mState->fill(renderer, job);
    timings.fill_ms = watch.lap_ms();
    return timings;
}

const Plane<std::uint8_t>& RightEye::holeMask() const {
    return mState->mask;
}

RightEyeMethod defaultMethodFor(const EyeRenderer& renderer) {
    return renderer.translucent() ? RightEyeMethod::Selective : kDefaultRightEyeMethod;
}

std::vector<RightEyeMethod> methodsFor(const EyeRenderer& renderer) {
    if (renderer.translucent())
        return {RightEyeMethod::Full, RightEyeMethod::Linear, RightEyeMethod::Selective,
                RightEyeMethod::DepthSplat};
    std::vector<RightEyeMethod> methods;
    for (const NamedMethod& named : kRightEyeMethods)
        if (named.method != RightEyeMethod::DepthSplat && named.method != RightEyeMethod::Selective)
            methods.push_back(named.method);
    return methods;
}

std::optional<RightEyeMethod> rightEyeMethodFromName(std::string_view name) {
    for (const NamedMethod& named : kRightEyeMethods)
        if (named.name == name) return named.method;
    return std::nullopt;
}

std::string_view nameOf(RightEyeMethod method) {
    for (const NamedMethod& named : kRightEyeMethods)
        if (named.method == method) return named.name;
    return "";
}

}  // namespace stereonav
