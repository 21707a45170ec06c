// The pipeline of the right eye: rows are warped in bands, with colours shaded again where they depend on the
// view; region V (border_occluders.h) is marked as holes; holes are cast.
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
#include "engine/stereo/error_prediction.h"
#include "engine/stereo/hole_fill.h"
#include "engine/stereo/packed_resample.h"
#include "engine/stereo/row_kernels.h"
#include "engine/stereo/warp_method.h"
#include "engine/stereo/work_queue.h"

namespace stereonav {
namespace {

constexpr int kRowsOfWarpTask = 8;  // rows of a warp task: some ten microseconds
// Share of holes from which the whole picture is cast: a ray into a hole takes 1.4 to 2.6 times as long as
// one of a full cast (colon, 500x400), so that the rays saved on the few warped pixels no longer pay for it.
constexpr double kMostHoles = 0.6;

// Warps what a highlight needs: base colour between the two linked pixels (or of the nearest one), and the
// normal of the nearer end.
void warpHighlight(const WarpJob& job, const WarpScratch& scratch, int y) {
    const PackedColor* leftBase = job.left.baseColor.row(y);
    const std::uint32_t* leftNormal = job.left.normal.row(y);
    PackedColor* base = job.right.baseColor.row(y);
    std::uint32_t* normal = job.right.normal.row(y);
    const std::uint8_t* holes = job.mask.row(y);
    const bool between = job.method.between;
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

// Replaces the depths of a row's warped pixels by those of the left pixels that they came from, for shading.
// Forward warps write the nearest depth of all splats on a pixel instead, as the start of rays.
void useOwnDepths(const WarpJob& job, const WarpScratch& scratch, int y) {
    const float* leftDepth = job.left.viewDepth.row(y);
    float* depth = job.right.viewDepth.row(y);
    const std::uint8_t* holes = job.mask.row(y);
    for (int p = 0; p < job.width(); ++p)
        if (!holes[p]) depth[p] = leftDepth[scratch.source[p]];
}

// Shades a row's runs of warped surface for the right eye. Leaves out holes, which are cast for the right eye
// anyway, and sky, which has no surface.
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

// Sets the holes of a row to black, for methods that do not cast them: shading a whole row has written
// arbitrary colours there.
void blackenHoles(const WarpJob& job, int y) {
    const std::uint8_t* holes = job.mask.row(y);
    PackedColor* color = job.right.color.row(y);
    for (int p = 0; p < job.width(); ++p) color[p] = holes[p] ? 0u : color[p];
}

// Writes for each hole of a row the depth before which its ray meets nothing. The right ray of column p
// crosses the left rays one after the other, those further right at smaller depths: that of column x at the
// depth scale / (x + shift - p). Let b be the warped pixel at the hole's right end, and x the column where
// the left eye saw its surface. That surface was not hidden in the warp, so nothing that the left eye saw to
// the right of x lies in front of the ray of p. The ray is free up to where it crosses the left ray of x; a
// margin of one pixel allows for what lies between left rays.
void startHoles(const WarpJob& job, int y) {
    constexpr float kMargin = 1.0f;
    const std::uint8_t* holes = job.mask.row(y);
    float* depth = job.right.viewDepth.row(y);
    const float perPixel = 1.0f / job.scale();
    // Tests eight mask bytes at a time, since most hold no hole. The last eight may reach into the row's
    // padding, which may be read and is left out below.
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

// Calls shade() while the row holds the depths of useOwnDepths(); afterwards the row has its former depths
// again, from which rays may start. Methods that warp between two left pixels shade with the row as it is.
template <typename Shade>
void withOwnDepths(const WarpJob& job, WarpScratch& scratch, int y, const Shade& shade) {
    if (job.method.between) return shade();
    float* depth = job.right.viewDepth.row(y);
    std::copy_n(depth, job.width(), scratch.column.begin());
    useOwnDepths(job, scratch, y);
    shade();
    std::copy_n(scratch.column.begin(), job.width(), depth);
}

void shadeAgain(const EyeRenderer& renderer, const WarpJob& job, WarpScratch& scratch, int y) {
    if (job.dependence == ViewDependence::Highlight) {
        warpHighlight(job, scratch, y);
        withOwnDepths(job, scratch, y, [&] { shadeHighlightAgain(renderer, job, y); });
    } else if (job.dependence == ViewDependence::Normal) {
        if (!job.method.between) useOwnDepths(job, scratch, y);
        renderer.shadeAgain(job.views.right, y, 0, job.width(), job.right);
        if (job.method.after == AfterWarp::Leave) blackenHoles(job, y);
    }
}

void warpRow(const EyeRenderer& renderer, const WarpJob& job, ResampleFunction resample, WarpScratch& scratch,
             int y) {
    job.method.warpRow(job, resample, scratch, y);
    if (job.method.after == AfterWarp::CastFromDepths) return;  // colours are cast anew
    shadeAgain(renderer, job, scratch, y);
    if (job.airDiffers) renderer.changeAir(job.views.left, job.views.right, y, job.right);
    if (job.method.between && job.method.after != AfterWarp::Leave && renderer.startsAtKnownDepth())
        startHoles(job, y);
}

// Returns what can be shaded again: images without the planes for it are warped as they are.
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

struct RightEye::State {
    Plane<std::uint8_t> mask;
    Plane<std::uint8_t> contrast;      // only where warped pixels are refined
    std::vector<WarpScratch> scratch;  // one for each worker
    HoleFill holeFill;
    ResampleFunction resample = resampler();

    void resize(int width, int height, bool splats) {
        mask.resize(width, height);
        scratch.resize(static_cast<std::size_t>(threadCount()));
        for (WarpScratch& s : scratch) s.resize(width, splats);
    }

    void warp(const EyeRenderer& renderer, const WarpJob& job);
    void copy(const WarpJob& job);
    void refine(const WarpJob& job, RightEyeTimings& timings);
    // Return the number of pixels that were not known.
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
    if (job.method.marksBorder) markBorderOccluders(renderer, job.views, mask, job.right);
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
    const long long holes = holeFill.list(mask, job.setting.fillSchedule);
    const long long pixels = static_cast<long long>(job.width()) * job.right.height();
    if (static_cast<double>(holes) > kMostHoles * static_cast<double>(pixels)) {
        renderEye(renderer, job.views.right, job.right);
        fillMask(mask, 255);
        return pixels;
    }
    holeFill.cast(renderer, job.views.right, job.setting.fillSchedule, job.right);
    return holes;
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
    const WarpMethod& method = warpMethodOf(setting.method);
    const int width = left.width(), height = left.height();
    const ViewDependence dependence = dependenceOf(renderer, left);
    // The right eye needs no planes for colours of several depths.
    right.resize(width, height, dependence == ViewDependence::Depths ? ViewDependence::None : dependence);
    mState->resize(width, height, method.splats);
    const bool again = dependence == ViewDependence::Highlight || dependence == ViewDependence::Normal;
    const bool airDiffers = !again && renderer.airDiffers(glm::distance(views.left.eye, views.right.eye));
    const WarpJob job{views, left, setting, method, right, mState->mask, dependence, airDiffers};

    RightEyeTimings timings;
    Stopwatch watch;
    const bool refines = setting.refinement.calibration && method.between;
    const bool all = refines && setting.refinement.quality >= 1 && setting.refinement.mostPixels >= 1;
    if (!method.warpRow || all) {
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
    if (refines && parallax && method.after != AfterWarp::Leave) mState->refine(job, timings);
    timings.warp_ms = watch.lap_ms();
    if (!parallax || method.after == AfterWarp::Leave) return timings;
    timings.holePixels = method.after == AfterWarp::CastFromDepths ? mState->castFromDepths(renderer, job)
                                                                   : mState->fill(renderer, job);
    timings.fill_ms = watch.lap_ms();
    return timings;
}

const Plane<std::uint8_t>& RightEye::holeMask() const {
    return mState->mask;
}

}  // namespace stereonav
