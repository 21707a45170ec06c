// Coverage in flight, when things change meanwhile: restarted, judged differently and back, shown by another
// scene. Views from before a change are not counted after it.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <set>

#include "app/view/live_coverage.h"
#include "engine/base/error.h"
#include "tests/camera/temporary_folder.h"
#include "tests/support/gate.h"

namespace stereonav {
namespace {

using test::Gate;

// A wall that is seen from each whole centimetre once, where that is no farther than the judging distance;
// percent is the number of those places, plus a thousand for each number of the scene. Its own flight there
// is at 1 to 3 cm, back at 11 to 15.
class CountedWall final : public Scene, public WallToSee {
public:
    explicit CountedWall(int number) : mNumber(number) {
        lens.verticalFov = 1;
        offer<WallToSee>(*this);
        flights.open();
        looks.open();
    }
    FrameMaker& frames() const override { throw Error("", "", "no frames", ""); }
    std::unique_ptr<Flight> makeFlight() const override { return nullptr; }
    std::unique_ptr<WallSeen> begin(const WallLooking& looking, Progress&) const override {
        struct Seen final : WallSeen {
            const CountedWall& wall;
            double within;
            std::set<long> places;
            Seen(const CountedWall& of, double far) : wall(of), within(far) {}
            void look(std::span<const EyeView> eyes, Progress&) override {
                for (const EyeView& eye : eyes)
                    if (std::abs(eye.eye.x) <= within) places.insert(std::lround(100 * eye.eye.x));
                wall.looks.pass();
            }
            void judgeBy(const WallLooking& by) override {
                within = by.within;
                places.clear();
            }
            double percent() const override {
                return 1000.0 * wall.mNumber + static_cast<double>(places.size());
            }
            std::vector<UnseenPart> unseen() const override { return {}; }
            std::shared_ptr<const EyePainter> painter() const override { return nullptr; }
        };
        return std::make_unique<Seen>(*this, looking.within);
    }
    std::vector<Pose> ownFlight(bool back) const override {
        flights.pass();
        std::vector<Pose> poses;
        for (int n = back ? 11 : 1; n <= (back ? 15 : 3); ++n)
            poses.push_back(poseFromAngles({0.01 * n, 0, 0}, 0, 0, 0));
        return poses;
    }
    mutable Gate flights, looks;

private:
    int mNumber;
};

EyeView eyeAtCentimetre(int n) {
    Lens lens;
    lens.width = lens.height = 1;
    lens.verticalFov = 1;
    return makeEyeView(poseFromAngles({0.01 * n, 0, 0}, 0, 0, 0), lens);
}

class CoverageDetours : public testing::Test {
protected:
    CoverageDetours() { mCoverage.judgeBy(within(0.2)); }
    static WallLooking within(double metres) {
        WallLooking looking;
        looking.within = metres;
        return looking;
    }
    double percent() {
        EXPECT_TRUE(test::waitFor([this] {
            mCoverage.poll();
            return !mCoverage.busy();
        }));
        return mCoverage.soFar().percent;
    }
    void show(int centimetre) { mCoverage.show(eyeAtCentimetre(centimetre), mSeconds += 0.1, false); }

