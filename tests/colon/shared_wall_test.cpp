// One wall for all instruments of a colon, for as long as one of them has it.
#include "colon/instruments/shared_wall.h"

#include <gtest/gtest.h>

#include <thread>

#include "colon/scene/colon_scene.h"
#include "tests/colon/lumen_wall.h"

namespace stereonav::test {
namespace {

ColonScene ballColon() {
    LumenField lumen = lumenOf([](const glm::dvec3& p) { return toBall(p, glm::dvec3(0), 0.01); },
                               glm::dvec3(-0.012), glm::dvec3(0.012), glm::dvec3(0.001));
    ColonScene colon;
    Progress progress;
    SurfaceSetting setting;
    setting.isovalue = setting.lowest = setting.highest = static_cast<float>(lumen.isovalue);
    setting.region = &lumen.lumen;
    colon.volume.cells = findSurfaceCells(lumen.field, setting, progress);
    colon.volume.field = std::move(lumen.field);
    colon.lumen.lumen = std::move(lumen.lumen);
    return colon;
}

TEST(SharedWall, IsOneWhileSomebodyHasIt) {
    const ColonScene colon = ballColon();
    const SharedWall shared(colon);
    Progress progress;
    std::shared_ptr<const JoinedWall> first, second;
    std::thread other([&] {
        Progress own;
        first = shared.get(own);
    });
    second = shared.get(progress);
    other.join();
    EXPECT_EQ(first, second);
    EXPECT_GT(first->mesh.places.size(), 100u);
    EXPECT_EQ(first->neighbours.first.size(), first->mesh.places.size() + 1);
    const std::weak_ptr<const JoinedWall> kept = first;
    first.reset();
    second.reset();
    EXPECT_TRUE(kept.expired()) << "nothing is held once nobody measures";
    EXPECT_GT(shared.get(progress)->mesh.places.size(), 100u);
}

// One who is cancelled leaves it to be made by the next.
TEST(SharedWall, IsMadeAfterACancelledTry) {
    const ColonScene colon = ballColon();
    const SharedWall shared(colon);
    Progress cancelled;
    cancelled.cancel();
    EXPECT_THROW(shared.get(cancelled), Cancelled);
    Progress progress;
    EXPECT_GT(shared.get(progress)->mesh.places.size(), 100u);
}

}  // namespace
}  // namespace stereonav::test
