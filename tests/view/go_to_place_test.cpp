// Typed places in real scenes: ground with a place on the Earth, ground without, a colon, a volume from
// outside.
#include "app/view/go_to_place.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "app/view/loading.h"
#include "app/view/setting_texts.h"
#include "engine/scene/capabilities.h"
#include "terrain/scene/terrain_scene.h"
#include "tests/app/volume_input.h"

namespace stereonav::test {
namespace {

using testing::HasSubstr;

class TypedPlaces : public VolumeTest {
protected:
    std::shared_ptr<const OpenScene> opened(const std::string& scene) const {
        ViewOptions options = viewOptionsOf({{"SCENE", {scene}}});
        options.scene.detailLater = true;
        Progress progress;
        return std::make_shared<const OpenScene>(openScene(options, false, {64, 48}, nullptr, progress));
    }
    // Hills near Los Angeles, in UTM zone 11: 100 x 80 samples, 30 m apart.
    std::string placedHills() const {
        const std::string file =
            grid("placed.asc", 100, 80, 30.0, [](int i, int j) { return 1000 + (i + j) % 7; });
        std::string text = contentOf(file);
        text.replace(text.find("xllcorner 0"), 11, "xllcorner 392000");
        text.replace(text.find("yllcorner 0"), 11, "yllcorner 3801000");
        input("placed.prj",
              "PROJCS[\"WGS 84 / UTM zone 11N\",GEOGCS[\"WGS 84\",DATUM[\"WGS_1984\",SPHEROID[\"WGS "
              "84\",6378137,298.257223563]],PRIMEM[\"Greenwich\",0],UNIT[\"degree\",0.0174532925199433]],"
              "PROJECTION[\"Transverse_Mercator\"],PARAMETER[\"latitude_of_origin\",0],"
              "PARAMETER[\"central_meridian\",-117],PARAMETER[\"scale_factor\",0.9996],"
              "PARAMETER[\"false_easting\",500000],PARAMETER[\"false_northing\",0],UNIT[\"metre\",1]]");
        return input("placed.asc", text);
    }
};

// The file's middle is 393500 3802200: every way to write it leads there.
TEST_F(TypedPlaces, OverGroundThatKnowsWhereItLies) {
    const auto open = opened(placedHills());
    const Scene& scene = *open->scene;
    const auto* const earth = scene.offered<OnEarth>();
    ASSERT_NE(earth, nullptr);
    const auto at = earth->placeAt(glm::dvec3(0));
    ASSERT_TRUE(at);
    constexpr double kDegrees = 57.29577951308232;
    for (const std::string& text :
         {fmt::format("{:.8f},{:.8f}", kDegrees * at->latitude, kDegrees * at->longitude),
          fmt::format("{:.8f} W {:.8f} N", -kDegrees * at->longitude, kDegrees * at->latitude),
          std::string("11S 393500 3802200"), std::string("zone 11 393500 3802200"),
          std::string("393500 3802200")}) {
        SCOPED_TRACE(text);
        const auto found = findPlace(scene, text);
        ASSERT_TRUE(found && found->world) << (found ? found->problem : "");
        EXPECT_NEAR(found->world->x, 0, 0.1);
        EXPECT_NEAR(found->world->y, 0, 0.1);
        EXPECT_GE(found->world->z, 1000);
        EXPECT_THAT(found->words, HasSubstr(" N "));
    }
    const auto away = findPlace(scene, "48.1, 11.6");
    ASSERT_TRUE(away);
    EXPECT_THAT(away->problem, HasSubstr("expected latitude and longitude"));
    EXPECT_EQ(away->problem.find('\n'), std::string::npos);
    EXPECT_FALSE(findPlace(scene, "contours"));
    EXPECT_THAT(findPlace(scene, "250 mm")->problem, HasSubstr("expected"));
}

TEST_F(TypedPlaces, TheEyesLookAtThePlaceFromAbove) {
    const auto open = opened(placedHills());
    ViewSession session(open, {OutputMode::SideBySide, std::nullopt, place()});
    const auto found = findPlace(*open->scene, "393500 3802200");
    ASSERT_TRUE(found && found->world);
    goToPlace(session, *found);
    for (int n = 0; n < 500; ++n) session.step({}, 0.02);
    const Pose pose = session.pose();
    EXPECT_GT(pose.position.z, found->world->z + 5) << "over the ground";
    EXPECT_GT(glm::dot(glm::normalize(*found->world - pose.position), pose.forward()), 0.99) << "looks at it";
    EXPECT_LT(glm::distance(*found->world, pose.position), 1000) << "and is near";
}

TEST_F(TypedPlaces, OverGroundWithoutAPlaceOnTheEarth) {
    const auto open = opened(hills());
    const auto found = findPlace(*open->scene, "480 360");
    ASSERT_TRUE(found && found->world) << (found ? found->problem : "");
    const auto* const terrain = open->scene->offered<const TerrainScene>();
    EXPECT_TRUE(terrain->ground.contains(glm::dvec2(*found->world)));
    EXPECT_THAT(findPlace(*open->scene, "48000 360")->problem, HasSubstr("beside the ground"));
}

TEST_F(TypedPlaces, InAColon) {
    const auto open = opened(maskedTube());
    const Scene& scene = *open->scene;
    const auto* const line = scene.offered<LineThrough>();
    ASSERT_NE(line, nullptr);
    const auto along = findPlace(scene, "12 mm");
    ASSERT_TRUE(along && along->along) << (along ? along->problem : "");
    EXPECT_NEAR(*along->along, 0.012, 1e-12);
    const auto at = findPlace(scene, "-1 -1 0");
    ASSERT_TRUE(at && at->along) << (at ? at->problem : "");
    EXPECT_NEAR(*at->along, line->placeOnLine({-0.001, -0.001, 0}).along, 1e-9);
    for (const char* const text : {"9000 mm", "-5 mm", "-1 -1 900", "34.35,-118.1"})
        EXPECT_THAT(findPlace(scene, text)->problem, HasSubstr("expected left, posterior and head in mm"))
            << text;
    ViewSession session(open, {OutputMode::SideBySide, std::nullopt, place()});
    goToPlace(session, *along);
    for (int n = 0; n < 1000; ++n) session.step({}, 0.02);
    EXPECT_NEAR(line->placeOnLine(session.pose().position).along, 0.012, 0.002);
}

TEST_F(TypedPlaces, InAVolumeFromOutside) {
    const auto open = opened(ball());
    const auto found = findPlace(*open->scene, "0 0 0");
    ASSERT_TRUE(found && found->world) << (found ? found->problem : "");
    EXPECT_EQ(*found->world, glm::dvec3(0));
    EXPECT_THAT(findPlace(*open->scene, "0 0 999")->problem, HasSubstr("outside"));
}

}  // namespace
}  // namespace stereonav::test
