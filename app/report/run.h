// One run of `report`: its scenes, its time, and its results so far. Each part of the report is a function
// that measures within its share of the time and adds a section.
#pragma once

#include <string>
#include <vector>

#include "app/report/model.h"
#include "app/report/mood.h"
#include "app/report/report_options.h"
#include "app/report/untimed.h"
#include "app/scene/scene_loading.h"
#include "colon/scene/colon_scene.h"
#include "engine/base/progress.h"
#include "engine/base/stopwatch.h"
#include "engine/scene/capabilities.h"
#include "terrain/scene/terrain_scene.h"

namespace stereonav {

// Returns the colon or volume; null for scenes of other types.
inline const ColonScene* colonOf(const Scene& scene) {
    return scene.offered<const ColonScene>();
}
inline const TerrainScene* terrainOf(const Scene& scene) {
    return scene.offered<const TerrainScene>();
}

struct ReportScene {
    std::string id, title;  // `id` is part of the figures' ids
    SceneOptions options;
    std::unique_ptr<Scene> scene;
    double load_ms = 0;
    std::unique_ptr<EyeRenderer> faulty;       // renderer with deliberate faults (faults.h); null: none
    std::unique_ptr<FrameMaker> faultyFrames;  // frames made with `faulty`

    const Scene& loaded() const { return *scene; }
    // Returns the maker of all frames of the scene.
    FrameMaker& frames() const { return faultyFrames ? *faultyFrames : scene->frames(); }
    // Returns the maker of right eyes from one left eye, for scenes of ReportRun::scenes().
    RightFromLeft& rightFromLeft() const { return *frames().rightFromLeft(); }
};

// Time of a whole run in seconds: 10 minutes or 60 s, less a reserve for writing and a slow end.
constexpr double kFullReport_s = 540, kQuickReport_s = 50;

class ReportRun {
public:
    ReportRun(const ReportOptions& options, Progress& progress);

    const ReportOptions& options() const { return mOptions; }
    bool quick() const { return mOptions.quick; }
    Report& report() { return mReport; }
    std::vector<ReportScene>& scenes() { return mScenes; }  // scenes whose rays are cast
    std::vector<ReportScene>& media() { return mMedia; }    // scenes that are swept

    // Return a scene by its index in these lists, which are the same in all processes of a run: processes
    // that do not measure load a scene once a piece of work needs it.
    ReportScene& castScene(std::size_t index);
    ReportScene& medium(std::size_t index);
    std::size_t indexOf(const ReportScene& scene) const;

    // Returns whether to measure less: in a quick run, and in parts of a full one that begin late.
    bool brief() const { return quick() || mBehind; }
    int pick(int whenBrief, int whenFull) const { return brief() ? whenBrief : whenFull; }
    // Begins a part with `seconds` left, of `planned`.
    void begin(const std::string& part, double seconds, double planned);
    // Removes the results of the present part, which is not complete.
    void dropPart();
    // Makes the rest of the part brief where its time is up; to be called between charts.
    void checkTime();
    double elapsed_s() const { return mWatch.elapsed_ms() / 1000; }

    // Returns the seconds that the next part may take: the share `weight` / `weights` of the remaining time,
    // where `weights` is the sum for this part and all after it.
    double share_s(double weight, double weights) const;
    double whole_s() const;
    const std::vector<std::string>& hurriedParts() const { return mHurried; }
    // Reports the present work. Throws Cancelled.
    void tell(const std::string& what);

    // Returns the work that all processes of the run share.
    UntimedWork& untimed() { return mUntimed; }

    // Measures the fixed work that shows how steady the machine is.
    void feelMood() { mMood_ms.push_back(fixedWork_ms()); }
    const std::vector<double>& mood_ms() const { return mMood_ms; }

    // Returns "500x400, 2 threads": the setting of all figures of that size.
    std::string settingOf(int width, int height) const;
    // Returns the setting for a scene under a lens; with "..., refraction 0.13" for a round Earth.
    std::string settingOf(const Scene& scene, const Lens& lens) const;
    std::string settingOf(const Scene& scene) const { return settingOf(scene, scene.lens); }

private:
    const ReportOptions& mOptions;
    Progress& mProgress;
    Stopwatch mWatch;
    Report mReport;
    std::vector<double> mMood_ms;
    bool mBehind = false;
    double mPartEnd_s = 0;  // end of the present part
    std::size_t mFiguresBefore = 0, mSectionsBefore = 0;
    std::string mPart;
    std::vector<std::string> mHurried;  // parts that began late
    std::vector<ReportScene> mScenes, mMedia;
    UntimedWork mUntimed{*this};
};

// Loads the built-in scenes and those that were named, colons with an opaque and a translucent wall; of media
// the cloud, in a full run, and those that were named. A scene that is named twice, or is built in, is loaded
// once.
void loadReportScenes(ReportRun& run, bool surfaces, bool media);

// Returns the options for a scene of that name: as `compare` shows it, with the report's options for all
// scenes of its type.
SceneOptions sceneOptionsFor(const ReportOptions& report, const std::string& name);

// Returns whether the scene is a study in files: not the built-in colon. Throws Error for an unknown name.
bool isStudy(const std::string& name);

// Measure the parts, in the order of the page.
void reportRightEye(ReportRun& run, double seconds);
void reportFelt(ReportRun& run, double seconds);
void reportLate(ReportRun& run, double seconds);
void reportCasting(ReportRun& run, double seconds);
void reportLight(ReportRun& run, double seconds);
void reportOcclusion(ReportRun& run, double seconds);
void reportMedium(ReportRun& run, double seconds);
void reportQuality(ReportRun& run, double seconds);
void reportPlan(ReportRun& run, double seconds);
void reportStages(ReportRun& run, double seconds);
void reportScenes(ReportRun& run, double seconds);
void reportStability(ReportRun& run, double seconds);
// Return charts for sections of other parts: on casting, volume light, and quality by target.
WayChart filteringChart(ReportRun& run, const ReportScene& terrain);
WayChart normalsChart(ReportRun& run);
WayChart shadingWidthChart(ReportRun& run);
WayChart edgeChart(ReportRun& run, const ReportScene& scene);
void reportPairs(ReportRun& run, ReportSection& section);

}  // namespace stereonav
