#include "app/view/frame_truth.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/vec3.hpp>
#include <vector>

#include "engine/base/parallel.h"
#include "engine/base/stopwatch.h"
#include "engine/metrics/image_difference.h"
#include "engine/scene/capabilities.h"
#include "engine/scene/surface_paint.h"

namespace stereonav {
namespace {

constexpr int kRowsOfTruth = 32;  // rows per task
constexpr double kLongestSweep_ms =
    200;  // milliseconds beside a picture at rest: work that can not be stopped delays a request
constexpr const char* kNoSecondEye = "one eye is shown: there is no right eye to hold against its truth";

int bandsOf(const Plane<PackedColor>& image) {
    return (image.height() + kRowsOfTruth - 1) / kRowsOfTruth;
}

template <typename Row>
void forRowsOf(const Plane<PackedColor>& image, int band, const Row& row) {
    const int end = std::min(image.height(), (band + 1) * kRowsOfTruth);
    for (int y = band * kRowsOfTruth; y < end; ++y) row(y);
}

int apart(const std::array<std::uint8_t, 1024>& bytes, PackedColor a, PackedColor b, int shift) {
    return std::abs(int{bytes[a >> shift & 1023u]} - int{bytes[b >> shift & 1023u]});
}

struct ErrorSum {
    std::int64_t squares = 0, wrong = 0;
    int largest = 0;

