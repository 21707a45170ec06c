#include "app/report/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "app/options/parsed_options.h"
#include "app/report/faults.h"
#include "app/scene/scene_type_table.h"
#include "app/scene/shown_as.h"
#include "app/scene/volume/inside.h"
#include "engine/base/parallel.h"
#include "engine/frame/cast_frames.h"

namespace stereonav {
namespace {

constexpr int kReportWidth = 500, kReportHeight = 400;  // size in Wan et al. 2004
constexpr double kWallOpacity = 0.95;                   // per millimetre, as in Wan et al. 2004

void loadOne(ReportRun& run, const std::string& id, const std::string& title, const SceneOptions& options) {
    run.tell("loading " + title);
    Progress quiet([&](double, const std::string&) { run.tell("loading " + title); });
    const Stopwatch watch;
    ReportScene scene;
    scene.id = id;
    scene.title = title;
    scene.options = options;
    scene.scene = loadScene(options, {kReportWidth, kReportHeight}, quiet);
    scene.load_ms = watch.elapsed_ms();
    RayCast* const rays = scene.loaded().offered<RayCast>();
    std::vector<ReportScene>& list = rays ? run.scenes() : run.media();
    if (rays) scene.faulty = withFaults(*rays->renderer);
    if (scene.faulty) {
        rays->renderer = scene.faulty.get();
        scene.faultyFrames = std::make_unique<CastFrames>(*scene.faulty);
    }
    list.push_back(std::move(scene));
}

void loadWithGlass(ReportRun& run, const std::string& id, SceneOptions options) {
    loadOne(run, id, id, options);
    const Scene& scene = run.scenes().back().loaded();
    if (!scene.offered<const ColonInterior>() || rendererOf(scene).translucent()) return;
    options.volume.opacity = kWallOpacity;
    loadOne(run, id + " translucent", id + ", translucent", options);
}

bool isOneOf(const std::string& name, SceneSet types) {
    const std::string scene = sceneOptionsOf(name, sceneTypeOf).scene;
    return (sceneTypeNamed(scene).optionsFor(scene) & types) != 0;
}

// Returns the last part of the name, with a number where another scene has it.
std::string idOf(const std::string& name, const std::vector<ReportScene>& scenes) {
    const std::filesystem::path path(name);
    const std::string stem =
        path.has_filename() ? path.filename().string() : path.parent_path().filename().string();
    std::string id = stem;
    const auto taken = [&] {
        return std::any_of(scenes.begin(), scenes.end(), [&](const ReportScene& s) { return s.id == id; });
    };
    for (int n = 2; taken(); ++n) id = fmt::format("{} {}", stem, n);
    return id;
}

}  // namespace

ReportRun::ReportRun(const ReportOptions& options, Progress& progress)
    : mOptions(options), mProgress(progress) {
    mReport.quick = options.quick;
}

ReportScene& ReportRun::castScene(std::size_t index) {
    if (mScenes.empty()) loadReportScenes(*this, true, false);
    return mScenes.at(index);
}

ReportScene& ReportRun::medium(std::size_t index) {
    if (mMedia.empty()) loadReportScenes(*this, false, true);
    return mMedia.at(index);
}

std::size_t ReportRun::indexOf(const ReportScene& scene) const {
    const std::vector<ReportScene>& list = scene.loaded().offered<RayCast>() ? mScenes : mMedia;
    return static_cast<std::size_t>(&scene - list.data());
}

double ReportRun::whole_s() const {
    return mOptions.minutes ? 60 * *mOptions.minutes : quick() ? kQuickReport_s : kFullReport_s;
}

double ReportRun::share_s(double weight, double weights) const {
    return std::max(0.0, whole_s() - mWatch.elapsed_ms() / 1000) * weight / weights;
}

void ReportRun::begin(const std::string& part, double seconds, double planned) {
    constexpr double kBehind = 0.5;
    mPart = part;
    mFiguresBefore = mReport.figures.size();
    mSectionsBefore = mReport.sections.size();
    mPartEnd_s = elapsed_s() + seconds;
    mBehind = !quick() && seconds < kBehind * planned;
    if (mBehind) mHurried.push_back(part);
}

void ReportRun::dropPart() {
    mReport.figures.resize(mFiguresBefore);
    mReport.sections.resize(mSectionsBefore);
}

void ReportRun::checkTime() {
    if (brief() || elapsed_s() <= mPartEnd_s) return;
    mBehind = true;
    mHurried.push_back("the rest of " + mPart);
}

void ReportRun::tell(const std::string& what) {
    mProgress.report(std::min(0.99, mWatch.elapsed_ms() / 1000 / std::max(whole_s(), 1.0)), what);
}

std::string ReportRun::settingOf(int width, int height) const {
    const int threads = threadCount();
    return fmt::format("{}x{}, {} thread{}", width, height, threads, threads == 1 ? "" : "s");
}

std::string ReportRun::settingOf(const Scene& scene, const Lens& lens) const {
    const TerrainScene* terrain = terrainOf(scene);
    return settingOf(lens.width, lens.height) +
           (terrain && terrain->refraction ? fmt::format(", refraction {:.6g}", *terrain->refraction) : "");
}

bool isStudy(const std::string& name) {
    return isOneOf(name, scene_type::kStudies);
}

SceneOptions sceneOptionsFor(const ReportOptions& report, const std::string& name) {
    SceneOptions options = sceneOptionsOf(name, sceneTypeOf);
    options.threads = report.threads;  // the same for all scenes
    if (report.up && isStudy(name)) options.volume.up = report.up;
    if (report.curvature && isOneOf(name, scene_type::kTerrain) && !shownAs(options).swept) {
        options.curvature = true;
        options.refraction = report.refraction;
    }
    return options;
}

void loadReportScenes(ReportRun& run, bool surfaces, bool media) {
    std::vector<std::string> names{"terrain", "colon"};
    if (!run.quick()) names.emplace_back("cloud");
    for (const std::string& name : run.options().scenes)
        if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    for (const std::string& name : names) {
        const SceneOptions options = sceneOptionsFor(run.options(), name);
        const bool medium = shownAs(options).swept;
        const std::string id = idOf(name, medium ? run.media() : run.scenes());
        if (medium && media) loadOne(run, id, id, options);
        if (!medium && surfaces) loadWithGlass(run, id, options);
    }
}

}  // namespace stereonav
