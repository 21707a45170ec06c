// Scenes there and back: a frame knows nothing of the frames, lights, models and surfaces that were shown
// before it. Bit for bit, both eyes.
#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "app/scene/scene_loading.h"
#include "app/view/setting_texts.h"
#include "engine/scene/capabilities.h"
#include "engine/scene/live_paint.h"
#include "engine/scene/surface_paint.h"
#include "tests/app/volume_input.h"

namespace stereonav::test {
namespace {

constexpr const char* kThin =
    "curve:reference_mm:2,100:0.9:0.6:0.5:0,400:0.9:0.6:0.5:0.2,900:0.6:0.7:0.9:0.6";

class SceneDetours : public VolumeTest {
protected:
    std::shared_ptr<Scene> opened(const SettingTexts& settings) const {
        Progress progress;
        return loadScene(viewOptionsOf(settings).scene, {64, 48}, progress);
    }
    struct Look {
        Pose pose;
        StereoSetting stereo;
        std::string_view method = {};
        double time = 0;
    };
    static Look homeOf(const Scene& scene) { return {scene.startPose, scene.stereo}; }
    static EyePair pictureOf(const Scene& scene, const Look& look, int width = 64) {
        if (auto* const paint = scene.offered<LivePaint>()) paint->takeUp();
        Lens lens = scene.lens;
        lens.width = width;
        lens.height = 48;
        const StereoViews views = makeStereoViews(look.pose, lens, look.stereo);
        EyePair frame;
        scene.frames().make(views, look.time, {look.method}, frame);
        paintEyes(scene, views, frame);
        return frame;
    }
    static std::size_t differing(const EyePair& a, const EyePair& b) {
        std::size_t count = 0;
        for (const auto& [one, other] :
             {std::pair(&a.left.color, &b.left.color), {&a.right.color, &b.right.color}}) {
            if (one->width() != other->width()) return std::size_t(one->width()) * one->height();
            for (int y = 0; y < one->height(); ++y)
                for (int x = 0; x < one->width(); ++x) count += one->at(x, y) != other->at(x, y);
        }
        return count;
    }
    struct Detour {
        const char* name;
        std::function<void()> there, back;
    };
    // All of what the scene offers to be changed between frames.
    static std::vector<Detour> detoursOf(const Scene& scene) {
        std::vector<Detour> all;
        if (auto* const light = scene.offered<TurningLight>()) {
            const SunPlace home = light->place();
            all.push_back({"light",
                           [=] {
                               light->turnTo({home.azimuth + 1, home.elevation * 0.5 + 0.2});
                           },
                           [=] { light->turnTo(home); }});
        }
        if (auto* const models = scene.offered<LightModels>(); models && models->names().size() > 1) {
            const int home = models->now();
            all.push_back(
                {"model", [=] { models->choose(home == 0 ? 1 : 0); }, [=] { models->choose(home); }});
        }
        if (auto* const effort = scene.offered<FrameEffort>())
            all.push_back({"effort", [=] { effort->setEffort(0.4); }, [=] { effort->setEffort(1); }});
        if (auto* const paint = scene.offered<LivePaint>(); paint && paint->takes("contours", "9"))
            all.push_back(
                {"contours", [=] { paint->ask("contours", "9"); }, [=] { paint->ask("contours", ""); }});
        return all;
    }
    static void expectNothingRemembered(const Scene& scene) {
        const Look home = homeOf(scene);
        const EyePair before = pictureOf(scene, home);
        ASSERT_EQ(differing(pictureOf(scene, home), before), 0u) << "the same again";
        const auto expectAsBefore = [&](const std::string& what) {
            EXPECT_EQ(differing(pictureOf(scene, home), before), 0u) << what;
        };
        for (const Detour& detour : detoursOf(scene)) {
            detour.there();
            const EyePair there = pictureOf(scene, home);
            EXPECT_GT(differing(there, before), 0u) << detour.name << " is seen";
            detour.back();
            expectAsBefore(detour.name);
            detour.there();
            EXPECT_EQ(differing(pictureOf(scene, home), there), 0u) << detour.name << " once more";
            detour.back();
            expectAsBefore(std::string(detour.name) + " twice");
        }
        Look aside = home;
        aside.pose.position += 0.2 * home.stereo.zeroParallax * home.pose.right();
        const EyePair seenAside = pictureOf(scene, aside);
        EXPECT_GT(differing(seenAside, before), 0u);
        expectAsBefore("from elsewhere");
        EXPECT_EQ(differing(pictureOf(scene, aside), seenAside), 0u) << "elsewhere once more";
        Look apart = home;
        apart.stereo.separation *= 3;
        pictureOf(scene, apart);
        expectAsBefore("eyes further apart");
        for (const std::string_view method : scene.frames().methods()) {
            Look other = home;
            other.method = method;
            pictureOf(scene, other);
            expectAsBefore(std::string(method));
        }
        pictureOf(scene, home, 35);
        expectAsBefore("another size");
        EyePair one;
        Lens lens = scene.lens;
        lens.width = 64, lens.height = 48;
        scene.frames().makeOne(makeEyeView(aside.pose, lens), 0, one);
        expectAsBefore("one eye");
        Look later = home;
        later.time = 3;
        pictureOf(scene, later);
        expectAsBefore("at another time");
    }
};

TEST_F(SceneDetours, OfGround) {
    for (const SettingTexts& more : {SettingTexts{}, {{"level-of-detail", {"0.5"}}}, {{"curvature", {""}}}}) {
        SettingTexts settings{{"SCENE", {hills()}}};
        settings.insert(more.begin(), more.end());
        SCOPED_TRACE(commandLineOf(settings));
        const auto scene = opened(settings);
        EXPECT_FALSE(detoursOf(*scene).empty());
        expectNothingRemembered(*scene);
    }
}

TEST_F(SceneDetours, OfVolumes) {
    const std::string around = ball();
    for (const SettingTexts& more : {SettingTexts{}, {{"transfer", {kThin}}}, {{"ambient", {"8"}}}}) {
        SettingTexts settings{{"SCENE", {around}}, {"isosurface", {""}}, {"isovalue", {"300"}}};
        settings.insert(more.begin(), more.end());
        SCOPED_TRACE(commandLineOf(settings));
        expectNothingRemembered(*opened(settings));
    }
    SettingTexts inside{{"SCENE", {maskedTube()}}, {"no-cache", {""}}};
    expectNothingRemembered(*opened(inside));
}

}  // namespace
}  // namespace stereonav::test