    void add(int red, int green, int blue) {
        squares += red * red + green * green + blue * blue;
        const int most = std::max({red, green, blue});
        largest = std::max(largest, most);
        wrong += most > 0;
    }
    void add(const ErrorSum& other) {
        squares += other.squares;
        wrong += other.wrong;
        largest = std::max(largest, other.largest);
    }
};

// Returns a mixed red, which is visible through any glasses and beside pure red.
PackedColor holeColor() {
    static const PackedColor color =
        packColor({linearFromSrgb(0.9f), linearFromSrgb(0.25f), linearFromSrgb(0.2f)});
    return color;
}

}  // namespace

PictureError errorOf(const Plane<PackedColor>& truth, const Plane<PackedColor>& image) {
    const auto& bytes = srgbByteFromPacked();
    std::vector<ErrorSum> sums(static_cast<std::size_t>(bandsOf(image)));
    parallelFor(bandsOf(image), [&](int band) {
        ErrorSum sum;
        forRowsOf(image, band, [&](int y) {
            const PackedColor *a = truth.row(y), *b = image.row(y);
            for (int x = 0; x < image.width(); ++x)
                if (a[x] != b[x])
                    sum.add(apart(bytes, a[x], b[x], 0), apart(bytes, a[x], b[x], 10),
                            apart(bytes, a[x], b[x], 20));
        });
        sums[static_cast<std::size_t>(band)] = sum;
    });
    ErrorSum all;
    for (const ErrorSum& sum : sums) all.add(sum);
    const double pixels = static_cast<double>(image.width()) * image.height();
    PictureError error{kIdenticalPsnr_db, all.largest,
                       pixels > 0 ? static_cast<double>(all.wrong) / pixels : 0};
    if (all.squares > 0)
        error.psnr_db = std::min(kIdenticalPsnr_db, 10 * std::log10(255.0 * 255.0 * 3 * pixels /
                                                                    static_cast<double>(all.squares)));
    return error;
}

void showDifference(const Plane<PackedColor>& truth, Plane<PackedColor>& image) {
    const auto& bytes = srgbByteFromPacked();
    const auto& packed = packedFromSrgbByte();
    const auto times = [&](PackedColor a, PackedColor b, int shift) {
        const int byte = std::min(kTruthTimes * apart(bytes, a, b, shift), 255);
        return PackedColor{packed[static_cast<std::size_t>(byte)]} << shift;
    };
    parallelFor(bandsOf(image), [&](int band) {
        forRowsOf(image, band, [&](int y) {
            const PackedColor* a = truth.row(y);
            PackedColor* b = image.row(y);
            for (int x = 0; x < image.width(); ++x)
                b[x] = times(a[x], b[x], 0) | times(a[x], b[x], 10) | times(a[x], b[x], 20);
        });
    });
}

void showHoles(const Plane<std::uint8_t>& mask, Plane<PackedColor>& image) {
    const PackedColor red = holeColor();
    for (int y = 0; y < image.height(); ++y) {
        const std::uint8_t* holes = mask.row(y);
        PackedColor* color = image.row(y);
        for (int x = 0; x < image.width(); ++x) color[x] = holes[x] ? red : color[x];
    }
}

FrameWay TruthMaker::wayOf(TruthView view, const FrameWay& way, const FrameMaker& frames) {
    if (view == TruthView::FullCast) return {frames.exactMethod(), {}, way.edges};
    return way;
}

TruthMaker::Shown TruthMaker::showOfOneEye(TruthView view) {
    mAsMade = {};
    return {view == TruthView::None ? "" : kNoSecondEye, std::nullopt};
}

TruthMaker::Shown TruthMaker::show(TruthView view, const Scene& scene, const StereoViews& views, double time,
                                   const FrameWay& way, EyePair& frame) {
    mAsMade = {};
    FrameMaker& frames = scene.frames();
    RightFromLeft* const warped = frames.rightFromLeft();
    if (view == TruthView::None) return {};
    if (view == TruthView::FullCast)
        return {warped ? "" : "both eyes are swept: this is each eye's own sweep", std::nullopt};
    if (way.method == frames.exactMethod())
        return {warped ? "this way casts the right eye in full: there is no shortcut to look at"
                       : "this way sweeps each eye by itself: there is no shortcut to look at",
                std::nullopt};
    if (view == TruthView::Difference) {
        makeTruth(scene, views, time, way, nullptr);
        const PictureError error = errorOf(mTruth.left.color, frame.right.color);
        showDifference(mTruth.left.color, frame.right.color);
        return {warped ? "" : "both eyes are swept: the difference is from the right eye's own sweep", error};
    }
    if (!warped)
        return {"both eyes are swept: there are no holes, all of the right eye was looked at", std::nullopt};
    const Plane<std::uint8_t>& mask = warped->holes().mask;
    if (mask.width() != frame.right.width() || mask.height() != frame.right.height())
        return {"this right eye has no holes to show", std::nullopt};
    mAsMade = frame.right.color;
    showHoles(mask, frame.right.color);
    return {};
}

bool TruthMaker::makeTruth(const Scene& scene, const StereoViews& views, double time, const FrameWay& way,
                           const std::atomic<bool>* stop) {
    const auto* const rays = scene.offered<RayCast>();
    if (!rays) {  // an eye is made as a whole
        scene.frames().makeOne(views.right, time, mTruth);
        paintEye(scene, views.right, mTruth.left);
        return !(stop && *stop);
    }
    const EyeRenderer& renderer = *rays->renderer;
    const EyeView& view = views.right;
    mTruth.left.resize(view.width, view.height, renderer.viewDependence());
    parallelFor(renderer.tileCount(view), [&](int tile) {
        if (!(stop && *stop)) renderer.renderTile(view, tile, mTruth.left);
    });
    if (stop && *stop) return false;
    // Only the warp is measured: both pictures have the same rays at their edges.
    if (RightFromLeft* const cast = scene.frames().rightFromLeft()) cast->smoothEdges(view, way, mTruth.left);
    paintEye(scene, view, mTruth.left);
    return true;
}

std::optional<FrameTruth> TruthMaker::measure(const Scene& scene, const StereoViews& views, double time,
                                              const FrameWay& way, const EyePair& frame,
                                              const std::atomic<bool>& stop) {
    FrameTruth truth;
    if (frame.right.color.empty()) {
        truth.note = kNoSecondEye;
        return truth;
    }
    if (way.method == scene.frames().exactMethod()) {  // nothing to find out
        truth.error.psnr_db = kIdenticalPsnr_db;
        return truth;
    }
    if (!scene.offered<RayCast>() && frame.timings.both_ms > kLongestSweep_ms) {
        truth.note = "a sweep takes too long here to be made beside the picture";
        return truth;
    }
    const Stopwatch watch;
    if (!makeTruth(scene, views, time, way, &stop)) return std::nullopt;
    truth.cast_ms = watch.elapsed_ms();
    truth.error = errorOf(mTruth.left.color, mAsMade.empty() ? frame.right.color : mAsMade);
    return truth;
}

void TruthMaker::forget() {
    mTruth = {};
    mAsMade = {};
}

}  // namespace stereonav
