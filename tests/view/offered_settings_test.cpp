// What the window offers of a scene it also takes: every row of the settings of every kind of scene is set to
// values in the range that it shows, and the scene is loaded with them as the window does it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/view/live_settings.h"
#include "app/view/loading.h"
#include "app/view/scene_settings.h"
#include "engine/base/error.h"
#include "tests/app/volume_input.h"

namespace stereonav::test {
namespace {

// Returns both ends of a range.
std::vector<double> numbersOf(const NumberRange& range) {
    return {range.openLow ? range.low + 1e-6 * (range.high - range.low) : range.low,
            range.openHigh ? range.high - 1e-6 * (range.high - range.low) : range.high};
}

// Returns texts that the row shows as possible; none where only the files at hand decide.
std::vector<std::string> shownValues(const SettingRow& row) {
    std::vector<std::string> texts = row.choices;
    if (row.kind == ValueKind::Flag) texts.emplace_back("");
    if (row.kind == ValueKind::Number)
        for (const double number : numbersOf(row.range)) texts.push_back(fmt::format("{:.9g}", number));
    if (row.kind == ValueKind::Whole)
        for (const double number : numbersOf(row.range)) texts.push_back(fmt::format("{:.0f}", number));
    return texts;
}

class OfferedSettings : public VolumeTest {
protected:
    // Opens a scene as the window does.
    void open(SettingTexts texts) {
        const ViewOptions options = viewOptionsOf(texts);
        mSettings.emplace(options, mSession);
        mSession.emplace(std::make_shared<const OpenScene>(loaded(options)),
                         ViewSession::Options{OutputMode::SideBySide, std::nullopt, place()});
        mSettings->lookAtScene();
    }
    static OpenScene loaded(ViewOptions options) {
        options.scene.skyTurns = true;
        options.scene.detailLater = true;
        options.size = {64, 48};
        Progress progress;
        return openScene(options, false, {64, 48}, nullptr, progress);
    }
    // Sets one value as SceneChanges does: at once, or by loading again. Throws Error.
    void take(const Option& option, const std::string& text) {
        if (isLive(*mSession, option.key, text)) return setLive(*mSession, option.key, text);
        SettingTexts settings = mSettings->now();
        setText(settings, option.key, text);
        loaded(viewOptionsOf(settings));
    }
    // Returns a line for each value that is shown and refused.
    std::string refused(bool ofStudyAlone = false) {
        std::string lines;
        for (const Option& option : optionTable()) {
            if (!(option.commands & command::kView) || option.panel == OptionPanel::None ||
                (ofStudyAlone && option.panel != OptionPanel::Material &&
                 option.panel != OptionPanel::Study) ||
                !mSettings->applies(option) || ofThisMachine(option.key))
                continue;
            for (const std::string& text : shownValues(mSettings->row(option))) try {
                    if (text == "auto") continue;  // light that lies in the cache, or not
                    take(option, text);
                } catch (const Error& error) {
                    lines += fmt::format("{} \"{}\": {}\n", option.key, text, error.what());
                }
        }
        return lines;
    }
    // Returns whether what is taken depends on the processor, its memory or its cache, and not on the scene.
    static bool ofThisMachine(std::string_view key) {
        return key == "threads" || key == "memory" || key == "tiles" || key == "slices" ||
               key == "light-size";
    }
    bool offers(const char* key) const { return mSettings->applies(*viewOption(key)); }

    std::optional<ViewSession> mSession;
    std::optional<SceneSettings> mSettings;
};

TEST_F(OfferedSettings, OfGroundAreTaken) {
    open({{"SCENE", {hills()}}});
    EXPECT_EQ(refused(), "");
}

TEST_F(OfferedSettings, OfAColonFromItsMaskAreTaken) {
    open({{"SCENE", {maskedTube()}}});
    EXPECT_EQ(refused(), "");
}

TEST_F(OfferedSettings, OfAColonInCtAreTaken) {
    open({{"SCENE", {"colon"}}});
    EXPECT_FALSE(offers("isovalue")) << "its wall stays where it was found";
    EXPECT_EQ(refused(true), "") << "the rest is that of a mask";
}

TEST_F(OfferedSettings, OfAVolumeSeenFromOutsideAreTaken) {
    open({{"SCENE", {ball()}}});
    EXPECT_EQ(refused(), "");
}

TEST_F(OfferedSettings, OfAVolumeSeenThroughAreTaken) {
    open({{"SCENE", {ball()}}, {"opacity", {"0.5"}}});
    EXPECT_EQ(refused(), "");
}

TEST_F(OfferedSettings, OfAMediumAreTaken) {
    open({{"SCENE", {"cloud"}}});
    EXPECT_EQ(refused(), "");
}

TEST_F(OfferedSettings, OfAMeshAreTaken) {
    const std::string file = (mFolder / "hills.glb").string();
    ASSERT_EQ(run({"mesh", hills(), "--out", file, "--error", "0"}).status, 0);
    open({{"SCENE", {file}}});
    EXPECT_EQ(refused(), "");
}

}  // namespace
}  // namespace stereonav::test
