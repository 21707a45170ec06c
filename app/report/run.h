// One run of `report`: its scenes, its time, and what it has found so far. Each part of the report is a
// function that measures within its share of the time and adds a section.
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

// Null where the scene is made of something else.
inline const ColonScene* colonOf(const Scene& scene) {
    return scene.offered<const ColonScene>();
}
inline const TerrainScene* terrainOf(const Scene& scene) {
    return scene.offered<const TerrainScene>();
}

struct ReportScene {
    std::string id, title;  // the id is part of figures' ids
    SceneOptions options;
    std::unique_ptr<Scene> scene;
    double load_ms = 0;
    std::unique_ptr<EyeRenderer> faulty;       // with deliberate faults (faults.h); null: without
    std::unique_ptr<FrameMaker> faultyFrames;  // ... that are made with it

    const Scene& loaded() const { return *scene; }
    // What all frames of it are made by.
    FrameMaker& frames() const { return faultyFrames ? *faultyFrames : scene->frames(); }
    // ... of which one left eye and many right ones are wanted: of ReportRun::scenes().
    RightFromLeft& rightFromLeft() const { return *frames().rightFromLeft(); }
};

// The whole time of a run: full 10 minutes, quick 60 s, less what writing and a slow end may take.
constexpr double kFullReport_s = 540, kQuickReport_s = 50;

class ReportRun {
public:
    ReportRun(const ReportOptions& options, Progress& progress);

    const ReportOptions& options() const { return mOptions; }
    bool quick() const { return mOptions.quick; }
    Report& report() { return mReport; }
    std::vector<ReportScene>& scenes() { return mScenes; }  // whose rays are cast
    std::vector<ReportScene>& media() { return mMedia; }    // that are swept

    // By their places in these lists, which all processes of a run have alike: those that do not measure load
    // theirs once a piece of work needs them.
    ReportScene& castScene(std::size_t index);
    ReportScene& medium(std::size_t index);
    std::size_t indexOf(const ReportScene& scene) const;

    // Less is measured in a quick run, and in parts of a full one that begin behind their time.
    bool brief() const { return quick() || mBehind; }
    int pick(int whenBrief, int whenFull) const { return brief() ? whenBrief : whenFull; }
    // Begins a part that `seconds` are left for, of `planned`.
    void begin(const std::string& part, double seconds, double planned);
    // Takes back what the part at hand has found, which is not done.
    void dropPart();
    // Between charts: from here on the part is brief where its time is up.
    void checkTime();
    double elapsed_s() const { return mWatch.elapsed_ms() / 1000; }

    // Seconds that the next part may take: `weight` of what is left, `weights` being that of this part and
    // all after it.
    double share_s(double weight, double weights) const;
    double whole_s() const;
    const std::vector<std::string>& hurriedParts() const { return mHurried; }
    // Tells what is done now. Throws Cancelled.
    void tell(const std::string& what);

    // What all processes of the run make together.
    UntimedWork& untimed() { return mUntimed; }

    // Does the fixed work that the machine's mood is told by.
    void feelMood() { mMood_ms.push_back(fixedWork_ms()); }
    const std::vector<double>& mood_ms() const { return mMood_ms; }

    // "500x400, 2 threads": what all figures of that size share.
    std::string settingOf(int width, int height) const;
    // The same of a scene as the lens shows it, "..., refraction 0.13" where its Earth is round.
    std::string settingOf(const Scene& scene, const Lens& lens) const;
    std::string settingOf(const Scene& scene) const { return settingOf(scene, scene.lens); }

private:
    const ReportOptions& mOptions;
    Progress& mProgress;
    Stopwatch mWatch;
    Report mReport;
    std::vector<double> mMood_ms;
    bool mBehind = false;
    double mPartEnd_s = 0;  // of the part at hand
    std::size_t mFiguresBefore = 0, mSectionsBefore = 0;
    std::string mPart;
    std::vector<std::string> mHurried;  // parts that were behind
    std::vector<ReportScene> mScenes, mMedia;
    UntimedWork mUntimed{*this};
};

// The built-in scenes and those that were named, each with its colon's wall opaque and translucent; of media
// the cloud, in a full run, and those that were named. A scene that is named twice, or built in, comes once.
void loadReportScenes(ReportRun& run, bool surfaces, bool media);

// What a scene of that name is loaded by: as `compare` shows it, but for what the report says of all such.
SceneOptions sceneOptionsFor(const ReportOptions& report, const std::string& name);

// From files: not the built-in colon. Throws Error for a name of nothing.
bool isStudy(const std::string& name);

// The parts, in the order of the page.
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
// Charts that stand in sections of others: of casting, of volume light, and of quality by wish.
WayChart filteringChart(ReportRun& run, const ReportScene& terrain);
WayChart normalsChart(ReportRun& run);
WayChart shadingWidthChart(ReportRun& run);
WayChart edgeChart(ReportRun& run, const ReportScene& scene);
void reportPairs(ReportRun& run, ReportSection& section);

}  // namespace stereonav
