// The report's part on the cost of each scene: its frame plan, its memory, and the cost of single features;
// and the stability table.
#include <fmt/format.h>
#include <link.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "app/report/run.h"
#include "app/report/stability.h"
#include "app/scene/frame_facts.h"
#include "engine/base/file.h"
#include "engine/base/parallel.h"
#include "engine/camera/default_eyes.h"
#include "engine/frame/cast_frames.h"
#include "engine/metrics/image_difference.h"
#include "engine/volume/volume_renderer.h"

namespace stereonav {
namespace {

int librariesInMemory() {
    int count = 0;
    dl_iterate_phdr(
        [](dl_phdr_info* info, std::size_t, void* data) {
            *static_cast<int*>(data) += info->dlpi_name != nullptr && info->dlpi_name[0] != '\0';
            return 0;
        },
        &count);
    return count;
}

ReportTable sceneTable(ReportRun& run, const ReportScene& scene) {
    run.tell("frame plan, " + scene.title);
    const FramePlan plan = planScene(scene.loaded()).value();
    ReportTable table{scene.title, "", {"", "what was read and what a frame holds"}, {}};
    for (auto& [label, text] : rowsOf(scene.loaded().describe())) table.rows.push_back({label, text});
    table.rows.push_back({"loading", fmt::format("{:.0f} ms", scene.load_ms)});
    table.rows.push_back({"planes", planesText(plan)});
    table.rows.push_back({"frame", fmt::format("{:.1f} MB at {}x{}", static_cast<double>(plan.bytes) / 1e6,
                                               plan.width, plan.height)});
    table.rows.push_back({"right eye", fmt::format("{}: {}", nameOf(plan.method), plan.reason)});
    addFigure(run.report(), {fmt::format("scene/{}/loading", scene.id), "ms", "", ReportFigure::Kind::Other,
                             exactly(scene.load_ms)});
    addFigure(run.report(), {fmt::format("scene/{}/frame bytes", scene.id), "bytes", "",
                             ReportFigure::Kind::Other, exactly(static_cast<double>(plan.bytes))});
    return table;
}

struct Feature {
    const char* name;
    VolumeCasting off;
};

// Returns a row for frames with and without a feature: left and right eye, memory, and the right eye's error.
std::vector<std::string> rowOf(ReportRun& run, const ReportScene& scene, const char* name, FrameMaker& frames,
                               ViewDependence dependence) {
    StereoSetting stereo = scene.loaded().stereo;
    stereo.separation = stereo.zeroParallax / kUsualParts;
    const StereoViews views = makeStereoViews(scene.loaded().startPose, scene.loaded().lens, stereo);
    EyePair made;
    EyeImage full;
    double left_ms = 1e300, right_ms = 1e300;
    for (int n = 0; n < run.pick(3, 9); ++n) {
        run.tell("features, " + scene.title);
        frames.make(views, 0, {}, made);
        left_ms = std::min(left_ms, made.timings.left_ms);
        right_ms = std::min(right_ms, made.timings.right_ms);
    }
    frames.rightFromLeft()->makeRight(views, made.left, {frames.exactMethod(), {}}, full);
    const double bytes = static_cast<double>(frameBytes(full.width(), full.height(), dependence));
    return {scene.title,
            name,
            fmt::format("{:.2f}", left_ms),
            fmt::format("{:.2f}", right_ms),
            fmt::format("{:.1f}", psnrOf(full.color, made.right.color)),
            fmt::format("{:.1f}", bytes / 1e6)};
}

// Returns a row for the same scene, cast another way.
std::vector<std::string> rowOf(ReportRun& run, const ReportScene& scene, const char* name,
                               const VolumeRenderer& renderer) {
    CastFrames frames(renderer);
    return rowOf(run, scene, name, frames, renderer.viewDependence());
}

ReportTable featureTable(ReportRun& run) {
    ReportTable table{"Single features, off and on",
                      "The start pose; the least times of some repeats; the right eye by the default way, "
                      "against the same scene's full cast (100 dB: identical).",
                      {"scene", "feature", "left ms", "right ms", "right PSNR dB", "planes MB"},
                      {}};
    for (const ReportScene& scene : run.scenes()) {
        table.rows.push_back(
            rowOf(run, scene, "as it is", scene.frames(), rendererOf(scene.loaded()).viewDependence()));
        if (!colonOf(scene.loaded())) continue;
        VolumeCasting casting;
        casting.leaping = false;
        table.rows.push_back(rowOf(run, scene, "without leaping over empty cells",
                                   VolumeRenderer(colonOf(scene.loaded())->volume, casting)));
        casting = {};
        casting.shadeAgain = false;
        if (!rendererOf(scene.loaded()).translucent())
            table.rows.push_back(rowOf(run, scene, "without shading again for the right eye",
                                       VolumeRenderer(colonOf(scene.loaded())->volume, casting)));
    }
    return table;
}

}  // namespace

void reportScenes(ReportRun& run, double) {
    ReportSection section{"left-out", "What each scene left out", "", {}};
    section.text = fmt::format(
        "Planes, memory and stages that a scene does not need are neither allocated nor run. This report "
        "holds all its scenes at once: {} threads, {} shared libraries loaded. stereonav info SCENE tells "
        "the same of one scene alone.",
        threadCount(), librariesInMemory());
    for (const ReportScene& scene : run.scenes()) section.blocks.emplace_back(sceneTable(run, scene));
    run.checkTime();
    section.blocks.emplace_back(featureTable(run));
    run.report().sections.push_back(std::move(section));
}

void reportStability(ReportRun& run, double) {
    run.tell("stability rows");
    const std::filesystem::path file = run.options().stability.empty()
                                           ? stabilityRowsOfThisBuild()
                                           : std::filesystem::path(run.options().stability);
    run.report().sections.push_back(file.empty() ? noStabilitySection()
                                                 : stabilitySection(readTextFile(file), file.string()));
}

}  // namespace stereonav
