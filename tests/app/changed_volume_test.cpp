// A volume whose function, isovalue and light are changed while it is shown is, bit for bit, the one that
// options make: light and cells that were made beforehand follow each change.
#include <gmock/gmock.h>

#include "app/scene/scene_loading.h"
#include "app/scene/volume/shown_volume.h"
#include "app/view/setting_texts.h"
#include "engine/base/error.h"
#include "engine/scene/capabilities.h"
#include "engine/scene/shown_values.h"
#include "tests/app/volume_input.h"

namespace stereonav::test {
namespace {

constexpr const char* kGlass =
    "curve:reference_mm:2,100:0.9:0.6:0.5:0,400:0.9:0.6:0.5:0.2,900:0.6:0.7:0.9:0.6";

class ChangedVolume : public VolumeTest {
protected:
    std::shared_ptr<Scene> opened(SettingTexts settings) const {
        const ViewOptions options = viewOptionsOf(settings);
        Progress progress;
        return loadScene(options.scene, {96, 72}, progress);
    }
    static std::shared_ptr<Scene> changed(const Scene& scene, const SurfaceChange& change) {
        Progress progress;
        auto next = scene.offered<SurfaceChoices>()->changed(change, progress);
        return next;
    }
    static std::shared_ptr<Scene> through(const Scene& scene, const std::string& transfer) {
        SurfaceChange change;
        change.translucent = true;
        change.transfer = transfer;
        change.ambient = scene.offered<SurfaceChoices>()->ambient;
        return changed(scene, change);
    }
    // Returns the scene's eyes, seen from where the first scene is.
    static EyePair pictureOf(Scene& scene, const Scene& from) {
        Lens lens = from.lens;
        lens.width = 96;
        lens.height = 72;
        EyePair frame;
        scene.frames().make(makeStereoViews(from.startPose, lens, from.stereo), 0, {}, frame);
        return frame;
    }
    static std::size_t differing(const Plane<PackedColor>& a, const Plane<PackedColor>& b) {
        std::size_t count = 0;
        for (int y = 0; y < a.height(); ++y)
            for (int x = 0; x < a.width(); ++x) count += a.at(x, y) != b.at(x, y);
        return count;
    }
    static void expectSame(Scene& scene, Scene& other) {
        const EyePair a = pictureOf(scene, other), b = pictureOf(other, other);
        EXPECT_EQ(differing(a.left.color, b.left.color), 0u);
        EXPECT_EQ(differing(a.right.color, b.right.color), 0u);
    }
    static void expectOther(Scene& scene, Scene& other) {
        EXPECT_GT(differing(pictureOf(scene, other).left.color, pictureOf(other, other).left.color), 200u);
    }
};

TEST_F(ChangedVolume, ShowsACurveAsTheCommandLineDoes) {
    // One after another, with and without another range of values that are seen.
    const std::vector<std::string> steps{
        kGlass,
        "curve:reference_mm:2,100:0.9:0.6:0.5:0,400:0.9:0.2:0.5:0.4,900:0.6:0.7:0.9:0.6",
        "curve:reference_mm:2,100:0.9:0.6:0.5:0,500:0.9:0.2:0.5:0.4,900:0.6:0.7:0.9:0.1",
        "curve:reference_mm:2,300:0.9:0.6:0.5:0,500:0.9:0.2:0.5:0.4,900:0.6:0.7:0.9:0",
        "curve:reference_mm:0.5,300:0.9:0.6:0.5:0,500:0.9:0.2:0.5:0.01",
        "curve:700:1:1:1:0.5"};
    const auto options = [&](const std::string& file, const SettingTexts& more) {
        // The key light stays where the first scene was seen from; another one is opened from elsewhere.
        SettingTexts settings{{"SCENE", {file}}, {"no-cache", {""}}, {"look", {"plain"}}};
        settings.insert(more.begin(), more.end());
        return settings;
    };
    const std::string around = ball(), tube = maskedTube();
    for (const SettingTexts& first :
         {options(around, {{"isosurface", {""}}, {"isovalue", {"300"}}}),
          options(around, {{"isosurface", {""}}, {"isovalue", {"300"}}, {"opacity", {"0.5"}}}),
          options(around, {{"isosurface", {""}},
                           {"isovalue", {"300"}},
                           {"transfer", {kGlass}},
                           {"modulate", {"variance"}}}),
          options(around, {{"isosurface", {""}}, {"isovalue", {"300"}}, {"ambient", {"8"}}}),
          options(tube, {})}) {
        std::shared_ptr<Scene> shown = opened(first);
        EyePair last = pictureOf(*shown, *shown);
        for (const std::string& step : steps) {
            SCOPED_TRACE(commandLineOf(first) + " then " + step);
            shown = through(*shown, step);
            SettingTexts said = first;
            setText(said, "transfer", step);
            expectSame(*shown, *opened(said));
            EXPECT_EQ(shown->offered<SurfaceChoices>()->transfer, step);
            EXPECT_EQ(shown->offered<ShownValues>()->function,
                      opened(said)->offered<ShownValues>()->function);
        }
    }
}

TEST_F(ChangedVolume, GoesBackToWhatItWasOpenedWith) {
    const SettingTexts first{{"SCENE", {ball()}}, {"isosurface", {""}}, {"transfer", {kGlass}}};
    const std::shared_ptr<Scene> opaque = opened({{"SCENE", {ball()}}, {"isosurface", {""}}}),
                                 shown = opened(first);
    expectOther(*opaque, *shown);
    expectSame(*through(*through(*shown, "metal"), ""), *shown);
    const std::shared_ptr<Scene> metal = through(*shown, "metal");
    const ShownValues& begun = *metal->offered<ShownValues>();
    EXPECT_EQ(begun.begun.transfer, kGlass);
    EXPECT_TRUE(begun.begun.translucent && begun.begun.isovalueChosen);
    EXPECT_EQ(begun.values, shown->offered<ShownValues>()->values) << "counted once";
}

TEST_F(ChangedVolume, ThatShowsNothingShowsTheBackground) {
    const std::shared_ptr<Scene> shown =
        opened({{"SCENE", {ball()}}, {"isosurface", {""}}, {"isovalue", {"300"}}});
    for (const char* nothing : {"curve:0:1:1:1:0,1000:1:1:1:0", "curve:5000:1:1:1:0,6000:1:1:1:1"}) {
        const std::shared_ptr<Scene> empty = through(*shown, nothing);
        const EyePair frame = pictureOf(*empty, *shown);
        for (int y = 0; y < 72; ++y)
            for (int x = 0; x < 96; ++x)
                ASSERT_EQ(frame.left.color.at(x, y), frame.left.color.at(0, 0)) << nothing;
        expectSame(*through(*empty, kGlass), *through(*shown, kGlass));
    }
}

TEST_F(ChangedVolume, CountsItsValuesWithoutWhatWasAddedAround) {
    const std::shared_ptr<Scene> outside = opened({{"SCENE", {ball()}}, {"isosurface", {""}}});
    Progress progress;
    const ValueCounts counts = outside->offered<ShownValues>()->values->count(progress);
    std::uint64_t sum = 0;
    for (const std::uint64_t count : counts.counts) sum += count;
    EXPECT_EQ(sum, 24u * 24 * 24);
    EXPECT_GT(counts.highest(), 900);
    EXPECT_EQ(outside->offered<ShownValues>()->values->unit, "");
    const std::shared_ptr<Scene> inside = opened({{"SCENE", {maskedTube()}}, {"no-cache", {""}}});
    EXPECT_FALSE(inside->offered<ShownValues>()->values->count(progress).empty());
    EXPECT_FALSE(inside->offered<ShownValues>()->begun.isovalue);
}

TEST_F(ChangedVolume, TheSkyAroundItFollowsItsSurface) {
    const auto lightOf = [](const Scene& scene) -> const StudioLook& {
        return scene.offered<ColonScene>()->volume.look.studio;
    };
    const auto sizeSeen = [&](const Scene& scene) {
        double sum = 0;
        const SkyGrid& grid = *lightOf(scene).seen;
        for (std::size_t n = 0; n < grid.count(); ++n) sum += grid.words[2 * n + 1] & 1023u;
        return sum;
    };
    const SettingTexts first{{"SCENE", {ball()}}, {"isosurface", {""}}, {"isovalue", {"300"}}};
    const std::shared_ptr<Scene> shown = opened(first);
    ASSERT_TRUE(lightOf(*shown).seen);
    SurfaceChange smaller;
    smaller.isovalue = 700;
    const std::shared_ptr<Scene> after = changed(*shown, smaller);
    EXPECT_GT(sizeSeen(*after), sizeSeen(*shown)) << "a smaller ball hides less";
    EXPECT_EQ(lightOf(*after).keyFrom, lightOf(*shown).keyFrom) << "the key light stands still";
    EXPECT_GT(sizeSeen(*through(*shown, kGlass)), sizeSeen(*shown));
    EXPECT_EQ(lightOf(*changed(*after, {})).seen, lightOf(*after).seen) << "nothing is worked out again";
    // Options that say what lights it.
    for (const auto& [option, text] : std::vector<std::pair<std::string, std::string>>{
             {"look", "plain"}, {"shading", "lamp"}, {"shading", "varying"}, {"ambient", "8"}}) {
        SettingTexts said = first;
        setText(said, option, text);
        EXPECT_FALSE(lightOf(*opened(said)).seen) << option << " " << text;
    }
    EXPECT_FALSE(lightOf(*opened({{"SCENE", {maskedTube()}}, {"no-cache", {""}}})).seen) << "a colon";
}

}  // namespace
}  // namespace stereonav::test
