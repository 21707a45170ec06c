// Results of `view --bench`: the times of pictures are made up here.
#include "app/view/view_bench.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/base/progress.h"
#include "tests/support/one_method_frames.h"
#include "tests/support/whole_progress.h"
#include "tests/view/fake_scene.h"

namespace stereonav {
namespace {

double benchNumber(const Facts& facts, const std::string& key) {
    for (const Fact& fact : facts)
        if (fact.key == key) {
            if (const auto* const number = std::get_if<double>(&fact.value)) return *number;
            if (const auto* const whole = std::get_if<std::int64_t>(&fact.value))
                return static_cast<double>(*whole);
        }
    return std::nan("");
}

// Both eyes have one grey, which is the place along x.
class GreyFrames final : public test::OneMethodFrames {
public:
    void make(const StereoViews& views, double time, const FrameWay& way, EyePair& frame) override {
        OneMethodFrames::make(views, time, way, frame);
        ++made;
    }
    void makeOne(const EyeView& view, double, EyePair& frame) override {
        frame.left.resize(view.width, view.height);
        for (int y = 0; y < view.height; ++y)
            for (int x = 0; x < view.width; ++x)
                frame.left.color.at(x, y) = packColor(glm::vec3(static_cast<float>(view.head.x)));
    }
    int made = 0;
};

FrameRequest benchRequest(long long version, double grey, double asked, double ahead) {
    FrameRequest request;
    request.version = version;
    request.pose = poseFromAngles({grey, 0, 0}, 0, 0, 0);
    request.lens.width = 16;
    request.lens.height = 12;
    request.stereo = {0.0, 50.0};
    request.asked_s = asked;
    request.ahead_s = ahead;
    return request;
}

ShownPicture shownPicture(const FrameRequest& of, const FrameRequest& cast, double grey) {
    auto eye = std::make_shared<Plane<PackedColor>>(16, 12);
    for (int y = 0; y < 12; ++y)
        for (int x = 0; x < 16; ++x) eye->at(x, y) = packColor(glm::vec3(static_cast<float>(grey)));
    return {eye, eye, of, cast, true};
}

TEST(ViewBench, FliesRestsAndJudgesOnceEach) {
    ViewBench bench;
    using Wish = ViewBench::Wish;
    EXPECT_EQ(bench.step(0, false, false, 5), Wish::None);
    EXPECT_EQ(bench.step(1, true, false, 5), Wish::None) << "eyes that follow are to arrive";
    EXPECT_EQ(bench.step(2, false, false, 5), Wish::None);
    EXPECT_EQ(bench.step(2.5, true, false, 5), Wish::None);
    EXPECT_EQ(bench.step(4, true, false, 5), Wish::None) << "it did not rest so long";
    EXPECT_EQ(bench.step(4.6, true, false, 5), Wish::Fly);
    EXPECT_EQ(bench.step(9, true, true, 5), Wish::None);
    EXPECT_EQ(bench.step(9.7, true, true, 5), Wish::Stop);
    EXPECT_EQ(bench.step(19, true, false, 5), Wish::None);
    EXPECT_FALSE(bench.judging());
    EXPECT_EQ(bench.step(20, true, false, 5), Wish::Judge);
    EXPECT_TRUE(bench.judging());
    EXPECT_EQ(bench.step(30, true, false, 5), Wish::None);
}

TEST(ViewBench, BreaksOffALongFlight) {
    ViewBench bench;
    bench.step(0, true, false, 1000);
    ASSERT_EQ(bench.step(3, true, false, 1000), ViewBench::Wish::Fly);
    EXPECT_EQ(bench.step(3 + ViewBench::kLongestFlight - 0.1, true, true, 1000), ViewBench::Wish::None);
    EXPECT_EQ(bench.step(3 + ViewBench::kLongestFlight + 0.1, true, true, 1000), ViewBench::Wish::Stop);
}

TEST(ViewBench, FliesAFlightThatWasGivenToItsEnd) {
    ViewBench bench(true);
    bench.step(0, true, false, 1000);
    ASSERT_EQ(bench.step(3, true, false, 1000), ViewBench::Wish::Fly);
    EXPECT_EQ(bench.step(1002.9, true, true, 1000), ViewBench::Wish::None);
    EXPECT_EQ(bench.step(1003.1, true, true, 1000), ViewBench::Wish::Stop);
}

// Pictures are 20 ms apart, except every tenth, which is 50 ms late; each is asked for 100 ms before it is
// shown, for a moment 70 ms ahead; errors are a grey level in motion, half a one a second later, and none
// after ten.
TEST(ViewBench, TellsWhatWasShown) {
    ViewBench bench;
    bench.step(0, true, false, 10);
    ASSERT_EQ(bench.step(2, true, false, 10), ViewBench::Wish::Fly);
    double t = 2, grey = 0.25;
    long long version = 1;
    for (int n = 0; t < 12; ++n) {
        t += n % 10 == 9 ? 0.07 : 0.02;
        grey = 0.25 + 1e-3 * n;
        const FrameRequest cast = benchRequest(version, grey, t - 0.1, 0.07);
        FrameRequest now = benchRequest(++version, grey, t - 0.01, 0);
        const ShownPicture picture = shownPicture(now, cast, grey * 1.02);
        bench.shown(picture, now, t);
        bench.shown(picture, now, t + 1e-3);  // drawn again, for the panels
    }
    ASSERT_EQ(bench.step(12.1, true, true, 10), ViewBench::Wish::Stop);
    const FrameRequest rests = benchRequest(++version, 0.5, 12.2, 0);
    bench.shown(shownPicture(rests, rests, 0.5 * 1.01), rests, 12.5);
    FrameRequest better = rests;
    bench.shown(shownPicture(better, better, 0.5), better, 15);
    bench.step(22.2, true, false, 10);
    ASSERT_EQ(bench.step(22.4, true, false, 10), ViewBench::Wish::Judge);

    FakeParts parts;
    GreyFrames frames;
    parts.frames = &frames;
    const OpenScene open = openOf(parts);
    test::WrittenProgress written;
    bench.judge(*open.scene, written.progress());
    written.expectWhole("judging", 5);
    const Facts facts = bench.facts();
    EXPECT_NEAR(benchNumber(facts, "shown_p50_ms"), 20, 1e-6);
    EXPECT_NEAR(benchNumber(facts, "shown_p95_ms"), 70, 1e-6);
    EXPECT_NEAR(benchNumber(facts, "age_p50_ms"), 30, 1e-6);
    EXPECT_NEAR(benchNumber(facts, "delay_p95_ms"), 100, 1e-6);
    EXPECT_NEAR(benchNumber(facts, "pose_age_p95_ms"), 10, 1e-6);
    EXPECT_EQ(benchNumber(facts, "judged"), 6) << "of twelve that are kept: it is no scene of rays";
    EXPECT_GT(benchNumber(facts, "psnr_moving_db"), 35);
    EXPECT_LT(benchNumber(facts, "psnr_moving_db"), 50);
    EXPECT_GT(benchNumber(facts, "psnr_1s_db"), benchNumber(facts, "psnr_moving_db"));
    EXPECT_LT(benchNumber(facts, "psnr_1s_db"), 60);
    EXPECT_GT(benchNumber(facts, "psnr_10s_db"), 90);
    EXPECT_GT(benchNumber(facts, "psnr_10s_pair_db"), 90);
    EXPECT_EQ(frames.made, 6 + 1) << "the moment shown is that of now, and one pair does for the rest";
}

}  // namespace
}  // namespace stereonav
