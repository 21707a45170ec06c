// Coverage in flight: what it costs while it is off, that it agrees with the command, what of it is kept, and
// what the window's frames add to it.
#include "app/view/live_coverage.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <string>

#include "app/scene/scene_loading.h"
#include "app/scene/volume/flights.h"
#include "colon/instruments/shared_wall.h"
#include "colon/scene/colon_scene.h"
#include "engine/base/file.h"
#include "engine/scene/surface_paint.h"
#include "tests/camera/temporary_folder.h"
#include "tests/support/byte_study.h"
#include "tests/support/own_cache.h"
#include "tests/support/wait_for.h"
#include "tests/view/fake_frames.h"
#include "tests/view/fake_scene.h"

namespace stereonav {
namespace {

namespace fs = std::filesystem;

// Returns a tube along z, 16 mm wide and 60 mm long with two rings in it: a mask of 1 mm.
std::shared_ptr<const Scene> ringedTube() {
    static const std::shared_ptr<const Scene> scene = [] {
        const TemporaryFolder folder;
        const fs::path file =
            test::writeByteStudy(folder / "tube.nrrd", {24, 24, 66}, {0, 0, 0}, [](int i, int j, int k) {
                const double wide = std::abs(k - 22) < 2 || std::abs(k - 44) < 2 ? 5 : 8;
                return std::hypot(i - 11.5, j - 11.5) < wide && k > 2 && k < 63;
            });
        SceneOptions options;
        options.scene = file.string();
        options.volume.cache = false;
        Progress progress;
        return std::shared_ptr<const Scene>(loadScene(options, {64, 64}, progress));
    }();
    return scene;
}

EyeView eyeAt(const Pose& pose) {
    Lens lens = ringedTube()->lens;
    lens.width = lens.height = 1;
    return makeEyeView(pose, lens);
}

// Returns the percentage of `coverage`, for a square picture.
double percentByCommand(bool bothWays, const WallLooking& looking = {}) {
    const auto& colon = *ringedTube()->offered<const ColonScene>();
    const auto& inside = *ringedTube()->offered<const ColonInterior>();
    const auto free = [&](const glm::dvec3& p, double upTo) { return colon.freeDistanceAt(p, upTo); };
    const ColonFlights flights = colonFlights(colon, "", kFlightStep, free, inside);
    Progress progress;
    const std::shared_ptr<const JoinedWall> wall = joinedWall(colon, progress);
    const LineOfSight sight(colon.volume.field, colon.volume.cells, colon.lumen.isovalue);
    CoverageSetting setting;
    setting.verticalFov = ringedTube()->lens.verticalFov;
    setting.within = looking.within;
    setting.angle = looking.angle;
    Coverage coverage(wall->mesh, wall->neighbours, sight, setting);
    coverage.look(flights.there, progress);
    if (bothWays) coverage.look(flights.back, progress);
    return coverage.percent();
}

void settle(LiveCoverage& coverage) {
    EXPECT_TRUE(test::waitFor([&] {
        coverage.poll();
        return !coverage.busy();
    }));
}

std::ptrdiff_t threadsOfThisProcess() {
    return std::distance(fs::directory_iterator("/proc/self/task"), fs::directory_iterator());
}

TEST(LiveCoverage, CostsNothingWhileItIsOff) {
    const auto scene = ringedTube();
    EXPECT_TRUE(scene->offered<SurfacePaint>()->empty());
    const auto before = threadsOfThisProcess();
    LiveCoverage coverage([] {});
    coverage.open(scene, "");
    ASSERT_TRUE(coverage.can());
    coverage.show(eyeAt(scene->startPose), 0, true);
    EXPECT_EQ(threadsOfThisProcess(), before);
    EXPECT_FALSE(coverage.poll());
    EXPECT_FALSE(coverage.soFar().painter);
    EXPECT_FALSE(coverage.busy());
    EyeImage image;
    EXPECT_EQ(paintEye(*scene, eyeAt(scene->startPose), image), 0);
    coverage.switchOn(true);
    EXPECT_GT(threadsOfThisProcess(), before);
    coverage.switchOn(false);
    // A joined thread has left its code, but Linux may list it for a moment more.
    EXPECT_TRUE(test::waitFor([&] { return threadsOfThisProcess() == before; })) << threadsOfThisProcess();
    EXPECT_FALSE(coverage.soFar().painter);
}

TEST(LiveCoverage, SaysOfTheScenesFlightWhatTheCommandSays) {
    LiveCoverage coverage([] {});
    coverage.open(ringedTube(), "");
    coverage.switchOn(true);
    coverage.addOwnFlight(false);
    settle(coverage);
    const double oneWay = percentByCommand(false);
    EXPECT_DOUBLE_EQ(coverage.soFar().percent, oneWay);
    EXPECT_TRUE(coverage.soFar().painter);
    coverage.addOwnFlight(true);  // the way there once more adds nothing
    settle(coverage);
    EXPECT_DOUBLE_EQ(coverage.soFar().percent, percentByCommand(true));
    EXPECT_GT(coverage.soFar().percent, oneWay);
    WallLooking looking;
    looking.within = 0.02;
    looking.angle = 1;
    coverage.judgeBy(looking);
    settle(coverage);
    EXPECT_DOUBLE_EQ(coverage.soFar().percent, percentByCommand(true, looking));
    coverage.startAgain();
    settle(coverage);
    EXPECT_EQ(coverage.soFar().percent, 0);
}

TEST(LiveCoverage, LooksFromWhatIsShown) {
    LiveCoverage coverage([] {});
    coverage.open(ringedTube(), "");
    coverage.switchOn(true);
    const std::vector<Pose> flight = ringedTube()->offered<WallToSee>()->ownFlight(false);
    double seconds = 10;
    for (const Pose& pose : flight) coverage.show(eyeAt(pose), seconds += 0.1, false);
    settle(coverage);
    // Where the flight is slow its steps are shorter than those of the views that are used.
    EXPECT_NEAR(coverage.soFar().percent, percentByCommand(false), 0.5);
    double metres = 0;
    for (std::size_t n = 1; n < flight.size(); ++n)
        metres += glm::length(flight[n].position - flight[n - 1].position);
    EXPECT_NEAR(coverage.metres(), metres, 1e-9);
    EXPECT_NEAR(coverage.seconds(), 0.1 * static_cast<double>(flight.size() - 1), 1e-6);
    // The same place again is no new view, and a leap is no flight.
    const std::size_t looked = coverage.soFar().looked;
    coverage.show(eyeAt(flight.back()), seconds += 0.1, true);
    Pose far = flight.back();
    far.position.z += 1;
    coverage.show(eyeAt(far), seconds += 0.1, false);
    settle(coverage);
    EXPECT_EQ(coverage.soFar().looked, looked + 1);
    EXPECT_NEAR(coverage.metres(), metres, 1e-9);
}

TEST(LiveCoverage, StepsThroughUnseenPartsFromTheLargest) {
    LiveCoverage coverage([] {});
    coverage.open(ringedTube(), "");
    WallLooking looking;
    looking.smallestPatch = 1e-6;
    coverage.judgeBy(looking);
    EXPECT_EQ(coverage.step(1), nullptr);
    coverage.switchOn(true);
    coverage.addOwnFlight(false);
    settle(coverage);
    std::vector<double> areas;
    for (const UnseenPart& part : coverage.soFar().unseen)
        if (part.view) areas.push_back(part.area);
    ASSERT_GT(areas.size(), 1u) << "behind both rings";
    for (const double area : areas) EXPECT_EQ(coverage.step(1)->area, area);
    EXPECT_EQ(coverage.step(1)->area, areas.front()) << "round";
    EXPECT_EQ(coverage.step(-1)->area, areas.back());
    // The part is seen from there.
    const UnseenPart largest = *coverage.step(1);
    coverage.show(eyeAt(*largest.view), 0, true);
    settle(coverage);
    EXPECT_LT(coverage.soFar().unseen.front().area, largest.area);
}

TEST(LiveCoverage, IsKeptAndLookedAtAgain) {
    const TemporaryFolder folder;
    const fs::path file = folder / "coverage" / "tube.json";
    double percent = 0, metres = 0;
    {
        LiveCoverage coverage([] {});
        coverage.open(ringedTube(), file);
        coverage.switchOn(true);
        double seconds = 0;
        for (const Pose& pose : ringedTube()->offered<WallToSee>()->ownFlight(false))
            coverage.show(eyeAt(pose), seconds += 0.1, false);
        settle(coverage);
        percent = coverage.soFar().percent;
        metres = coverage.metres();
    }
    LiveCoverage again([] {});
    again.open(ringedTube(), file);
    again.switchOn(true);
    settle(again);
    EXPECT_NEAR(again.soFar().percent, percent, 0.05) << "places to a hundredth of a millimetre";
    EXPECT_NEAR(again.metres(), metres, 0.001);
    again.startAgain();
    again.switchOn(false);
    std::string problem;
    EXPECT_TRUE(readFlown(file, problem).eyes.empty());
    EXPECT_EQ(problem, "");
}

// The file is there and whole though the program is not ended properly.
TEST(LiveCoverage, IsWrittenWhileOneFlies) {
    const TemporaryFolder folder;
    const fs::path file = folder / "coverage" / "tube.json";
    LiveCoverage coverage([] {});
    coverage.open(ringedTube(), file);
    coverage.switchOn(true);
    coverage.show(eyeAt(ringedTube()->startPose), 1, true);
    std::string problem;
    ASSERT_TRUE(test::waitFor([&] { return fs::exists(file); }));
    EXPECT_EQ(readFlown(file, problem).eyes.size(), 1u);
    Pose ahead = ringedTube()->startPose;
    ahead.position += 0.01 * ahead.forward();
    coverage.show(eyeAt(ahead), 1.5, false);
    ASSERT_TRUE(test::waitFor([&] { return readFlown(file, problem).eyes.size() == 2; }));
    EXPECT_EQ(problem, "");
    EXPECT_NEAR(readFlown(file, problem).metres, 0.01, 0.0006);
}

TEST(LiveCoverage, SetsADamagedFileAside) {
    const TemporaryFolder folder;
    fs::create_directories(folder / "coverage");
    const fs::path file = folder / "coverage" / "tube.json";
    for (const char* text :
         {"no json", R"({"stereonav_coverage": 2, "metres": 0, "seconds": 0, "eyes": []})",
          R"({"stereonav_coverage": 1, "metres": -1, "seconds": 0, "eyes": []})",
          R"({"stereonav_coverage": 1, "metres": 0, "seconds": 0, "eyes": [[0,0,0,1,0,0,0,-1,1,-1]]})",
          R"({"stereonav_coverage": 1, "metres": 0, "seconds": 0, "eyes": [[0,0,0,9,0,0,0,-1,1,-1,1]]})"}) {
        std::ofstream(file) << text;
        LiveCoverage coverage([] {});
        coverage.open(ringedTube(), file);
        coverage.switchOn(true);
        ASSERT_TRUE(test::waitFor([&] { return !coverage.problem().empty(); }));
        EXPECT_NE(coverage.problem().find("tube.json"), std::string::npos) << coverage.problem();
        EXPECT_TRUE(fs::exists(file.string() + ".damaged")) << text;
        coverage.switchOn(false);
        fs::remove(file);
    }
}

TEST(LiveCoverage, IsNotOfScenesWithoutSuchAWall) {
    LiveCoverage coverage([] {});
    coverage.open(std::make_shared<FakeScene>(FakeParts{}), "");
    EXPECT_FALSE(coverage.can());
    coverage.switchOn(true);
    coverage.addOwnFlight(true);
    coverage.startAgain();
    EXPECT_FALSE(coverage.busy());
    coverage.replaceScene(ringedTube());
    EXPECT_TRUE(coverage.can());
    settle(coverage);
    EXPECT_TRUE(coverage.soFar().any) << "it was on";
}

TEST(LiveCoverage, GoesOnInASceneThatTakesTheOthersPlace) {
    LiveCoverage coverage([] {});
    coverage.open(ringedTube(), "");
    coverage.switchOn(true);
    coverage.addOwnFlight(false);
    settle(coverage);
    const double percent = coverage.soFar().percent;
    coverage.replaceScene(ringedTube());
    settle(coverage);
    EXPECT_DOUBLE_EQ(coverage.soFar().percent, percent);
}

}  // namespace
}  // namespace stereonav
