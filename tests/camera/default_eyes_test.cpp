// How far apart the eyes stand where nobody says it.
#include "engine/camera/default_eyes.h"

#include <gtest/gtest.h>

namespace stereonav::test {
namespace {

TEST(DefaultEyes, StandAShareOfTheScreensDistanceApart) {
    for (const double screen : {0.03, 1.95, 500.0}) {
        for (const SeenAs seen : {SeenAs::Ground, SeenAs::Track, SeenAs::Lumen, SeenAs::Outside}) {
            EXPECT_DOUBLE_EQ(defaultEyes(seen, screen).separation, screen / 30);
            EXPECT_EQ(defaultEyes(seen, screen).zeroParallax, screen);
        }
        EXPECT_DOUBLE_EQ(defaultEyes(SeenAs::Mesh, screen).separation, screen / 45);
    }
}

}  // namespace
}  // namespace stereonav::test
