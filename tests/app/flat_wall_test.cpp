// What a colon offers the window: its wall laid flat, and its line matched with another one's.
#include "engine/scene/flat_wall.h"

#include <glm/geometric.hpp>

#include "app/scene/scene_loading.h"
#include "engine/base/error.h"
#include "engine/scene/capabilities.h"
#include "engine/scene/line_match.h"
#include "tests/app/volume_input.h"

namespace stereonav::test {
namespace {

class OfferedLine : public VolumeTest {
protected:
    std::unique_ptr<Scene> opened(const std::string& study, bool outside = false) const {
        SceneOptions options;
        options.scene = study;
        options.volume.cache = false;
        options.volume.isosurface = outside;
        Progress progress;
        return loadScene(options, SizeOption{}, progress);
    }
};

TEST_F(OfferedLine, APlaceOfTheFlatWallIsFoundAgain) {
    const auto scene = opened(maskedTube());
    const auto* const wall = scene->offered<const FlatWall>();
    ASSERT_TRUE(wall);
    Progress progress;
    const auto flat = wall->makeFlat(progress);
    const auto* const through = scene->offered<const LineThrough>();
    int places = 0;
    for (int y = 1; y < flat->height(); y += 5)
        for (int x = flat->width() / 4; x < 3 * flat->width() / 4; x += 5) {
            const auto there = flat->placeAt(x, y);
            if (!there) continue;
            ++places;
            EXPECT_NEAR(flat->columnAt(there->along), x, 1);
            EXPECT_NEAR(through->placeOnLine(there->line).along, there->along, 0.003);
            const auto pixels = flat->pixelsOf(there->wall, 0.01);
            ASSERT_EQ(pixels.size(), 1u);
            // To the next vertex, one in each voxel of 2 mm; above and below what is cut open it is the same.
            EXPECT_NEAR(pixels[0].x, x, 0.003 / flat->pixel());
        }
    EXPECT_GT(places, 50);
    EXPECT_FALSE(flat->placeAt(-1, 0));
    EXPECT_TRUE(flat->pixelsOf({1, 1, 1}, 0.02).empty()) << "a metre beside it";
    const Plane<PackedColor> plain = flat->picture(nullptr),
                             red = flat->picture(
                                 [](const glm::dvec3&, const glm::vec3&) { return glm::vec3(1, 0, 0); });
    const int x = flat->width() / 2, y = flat->height() / 2;
    EXPECT_NE(plain.at(x, y), red.at(x, y));
    EXPECT_EQ(plain.at(x, plain.height() - 1), red.at(x, red.height() - 1)) << "the scale is not painted";
}

TEST_F(OfferedLine, APlaceOfThePanoramaIsFoundAgain) {
    const auto scene = opened(maskedTube());
    Progress progress;
    const auto both = scene->offered<const FlatWall>()->makePanorama(progress);
    int places = 0, found = 0;
    for (int y = 1; y < both->height(); y += 5)
        for (int x = 1; x < both->width(); x += 5) {
            const auto there = both->placeAt(x, y);
            if (!there) continue;
            ++places;
            EXPECT_NEAR(both->columnAt(there->along), x, 1e-6);
            // The next vertex, one in each voxel of 2 mm, shows in both strips or in one.
            for (const glm::dvec2& pixel : both->pixelsOf(there->wall, 0.01))
                found += std::abs(pixel.x - x) < 0.004 / both->pixel() &&
                         (pixel.y < 0.5 * both->height()) == (y < 0.5 * both->height());
        }
    EXPECT_GT(places, 50);
    EXPECT_GT(found, 0.8 * places);
    EXPECT_FALSE(both->placeAt(-1, 0));
    EXPECT_FALSE(both->placeAt(0, both->height()));
    EXPECT_FALSE(both->placeAt(0, -1));
    EXPECT_FALSE(both->placeAt(both->width(), 0));
    EXPECT_FALSE(both->placeAt(both->width() / 2, both->height() / 2)) << "between the strips";
    EXPECT_TRUE(both->pixelsOf({1, 1, 1}, 0.02).empty());
    const auto red = [](const glm::dvec3&, const glm::vec3&) { return glm::vec3(1, 0, 0); };
    const Plane<PackedColor> plain = both->picture(nullptr), painted = both->picture(red);
    const int x = both->width() / 2, middle = both->height() / 2;
    EXPECT_NE(plain.at(x, 5), painted.at(x, 5));
    EXPECT_NE(plain.at(x, both->height() - 5), painted.at(x, both->height() - 5));
    EXPECT_EQ(plain.at(x, middle), painted.at(x, middle)) << "between the strips nothing is painted";
}

TEST_F(OfferedLine, MatchesItselfAndNoOtherSurface) {
    const std::string study = maskedTube();
    const auto scene = opened(study), outside = opened(study, true);
    const auto* const line = scene->offered<const MatchingLine>();
    ASSERT_TRUE(line);
    EXPECT_FALSE(outside->offered<const MatchingLine>());
    EXPECT_FALSE(outside->offered<const FlatWall>());
    const auto match = line->matchWith(*scene);
    EXPECT_NEAR(match->cost(), 0, 1e-9);
    EXPECT_NEAR(match->toOther(0.02), 0.02, 1e-6);
    EXPECT_NEAR(match->fromOther(0.02), 0.02, 1e-6);
    EXPECT_THROW(line->matchWith(*outside), Error);
    for (const double along : {0.0, 0.02, 1.0}) {
        const Pose ahead = line->poseOnLine(along, false), back = line->poseOnLine(along, true);
        EXPECT_NEAR(glm::dot(ahead.forward(), back.forward()), -1, 1e-9);
        EXPECT_LT(glm::distance(ahead.position, back.position), 1e-12);
        EXPECT_FALSE(looksBack(*line, along, ahead));
        EXPECT_TRUE(looksBack(*line, along, back));
    }
}

}  // namespace
}  // namespace stereonav::test
