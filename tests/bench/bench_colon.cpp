// The colon's marks in one run: the left eye against Embree's packets on a mesh of the same wall,
// the distance transform against ITK's, the right eye against a full cast, opaque and translucent. On the
// generated colon, or on the study named. With --marks one JSON object is all that is printed.
#include <algorithm>
#include <cstdio>
#include <cstring>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "colon/scene/colon_scene.h"
#include "engine/base/parallel.h"
#include "engine/base/stopwatch.h"
#include "engine/simd/simd_target.h"
#include "engine/stereo/right_eye.h"
#include "engine/volume/volume_renderer.h"
#include "tests/bench/wall_mesh.h"
#if STEREONAV_COMPARE_ITK
#include <itkImage.h>
#include <itkMultiThreaderBase.h>
#include <itkSignedMaurerDistanceMapImageFilter.h>
#endif

namespace stereonav {
namespace {

constexpr int kWidth = 500, kHeight = 400, kViews = 8, kRuns = 5;

double leastTime_ms(const std::function<void()>& run, int runs = kRuns) {
    double least = 1e300;
    for (int n = 0; n < runs; ++n) {
        const Stopwatch watch;
        run();
        least = std::min(least, watch.elapsed_ms());
    }
    return least;
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

std::vector<StereoViews> viewsOf(const ColonScene& scene) {
    Lens lens = scene.lens;
    lens.width = kWidth;
    lens.height = kHeight;
    StereoSetting stereo = scene.stereo;
    stereo.separation = stereo.zeroParallax / 30;
    std::vector<StereoViews> views;
    for (const Pose& pose : scene.path.frames(kViews)) views.push_back(makeStereoViews(pose, lens, stereo));
    return views;
}

// Medians over the views; Embree's of the packet with which tracing and shading together are fastest.
struct LeftTimes {
    double ours_ms, trace_ms, shaded_ms;
    int embreeWidth;
};

LeftTimes timeLeft(const ColonScene& scene, const WallMesh& mesh) {
    const VolumeRenderer renderer(scene.volume);
    LeftTimes best{0, 0, 1e300, 0};
    for (const int width : bench::embreeWidths()) {
        std::vector<double> ours, trace, shaded;
        for (const StereoViews& views : viewsOf(scene)) {
            EyeImage image;
            image.resize(kWidth, kHeight, ViewDependence::Normal);
            ours.push_back(leastTime_ms([&] { renderEye(renderer, views.left, image); }));
            trace.push_back(leastTime_ms([&] { mesh.cast(views.left, width, image); }));
            shaded.push_back(leastTime_ms([&] {
                mesh.cast(views.left, width, image);
                for (int y = 0; y < kHeight; ++y) renderer.shadeAgain(views.left, y, 0, kWidth, image);
            }));
        }
        if (median(shaded) < best.shaded_ms) best = {median(ours), median(trace), median(shaded), width};
    }
    return best;
}

// The median over the views of the right eye's share of a full cast.
double rightShare(const ColonScene& scene, RightEyeMethod method) {
    const VolumeRenderer renderer(scene.volume);
    std::vector<double> shares;
    for (const StereoViews& views : viewsOf(scene)) {
        EyeImage left, right;
        left.resize(kWidth, kHeight, renderer.viewDependence());
        renderEye(renderer, views.left, left);
        RightEye eye;
        const auto time = [&](RightEyeMethod m) {
            WarpSetting setting;
            setting.method = m;
            double least = 1e300;
            for (int n = 0; n < kRuns; ++n)
                least = std::min(least, eye.render(renderer, views, left, setting, right).right_ms());
            return least;
        };
        shares.push_back(time(method) / time(RightEyeMethod::Full));
    }
    return median(shares);
}

#if STEREONAV_COMPARE_ITK
double itkTime_ms(const MaskVolume& mask) {
    using Mask = itk::Image<unsigned char, 3>;
    using Filter = itk::SignedMaurerDistanceMapImageFilter<Mask, itk::Image<float, 3>>;
    auto image = Mask::New();
    Mask::SizeType size;
    Mask::SpacingType spacing;
    for (int axis = 0; axis < 3; ++axis) {
        size[static_cast<unsigned>(axis)] = static_cast<unsigned>(mask.frame.size[axis]);
        spacing[static_cast<unsigned>(axis)] = mask.frame.spacing[axis];
    }
    image->SetRegions(size);
    image->SetSpacing(spacing);
    image->Allocate();
    for (std::size_t n = 0; n < mask.frame.count(); ++n)
        image->GetBufferPointer()[n] = mask.values[n] ? 0 : 1;
    itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(static_cast<unsigned>(threadCount()));
    return leastTime_ms(
        [&] {
            auto filter = Filter::New();
            filter->SetInput(image);
            filter->SquaredDistanceOff();
            filter->UseImageSpacingOn();
            filter->SetNumberOfWorkUnits(static_cast<unsigned>(threadCount()));
            filter->Update();
        },
        2);
}
#endif

// The lumen in a volume of the full size, as it lies in the study.
MaskVolume inFullSize(const MaskVolume& lumen, const glm::ivec3& size) {
    VolumeFrame frame = lumen.frame;
    frame.size = glm::max(size, lumen.frame.size);
    MaskVolume full(frame);
    const glm::ivec3 first = (frame.size - lumen.frame.size) / 2;
    for (int k = 0; k < lumen.frame.size.z; ++k)
        for (int j = 0; j < lumen.frame.size.y; ++j)
            std::memcpy(&full.at(first.x, first.y + j, first.z + k),
                        &lumen.values[lumen.frame.index(0, j, k)],
                        static_cast<std::size_t>(lumen.frame.size.x));
    return full;
}

int run(bool marksOnly, const std::string& study) {
    ColonOptions options;
    options.study = study;
    Progress progress;
    const ColonScene scene = loadColon(options, progress);
    const int threads = threadCount();
    nlohmann::ordered_json marks;

    setThreadCount(1);
    const Stopwatch building;
    const WallMesh mesh(scene.volume.cells);
    const double building_ms = building.elapsed_ms();
    const LeftTimes left = timeLeft(scene, mesh);
    setThreadCount(threads);
    marks["simd"] = nameOf(availableTarget(SimdTarget::Auto));
    marks["threads"] = threads;
    marks["left_vs_embree"] = left.shaded_ms / left.ours_ms;
    marks["embree_width"] = left.embreeWidth;

    const MaskVolume full = inFullSize(scene.lumen.lumen, {512, 512, 411});
    const double edt_ms = leastTime_ms([&] { distanceToOutside(full, false); });
#if STEREONAV_COMPARE_ITK
    const double itk_ms = itkTime_ms(full);
    marks["edt_vs_itk"] = itk_ms / edt_ms;
#endif
    marks["right_vs_full_opaque"] = rightShare(scene, RightEyeMethod::Linear);

    options.opacity = 0.95;
    const ColonScene glass = loadColon(options, progress);
    marks["right_vs_full_translucent"] = rightShare(glass, RightEyeMethod::Selective);
    if (marksOnly) {
        std::printf("%s\n", marks.dump().c_str());
        return 0;
    }
    std::printf("%s, %dx%d, medians of %d views, fastest of %d runs\n",
                std::string(nameOf(availableTarget(SimdTarget::Auto))).c_str(), kWidth, kHeight, kViews,
                kRuns);
    std::printf(
        "left eye, 1 thread: ours %.2f ms; Embree's packets of %d on %.2f million triangles (%.0f ms to make "
        "and build): %.2f ms to trace, %.2f with shading\n",
        left.ours_ms, left.embreeWidth, static_cast<double>(mesh.triangles()) / 1e6, building_ms,
        left.trace_ms, left.shaded_ms);
    std::printf("distance transform of %dx%dx%d, %d threads: %.0f ms\n", full.frame.size.x, full.frame.size.y,
                full.frame.size.z, threads, edt_ms);
    std::printf("translucent right eye: by linear %.3f of a full cast, by depthsplat %.3f\n",
                rightShare(glass, RightEyeMethod::Linear), rightShare(glass, RightEyeMethod::DepthSplat));
    std::printf("%s\n", marks.dump(2).c_str());
    return 0;
}

}  // namespace
}  // namespace stereonav

int main(int argc, char** argv) {
    bool marksOnly = false;
    std::string study;
    for (int n = 1; n < argc; ++n)
        if (std::strcmp(argv[n], "--marks") == 0)
            marksOnly = true;
        else
            study = argv[n];
    try {
        return stereonav::run(marksOnly, study);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "bench_colon: %s\n", error.what());
        return 1;
    }
}
