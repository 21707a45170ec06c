// What is decided of a scene before it is read.
#include "app/scene/shown_as.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "app/scene/scene_loading.h"
#include "engine/base/error.h"

namespace stereonav {
namespace {

SceneOptions named(const std::string& scene, const std::string& medium = "") {
    SceneOptions options;
    options.scene = scene;
    options.medium.medium = medium;
    return options;
}

TEST(ShownAs, AMediumIsNamedOrIsNothingElse) {
    EXPECT_TRUE(shownAs(named("cloud")).swept);
    EXPECT_TRUE(shownAs(named("wax")).swept);
    EXPECT_TRUE(shownAs(named("terrain", "ground")).swept);
    EXPECT_TRUE(shownAs(named("no such file", "tissue")).swept) << "nothing is read";
    for (const char* scene : {"", "terrain", "colon", "no such file", "cloud.nrrd"})
        EXPECT_FALSE(shownAs(named(scene)).swept) << scene;
}

TEST(ShownAs, OptionsAreToldByTheSameDecision) {
    using namespace scene_type;
    EXPECT_EQ(sceneTypeOf(named("terrain")), kTerrain);
    EXPECT_EQ(sceneTypeOf(named("terrain", "ground")), kTerrainMedium);
    EXPECT_EQ(sceneTypeOf(named("colon")), kColon);
    EXPECT_EQ(sceneTypeOf(named("colon", "tissue")), kColonMedium);
    EXPECT_EQ(sceneTypeOf(named("wax")), kBuiltInMedium);
    EXPECT_EQ(sceneTypeOf(named("wax", "tissue")), kBuiltInMedium);
    EXPECT_EQ(sceneTypeOf(named("no such file")), std::nullopt);
}

TEST(ShownAs, MethodsAreThoseOfItsFrames) {
    EXPECT_NO_THROW(checkMethod(named("terrain"), "linear"));
    EXPECT_NO_THROW(checkMethod(named("cloud"), "two-sweeps"));
    for (const char* scene : {"terrain", "cloud"})
        EXPECT_NO_THROW(checkMethod(named(scene), "auto")) << scene;
    EXPECT_THROW(checkMethod(named("terrain"), "two-sweeps"), Error);
    EXPECT_THROW(checkMethod(named("terrain", "ground"), "linear"), Error);
    for (const char* scene : {"terrain", "wax"}) {
        Progress progress;
        const auto loaded = loadScene(named(scene), {32, 24}, progress);
        EXPECT_TRUE(std::ranges::equal(loaded->frames().methods(), shownAs(named(scene)).methods)) << scene;
    }
}

}  // namespace
}  // namespace stereonav
