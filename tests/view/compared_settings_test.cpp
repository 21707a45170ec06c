// Kept results are found by comparing settings: each member of each of them counts.
#include <gtest/gtest.h>

#include <chrono>
#include <condition_variable>
#include <fstream>
#include <mutex>

#include "app/output/stereo_tag.h"
#include "app/view/file_looks.h"
#include "app/view/job.h"
#include "app/view/late_view.h"
#include "app/view/second_study.h"
#include "app/view/session.h"
#include "app/view/sun_clock.h"
#include "app/view/transfer_curve.h"
#include "app/view/window/picture_place.h"
#include "app/view/window_config.h"
#include "engine/display/eye_overlay.h"
#include "engine/display/eye_passes.h"
#include "engine/display/interface.h"
#include "engine/display/medium_gpu_targets.h"
#include "engine/display/monitors.h"
#include "engine/display/space_mouse.h"
#include "engine/light/occlusion/occlusion_modulation.h"
#include "engine/light/transfer/turning_sky.h"
#include "engine/nav/navigator.h"
#include "engine/scene/capabilities.h"
#include "engine/scene/wall_to_see.h"
#include "engine/volume/transfer_function.h"
#include "engine/volume/volume_up.h"
#include "tests/support/each_member.h"
#include "tests/view/fake_frames.h"
#include "tests/view/fake_scene.h"

