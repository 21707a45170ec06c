// Marks on a wall: found again at places of it, and painted alike in both eyes.
#include "colon/instruments/wall_marks.h"

#include <gtest/gtest.h>

#include "colon/instruments/wall_painter.h"
#include "engine/camera/stereo_rig.h"
#include "tests/colon/lumen_wall.h"

namespace stereonav::test {
namespace {

LumenWall markedTube() {
    return {[](const glm::dvec3& p) { return toTube(p, 0.012, -0.03, 0.03); },
            {-0.015, -0.015, -0.033},
            {0.015, 0.015, 0.033},
            0.0008};
}

std::vector<float> halfMarked(const WallMesh& mesh) {
    std::vector<float> marks;
    for (const glm::vec3& place : mesh.places) marks.push_back(place.z > 0 ? 1.0f : 0.0f);
    return marks;
}

TEST(WallMarks, AreFoundAtTheirPlaces) {
    const LumenWall tube = markedTube();
    const WallMarks marks(tube.mesh, tube.lumen.field.frame, halfMarked(tube.mesh));
    int tried = 0;
    for (std::size_t v = 0; v < tube.mesh.places.size(); ++v) {
        const glm::dvec3 place(tube.mesh.places[v]);
        const float mark = marks.at(place);
        ASSERT_GE(mark, 0);
        ASSERT_LE(mark, 1);
        if (std::abs(place.z) < 0.0017) continue;
        ++tried;
        EXPECT_NEAR(mark, place.z > 0 ? 1 : 0, 0.005) << place.z;
    }
    EXPECT_GT(tried, 3000);
    EXPECT_LT(marks.at({0, 0, 0}), 0) << "in the lumen";
    for (const double far : {1.0, -1.0, 1e30, -1e30, std::nan("")})
        EXPECT_LT(marks.at({far, 0, 0}), 0) << far;
}

// Along a line on the wall the mark rises without a step.
TEST(WallMarks, EndSoftly) {
    const LumenWall tube = markedTube();
    const WallMarks marks(tube.mesh, tube.lumen.field.frame,
                          softened(neighboursOf(tube.mesh), halfMarked(tube.mesh), 2));
    float before = 0;
    for (double z = -0.006; z < 0.006; z += 0.00005) {
        const float mark = marks.at({0.012 * std::cos(0.3), 0.012 * std::sin(0.3), z});
        ASSERT_GE(mark, 0) << z;
        EXPECT_LT(std::abs(mark - before), 0.08f) << z;
        before = mark;
    }
    EXPECT_GT(before, 0.99f);
}

TEST(WallMarks, OfNoWallAreNowhere) {
    VolumeFrame frame;
    frame.size = {8, 8, 8};
    EXPECT_LT(WallMarks({}, frame, {}).at({1, 1, 1}), 0);
}

// A pixel is tinted where its own depth meets a marked wall, and nothing else is touched.
TEST(WallMarks, ArePaintedByDepth) {
    const LumenWall tube = markedTube();
    const WallPainter painter(
        std::make_shared<const WallMarks>(tube.mesh, tube.lumen.field.frame, halfMarked(tube.mesh)),
        {0, 0, 2});
    EyeView view;
    view.eye = view.head = {0, 0, 0};
    view.forward = {1, 0, 0}, view.up = {0, 0, 1}, view.right = {0, -1, 0};
    view.width = view.height = 65;
    view.xMin = -0.5, view.xMax = 0.5, view.yMin = -0.5, view.yMax = 0.5;
    EyeImage image;
    image.resize(65, 65);
    const PackedColor grey = packColor(glm::vec3(0.25f));
    for (int y = 0; y < 65; ++y)
        for (int x = 0; x < 65; ++x) {
            const glm::dvec3 way = view.rayDirection(x + 0.5, y + 0.5);
            image.color.at(x, y) = grey;
            // x^2 + y^2 = radius^2 along the ray.
            image.viewDepth.at(x, y) = static_cast<float>(0.012 / std::hypot(way.x, way.y));
        }
    image.viewDepth.at(3, 3) = kMissDepth;
    image.viewDepth.at(4, 3) = 0;
    image.viewDepth.at(5, 3) = 0.006f;
    painter.paint(view, image);
    for (const int x : {3, 4, 5}) EXPECT_EQ(image.color.at(x, 3), grey) << x;
    EXPECT_NE(image.color.at(30, 3), grey) << "above: marked";
    EXPECT_GT(unpackColor(image.color.at(30, 3)).z, 0.4f);
    EXPECT_LT(unpackColor(image.color.at(30, 3)).x, 0.1f);
    EXPECT_EQ(image.color.at(30, 60), grey) << "below: not";
    for (const int row : {20, 45}) {  // between walls, as a warped silhouette: as the nearer one in depth
        EyeImage silhouette = image;
        for (int x = 0; x < 65; ++x) silhouette.color.at(x, row) = grey;
        silhouette.viewDepth.at(30, row) = 0.9f * silhouette.viewDepth.at(29, row);
        silhouette.viewDepth.at(31, row) = 0.4f * silhouette.viewDepth.at(29, row);
        painter.paint(view, silhouette);
        EXPECT_EQ(silhouette.color.at(30, row), silhouette.color.at(29, row)) << row;
        EXPECT_EQ(silhouette.color.at(30, row) == grey, row > 32) << row;
    }
}

}  // namespace
}  // namespace stereonav::test