    std::shared_ptr<CountedWall> mWall = std::make_shared<CountedWall>(1);
    double mSeconds = 0;
    LiveCoverage mCoverage{[] {}};
};

TEST_F(CoverageDetours, JudgedOtherwiseAndBackIsAsBefore) {
    mCoverage.open(mWall, "");
    mCoverage.switchOn(true);
    for (int n = 1; n <= 9; ++n) show(n);
    EXPECT_EQ(percent(), 1009);
    mCoverage.judgeBy(within(0.0451));
    EXPECT_EQ(percent(), 1004);
    mCoverage.judgeBy(within(0.2));
    EXPECT_EQ(percent(), 1009);
    // The change there and back comes before anything was looked at again, and while it is.
    mCoverage.judgeBy(within(0.0451));
    mCoverage.judgeBy(within(0.2));
    EXPECT_EQ(percent(), 1009);
    mWall->looks.close();
    const int before = mWall->looks.came();
    mCoverage.judgeBy(within(0.0151));
    mWall->looks.await(before + 1);
    mCoverage.judgeBy(within(0.2));
    show(12);
    mWall->looks.open();
    EXPECT_EQ(percent(), 1010);
}

TEST_F(CoverageDetours, BegunAgainNothingOfBeforeCounts) {
    mCoverage.open(mWall, "");
    mCoverage.switchOn(true);
    for (int n = 1; n <= 9; ++n) show(n);
    EXPECT_EQ(percent(), 1009);
    mWall->looks.close();
    const int before = mWall->looks.came();
    show(10);
    mWall->looks.await(before + 1);
    mCoverage.startAgain();
    show(3);
    mWall->looks.open();
    EXPECT_EQ(percent(), 1001) << "from the one place since";
    EXPECT_EQ(mCoverage.metres(), 0);
    EXPECT_EQ(mCoverage.soFar().looked, 1u);
}

// A late own flight is not counted after a restart; another request for one is.
TEST_F(CoverageDetours, AnOwnFlightOfBeforeIsNotCounted) {
    mCoverage.open(mWall, "");
    mCoverage.switchOn(true);
    EXPECT_EQ(percent(), 1000);
    mWall->flights.close();
    mCoverage.addOwnFlight(false);
    mWall->flights.await(1);
    mCoverage.startAgain();
    mWall->flights.open();
    EXPECT_EQ(percent(), 1000);
    // Both ways are asked for: the way back is in progress at the restart, and then only the way there is
    // asked for.
    mCoverage.addOwnFlight(true);
    EXPECT_EQ(percent(), 1008);
    mCoverage.startAgain();
    EXPECT_EQ(percent(), 1000);
    mWall->flights.close();
    const int before = mWall->flights.came();
    mCoverage.addOwnFlight(true);
    mWall->flights.await(before + 1);
    mCoverage.startAgain();
    mCoverage.addOwnFlight(false);
    mCoverage.startAgain();
    mCoverage.addOwnFlight(true);
    mWall->flights.open();
    EXPECT_EQ(percent(), 1008) << "each way once";
}

TEST_F(CoverageDetours, AFlightThatComesLateIsNoneOfThoseWishedForSince) {
    mCoverage.open(mWall, "");
    mCoverage.switchOn(true);
    EXPECT_EQ(percent(), 1000);
    mWall->flights.close();
    mCoverage.addOwnFlight(true);
    mWall->flights.await(1);
    mCoverage.startAgain();
    mCoverage.addOwnFlight(true);
    // The way there is asked for a second time, and then the way back; the first answer belongs to the time
    // before.
    mWall->flights.open();
    EXPECT_EQ(percent(), 1008);
    EXPECT_EQ(mWall->flights.came(), 3) << "what was begun before is not one of them";
}

TEST_F(CoverageDetours, AnotherSceneLooksAgainItself) {
    mCoverage.open(mWall, "");
    mCoverage.switchOn(true);
    for (int n = 1; n <= 4; ++n) show(n);
    EXPECT_EQ(percent(), 1004);
    const auto other = std::make_shared<CountedWall>(2);
    mCoverage.replaceScene(other);
    EXPECT_FALSE(mCoverage.soFar().any) << "nothing is known of it yet";
    EXPECT_EQ(percent(), 2004);
    mCoverage.replaceScene(mWall);
    EXPECT_EQ(percent(), 1004) << "there and back";
    // A request for its own flight is dropped with it.
    other->flights.close();
    mWall->flights.close();
    mCoverage.addOwnFlight(false);
    mWall->flights.await(1);
    mWall->flights.open();
    mCoverage.replaceScene(other);
    other->flights.open();
    EXPECT_EQ(percent(), 2004) << "at 1 to 3 cm it was flown already";
    mCoverage.open(other, "");
    EXPECT_FALSE(mCoverage.on());
    mCoverage.switchOn(true);
    EXPECT_EQ(percent(), 2000) << "opened it begins anew";
}

// Off and on again: with a file everything comes back once, without one nothing does.
TEST_F(CoverageDetours, OffAndOnAgain) {
    const TemporaryFolder folder;
    for (const bool kept : {true, false}) {
        SCOPED_TRACE(kept);
        LiveCoverage coverage([] {});
        coverage.judgeBy(within(0.2));
        coverage.open(mWall, kept ? folder / "coverage/a.json" : std::filesystem::path());
        const auto settled = [&] {
            EXPECT_TRUE(test::waitFor([&] {
                coverage.poll();
                return !coverage.busy();
            }));
            return coverage.soFar().percent;
        };
        coverage.switchOn(true);
        for (int n = 1; n <= 5; ++n) coverage.show(eyeAtCentimetre(n), n, false);
        EXPECT_EQ(settled(), 1005);
        const std::size_t looked = coverage.soFar().looked;
        for (int times = 0; times < 3; ++times) {
            coverage.switchOn(false);
            EXPECT_FALSE(coverage.poll());
            EXPECT_FALSE(coverage.soFar().any);
            coverage.switchOn(true);
            EXPECT_EQ(settled(), kept ? 1005 : 1000);
            EXPECT_EQ(coverage.soFar().looked, kept ? looked : 0);
        }
    }
}

}  // namespace
}  // namespace stereonav