namespace stereonav::test {

#define STEREONAV_MEMBERS(type, ...)                    \
    template <>                                         \
    struct Members<type> {                              \
        static constexpr std::array names{__VA_ARGS__}; \
    }

STEREONAV_MEMBERS(SunPlace, "azimuth", "elevation");
STEREONAV_MEMBERS(PlaceOnEarth, "latitude", "longitude");
STEREONAV_MEMBERS(SunClock, "year", "day", "hour", "offset", "place");
STEREONAV_MEMBERS(AmbientChoice, "lit", "method", "radius", "modulate", "modulateRadius", "sigma");
STEREONAV_MEMBERS(WallLooking, "within", "angle", "smallestPatch");
STEREONAV_MEMBERS(OverlayMark, "left", "right", "text", "textAt", "dot", "ink");
STEREONAV_MEMBERS(InterfaceArea, "x", "y", "width", "height");
STEREONAV_MEMBERS(InterfacePlaces, "areas", "size");
STEREONAV_MEMBERS(InterfaceLook, "dark", "grey", "scale");
STEREONAV_MEMBERS(InterfaceOpening, "corner", "size");
STEREONAV_MEMBERS(SpaceMouseState, "push", "twist");
STEREONAV_MEMBERS(ComposeSetting, "mode", "swapEyes", "linearAnaglyph");
STEREONAV_MEMBERS(EyePass, "setting", "buffer");
STEREONAV_MEMBERS(EyeArea, "x", "y", "width", "height");
STEREONAV_MEMBERS(ScreenRect, "x", "y", "width", "height");
STEREONAV_MEMBERS(TargetSizes, "eyes", "light", "single");
STEREONAV_MEMBERS(TransferPoint, "value", "color", "opacity");
STEREONAV_MEMBERS(UpAxis, "axis", "negative");
STEREONAV_MEMBERS(OcclusionEstimate, "method", "beta", "deviations");
STEREONAV_MEMBERS(ModulationSetting, "by", "radius", "openness", "sigma");
STEREONAV_MEMBERS(SkyTurn, "turn", "tilt");
STEREONAV_MEMBERS(StereoTag, "matroska", "st3d", "framePacking", "aspectWidth", "aspectHeight");
STEREONAV_MEMBERS(ValueView, "low", "high");
STEREONAV_MEMBERS(SecondPlace, "along", "length", "back");
STEREONAV_MEMBERS(KeptScreen, "monitor", "width_mm", "viewingDistance_mm");
STEREONAV_MEMBERS(WindowConfig, "theme", "scale", "leftWidth", "rightWidth", "openPanels", "lastFolder",
                  "speedByDistance", "placeLabels", "figures", "place", "maximised", "mode", "screens");
STEREONAV_MEMBERS(ShownMode, "mode", "stereo");
STEREONAV_MEMBERS(PicturePlace, "part", "corner", "size");
STEREONAV_MEMBERS(Lens, "width", "height", "verticalFov", "pixelAspect", "nearDepth", "fall");
STEREONAV_MEMBERS(StereoSetting, "separation", "zeroParallax");
STEREONAV_MEMBERS(Pose, "position", "orientation");
STEREONAV_MEMBERS(FrameRequest, "version", "asked_s", "ahead_s", "pose", "lens", "stereo", "way", "model",
                  "time", "sun", "paint", "twoEyes", "mode", "fitEyes", "truth", "scale", "guard", "whole",
                  "effort", "flying", "late", "refines", "paintOver");
#undef STEREONAV_MEMBERS

namespace {
namespace fs = std::filesystem;

TEST(ComparedSettings, OfTheEngineCountInWhole) {
    expectEachMemberCompared(SunPlace{1, 0.5});
    expectEachMemberCompared(AmbientChoice{true, "gaussian", 0.01, "variance", 0.02, 3});
    expectEachMemberCompared(WallLooking());
    expectEachMemberCompared(ComposeSetting{OutputMode::Rows, false, true});
    expectEachMemberCompared(EyeArea{1, 2, 3, 4});
    expectEachMemberCompared(TransferPoint{100, {0.5f, 0.25f, 0.125f}, 0.5});
    expectEachMemberCompared(UpAxis{1, true});
    expectEachMemberCompared(OcclusionEstimate());
    for (const std::optional<double>& sigma : {std::optional<double>(), std::optional(2.0)}) {
        ModulationSetting modulation;
        modulation.sigma = sigma;
        expectEachMemberCompared(modulation);
    }
    expectEachMemberCompared(SkyTurn{0.5, 0.25});
    expectEachMemberCompared(Lens{640, 480, 0.8, 1, 0.1, 1e-7});
    expectEachMemberCompared(StereoSetting());
}

TEST(ComparedSettings, OfTheDisplayCountInWhole) {
    expectEachMemberCompared(OverlayMark{{1, 2}, {3, 4}, "a place", {5, 6}, false, {7, 8, 9}});
    expectEachMemberCompared(InterfacePlaces{{{0, 0, 0.5f, 1}, {0.5f, 0, 0.5f, 1}}, {1, 2}});
    expectEachMemberCompared(InterfaceLook());
    expectEachMemberCompared(InterfaceOpening{{1, 2}, {3, 4}});
    expectEachMemberCompared(SpaceMouseState{{0.5, 0.25, 0}, {0, 1, 0.125}});
    expectEachMemberCompared(EyePass{{OutputMode::Rows, false, true}, BackBuffer::Left});
    expectEachMemberCompared(ScreenRect{1, 2, 3, 4});
    expectEachMemberCompared(TargetSizes{{{640, 480}, {600, 480}}, {256, 256}, true});
}

TEST(ComparedSettings, OfTheWindowCountInWhole) {
    expectEachMemberCompared(SunClock{2024, 172, 12.5, 1, {0.8, 0.15}});
    expectEachMemberCompared(StereoTag());
    expectEachMemberCompared(ValueView{-1000, 400});
    expectEachMemberCompared(SecondPlace{0.5, 1.5, true});
    expectEachMemberCompared(PicturePlace{{640, 480}, {10, 20}, {600, 400}});
    WindowConfig config;
    expectEachMemberCompared(config);
    config.scale = 1.5;
    config.place = {1, 2, 3, 4};
    config.mode = {OutputMode::Rows, true};
    config.openPanels = {"Light", "Places"};
    config.screens = {{"A", 600.0, std::nullopt}, {"B", std::nullopt, 700.0}};
    expectEachMemberCompared(config);
}

TEST(ComparedSettings, OfATransferFunctionCountInWhole) {
    const std::vector<TransferPoint> points{{100, {0.5f, 0.25f, 0.125f}, 0.5}, {900, {1, 1, 1}, 1}};
    const TransferFunction base(points, 0.001, "test");
    EXPECT_TRUE(base == TransferFunction(points, 0.001, "another name"));
    EXPECT_FALSE(base == TransferFunction(points, std::nextafter(0.001, 1.0), "test"));
    EXPECT_FALSE(base == TransferFunction({points[0]}, 0.001, "test"));
    for (std::size_t n = 0; n < points.size(); ++n) {
        const auto other = [&](const auto& change) {
            std::vector<TransferPoint> changed = points;
            change(changed[n]);
            return TransferFunction(changed, 0.001, "test");
        };
        EXPECT_FALSE(base == other([](TransferPoint& p) { p.value += 1; })) << n;
        EXPECT_FALSE(base == other([](TransferPoint& p) { p.opacity -= 0.25; })) << n;
        for (int channel = 0; channel < 3; ++channel)
            EXPECT_FALSE(base == other([&](TransferPoint& p) { p.color[channel] -= 0.125f; })) << n;
    }
}

FrameRequest asked() {
    FrameRequest request;
    request.lens = {640, 480, 0.8, 1, 0.1, 1e-7};
    request.guard = {10, 20};
    return request;
}

TEST(ComparedSettings, OfAViewAreWhereItIsSeenFrom) {
    const FrameRequest base = asked();
    const std::vector<std::string> elsewhere{
        "version", "asked_s", "ahead_s", "way",   "model",  "time",   "sun",  "paint",   "mode",
        "fitEyes", "truth",   "scale",   "whole", "effort", "flying", "late", "refines", "paintOver"};
    EXPECT_TRUE(sameView(base, FrameRequest(base)));
    for (const auto& changed : eachMemberChanged(base, elsewhere))
        EXPECT_FALSE(sameView(base, changed.value)) << changed.what;
}

// A session over ground, with a sun that moves and models of light.
class AskedFrames : public testing::Test {
protected:
    AskedFrames() {
        mParts.makeFlight = []() -> std::unique_ptr<Flight> {
            return std::make_unique<Navigator>([](const glm::dvec2&) { return 0.0; },
                                               poseFromAngles({0, 0, 500}, 0, -0.1, 0), FlightSetting());
        };
        mParts.stereo = {20, 600};
        mParts.frames = &mFrames;
        mParts.way.method = mFrames.defaultMethod();
        mParts.moveSun = [](const SunPlace&) {};
        mParts.models = {"one", "two"};
    }
    // Versions of requests before and after a change, each made twice.
    template <typename Change>
    void expectAskedForAgain(const std::string& what, const Change& change) {
        SCOPED_TRACE(what);
        ViewSession session(opened(mParts), {});
        mAsk = [&session] { return session.requestFor(640, 480).version; };
        const long long before = mAsk();
        EXPECT_EQ(mAsk(), before);
        change(session);
        const long long after = mAsk();
        EXPECT_GT(after, before);
        EXPECT_EQ(mAsk(), after);
    }

