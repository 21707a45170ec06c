// What the scenes of a report are loaded by.
#include <gtest/gtest.h>

#include "app/report/run.h"

namespace stereonav {
namespace {

TEST(ReportScenes, AreOverARoundEarthWhereTheyAreGround) {
    ReportOptions report;
    EXPECT_FALSE(sceneOptionsFor(report, "terrain").curvature);
    report.curvature = true;
    report.refraction = 0.25;
    EXPECT_TRUE(sceneOptionsFor(report, "terrain").curvature);
    EXPECT_EQ(sceneOptionsFor(report, "terrain").refraction, 0.25);
    for (const char* other : {"colon", "cloud", "wax"})
        EXPECT_FALSE(sceneOptionsFor(report, other).curvature) << other;
}

}  // namespace
}  // namespace stereonav
