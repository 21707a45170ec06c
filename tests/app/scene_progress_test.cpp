// Scenes as they are opened, changed, measured, painted and lit: each of these tells its whole progress.
#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "app/output/stereo_frame.h"
#include "app/scene/file_glance.h"
#include "app/scene/quality.h"
#include "app/scene/scene_loading.h"
#include "app/scene/terrain/survey_ground.h"
#include "app/scene/volume/light.h"
#include "app/scene/volume/light_loading.h"
#include "app/scene/volume/volume_loading.h"
#include "app/scene/volume/world.h"
#include "app/view/loading.h"
#include "app/view/setting_texts.h"
#include "engine/scene/capabilities.h"
#include "engine/scene/flat_wall.h"
#include "engine/scene/line_measurer.h"
#include "engine/scene/shown_values.h"
#include "engine/scene/slices.h"
#include "engine/scene/surface_findings.h"
#include "engine/scene/wall_to_see.h"
#include "tests/app/volume_input.h"
#include "tests/support/whole_progress.h"

namespace stereonav::test {
namespace {

using Settings = std::vector<std::pair<const char*, SettingTexts>>;

class SceneProgress : public VolumeTest {
protected:
    void SetUp() override {
        VolumeTest::SetUp();
        mCacheBefore = std::getenv("XDG_CACHE_HOME");
        setenv("XDG_CACHE_HOME", (mFolder / "cache").c_str(), 1);
    }
    void TearDown() override {
        setenv("XDG_CACHE_HOME", mCacheBefore.c_str(), 1);
        VolumeTest::TearDown();
    }
    // A study with more voxels, so that a lumen has a wall to look at.
    std::string tubeStudy() const { return maskedTube(); }

    static std::unique_ptr<Scene> sceneOf(const SettingTexts& settings) {
        Progress quiet;
        return loadScene(viewOptionsOf(settings).scene, {64, 48}, quiet);
    }
    // Expects the scene to open as a picture and as a view has it.
    static void expectOpened(const SettingTexts& settings) {
        const ViewOptions options = viewOptionsOf(settings);
        SCOPED_TRACE(commandLineOf(settings));
        expectWholeProgress("loading", 0, [&](Progress& progress) {
            loadScene(options.scene, {64, 48}, progress);
        });
        for (const bool measure : {false, true})
            expectWholeProgress("opening", 0,
                                [&](Progress& progress) {
                                    openScene(options, measure, {64, 48}, nullptr, progress);
                                },
                                {0.9});
    }

    std::string mCacheBefore;
};

// What is small tells its begin and its end alone.
TEST_F(SceneProgress, IsWholeOfScenesThatAreOpened) {
    for (const std::string& scene : {hills(), tubeStudy(), std::string("wax")})
        expectOpened({{"SCENE", {scene}}});
}

TEST_F(SceneProgress, IsWholeOfWhatIsDoneOnGround) {
    for (const char* const tiles : {"off", "on"}) {
        const SettingTexts settings{{"SCENE", {hills()}}, {"tiles", {tiles}}};
        const SceneOptions options = viewOptionsOf(settings).scene;
        expectWholeProgress("a survey", 1, [&](Progress& progress) { loadSurveyGround(options, progress); });
        const auto scene = sceneOf(settings);
        expectWholeProgress(
            "a map", 5, [&](Progress& progress) { scene->offered<MapFromAbove>()->makeMap(30, progress); });
        const std::vector<glm::dvec3> places{{-200, -150, 0}, {210, -140, 0}, {30, 200, 0}};
        for (const bool closed : {false, true})
            expectWholeProgress("measuring", closed ? 1 : 0, [&](Progress& progress) {
                scene->offered<LineMeasurer>()->measure(places, closed, progress);
            });
        RayOptions rays;
        for (const char* const asked : {"", "quality"}) {
            SceneOptions wished = options;
            if (*asked) wished.quality.targetPsnr_db = 25;
            StereoFrame frame(*scene, "auto");
            if (*asked)
                expectWholeProgress("refining", 0,
                                    [&](Progress& progress) { frame.refine(wished, rays, progress); });
        }
    }
    SceneOptions builtIn;
    builtIn.scene = "terrain";
    expectWholeProgress("a survey of the built-in ground", 5,
                        [&](Progress& progress) { loadSurveyGround(builtIn, progress); });
}

TEST_F(SceneProgress, IsWholeOfWhatIsDoneInAColon) {
    const auto scene = sceneOf({{"SCENE", {maskedTube()}}});
    const auto& findings = *scene->offered<SurfaceFindings>();
    const SurfaceFinding one = findings.at(scene->startPose.position + glm::dvec3(0.007, 0, 0), "a");
    SurfaceFinding made;
    for (const bool again : {false, true})
        expectWholeProgress("measuring", again ? 0 : 1,
                            [&](Progress& progress) { made = findings.measured(one, nullptr, progress); });
    expectWholeProgress("looking for candidates", 0,
                        [&](Progress& progress) { findings.candidates(nullptr, progress); });
    for (const FindingRefs& list : {FindingRefs{}, FindingRefs{&made, &made}})
        expectWholeProgress("a page", 0,
                            [&](Progress& progress) { findings.pageOf(list, nullptr, progress); });
    expectWholeProgress("slices", 2,
                        [&](Progress& progress) { scene->offered<SliceSource>()->readSlices(progress); });
    expectWholeProgress("unfolding", 3,
                        [&](Progress& progress) { scene->offered<FlatWall>()->makeFlat(progress); }, {0.3});
    expectWholeProgress("a panorama", 5,
                        [&](Progress& progress) { scene->offered<FlatWall>()->makePanorama(progress); },
                        {0.3, 0.4});
    const auto& wall = *scene->offered<WallToSee>();
    expectWholeProgress("a wall to look at", 0, [&](Progress& progress) { wall.begin({}, progress); });
    Progress quiet;
    const auto seen = wall.begin({}, quiet);
    const EyeView eye = makeEyeView(scene->startPose, scene->lens);
    expectWholeProgress("looking at it", 1,
                        [&](Progress& progress) { seen->look(std::span(&eye, 1), progress); });
    expectWholeProgress("values", 1,
                        [&](Progress& progress) { scene->offered<ShownValues>()->values->count(progress); });
}

// All ways in which a volume's surface can be another one.
TEST_F(SceneProgress, IsWholeOfChangedSurfaces) {
    const SettingTexts settings{{"SCENE", {ball()}}, {"isosurface", {""}}, {"isovalue", {"300"}}};
    const ViewOptions options = viewOptionsOf(settings);
    Progress quiet;
    const OpenScene open = openScene(options, false, {64, 48}, nullptr, quiet);
    const SurfaceChoices& choices = *open.scene->offered<SurfaceChoices>();
    ASSERT_TRUE(choices.ambient);
    std::vector<SurfaceChange> changes(6);
    changes[1].isovalue = 600;
    changes[2].translucent = true;
    changes[3].translucent = true, changes[3].transfer = "metal";
    changes[4].ambient = choices.ambient, changes[4].ambient->lit = true;
    changes[5] = changes[2], changes[5].ambient = choices.ambient, changes[5].ambient->modulate = "gradient";
    for (const SurfaceChange& change : changes) {
        expectWholeProgress("changing", 0, [&](Progress& progress) { choices.changed(change, progress); });
        expectWholeProgress("opening it", 0,
                            [&](Progress& progress) { changedScene(open, change, options, progress); },
                            {0.9});
    }
}

}  // namespace
}  // namespace stereonav::test