    FakeFrames mFrames;
    FakeParts mParts;
    std::function<long long()> mAsk;
};

// Lets commands with a slow effect finish.
void rest(ViewSession& session) {
    for (int n = 0; n < 600; ++n) session.step({}, 1.0 / 60);
}

TEST_F(AskedFrames, EveryDifferenceIsAskedFor) {
    const auto act = [](ViewCommand command) {
        return [command](ViewSession& s) {
            s.act({command});
            rest(s);
        };
    };
    expectAskedForAgain("place", [](ViewSession& s) {
        Pose pose = s.pose();
        pose.position.x += 1e-9;
        s.goTo(pose);
    });
    expectAskedForAgain("direction", [](ViewSession& s) { s.look(0.001, 0); });
    expectAskedForAgain("field of view", [](ViewSession& s) { s.setFov(0.5); });
    expectAskedForAgain("separation", act(ViewCommand::MoreSeparation));
    expectAskedForAgain("zero parallax", act(ViewCommand::FartherZeroParallax));
    expectAskedForAgain("one eye", act(ViewCommand::ToggleStereo));
    expectAskedForAgain("method", act(ViewCommand::NextMethod));
    expectAskedForAgain("model", [](ViewSession& s) { s.light().choose(1); });
    expectAskedForAgain("azimuth", [](ViewSession& s) {
        s.light().place({s.light().sun().azimuth + 1e-9, 0});
    });
    expectAskedForAgain("elevation", [](ViewSession& s) {
        s.light().place({s.light().sun().azimuth, 1e-9});
    });
    // The sizes of the eyes stay the same.
    expectAskedForAgain("mode", [](ViewSession& s) { s.chooseMode(OutputMode::CrossEyed); });
    for (const TruthView truth : {TruthView::FullCast, TruthView::Difference, TruthView::Holes})
        expectAskedForAgain("truth", [truth](ViewSession& s) { s.setTruth(truth); });
    struct Nothing final : EyePainter {
        void paint(const EyeView&, EyeImage&) const override {}
    };
    expectAskedForAgain("paint", [](ViewSession& s) { s.setPaint(std::make_shared<Nothing>()); });
    struct Size {
        int width, height;
        double scale;
        glm::dvec2 guard;
    };
    for (const Size& size : {Size{642, 480, 1, {}}, Size{640, 482, 1, {}}, Size{640, 480, 0.5, {}},
                             Size{640, 480, 1, {0.1, 0}}, Size{640, 480, 1, {0, 0.1}}})
        expectAskedForAgain("size", [&](ViewSession& s) {
            mAsk = [&s, size] {
                return s.requestFor(size.width, size.height, 0, size.scale, size.guard).version;
            };
        });
    mParts.animated = true;
    mParts.largestSeparation = std::numeric_limits<double>::infinity();
    expectAskedForAgain("time", [](ViewSession& s) { s.step({}, 1.0 / 60); });
}

TEST(ComparedSettings, OfABakeBesideTheWindowAreAllItsWords) {
    const std::vector<std::string> base{"bake", "ab", "c", "--what=openness"};
    std::vector<Changed<std::vector<std::string>>> changes = eachMemberChanged(base);
    changes.push_back({"words cut elsewhere", {"bake", "a", "bc", "--what=openness"}});
    changes.push_back({"words in one", {"bake", "abc", "--what=openness"}});
    expectKeysDiffer(base, changes,
                     [](const std::vector<std::string>& words) { return placeOfBake(words).string(); });
}

// The description of a file is reused while the file has its size and its time.
TEST(ComparedSettings, OfAFileAreItsPathItsSizeAndItsTime) {
    const fs::path folder = fs::path(testing::TempDir()) / ("stereonav_compared_" + std::to_string(getpid()));
    fs::create_directories(folder);
    const auto then = fs::file_time_type() + std::chrono::hours(1000);
    const auto write = [&](const std::string& name, const std::string& text, int seconds) {
        std::ofstream(folder / name) << text;
        fs::last_write_time(folder / name, then + std::chrono::seconds(seconds));
    };
    std::mutex mutex;
    std::condition_variable ready;
    int looked = 0, told = 0;
    FileLooks looks(
        [&] {
            const std::lock_guard lock(mutex);
            ++told;
            ready.notify_all();
        },
        [&](const std::string&, Progress&) {
            const std::lock_guard lock(mutex);
            ++looked;
            return Facts{};
        });
    const auto looksOf = [&](const std::string& name) {
        std::unique_lock lock(mutex);
        const int before = looked;
        for (;;) {
            const int seen = told;
            lock.unlock();
            const bool busy = looks.look(folder / name).busy;
            lock.lock();
            if (!busy) return looked - before;
            if (!ready.wait_for(lock, std::chrono::minutes(5), [&] { return told > seen; })) return -1;
        }
    };
    write("a", "text", 0);
    EXPECT_EQ(looksOf("a"), 1);
    EXPECT_EQ(looksOf("a"), 0);
    write("a", "texts", 0);
    EXPECT_EQ(looksOf("a"), 1) << "another size";
    write("a", "other", 1);
    EXPECT_EQ(looksOf("a"), 1) << "another time";
    write("b", "other", 1);
    EXPECT_EQ(looksOf("b"), 1) << "another path";
    EXPECT_EQ(looksOf("a"), 0);
    fs::remove_all(folder);
}

}  // namespace
}  // namespace stereonav::test
