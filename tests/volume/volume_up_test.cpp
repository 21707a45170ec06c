// A volume put upright: rotated, never mirrored, and nothing else.
#include "engine/volume/volume_up.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <string>

namespace stereonav {
namespace {

const char* const kAxes[] = {"x", "-x", "y", "-y", "z", "-z"};

UpAxis upAxis(const std::string& name) {
    return upAxisFromText(name).value_or(UpAxis{7, false});
}

glm::dvec3 directionOf(const UpAxis& up) {
    glm::dvec3 direction(0.0);
    direction[up.axis] = up.negative ? -1 : 1;
    return direction;
}

TEST(VolumeUp, NamesAreReadAndGivenBack) {
    for (const std::string name : kAxes) {
        const auto up = upAxisFromText(name);
        ASSERT_TRUE(up) << name;
        EXPECT_EQ(nameOf(*up), name);
    }
    for (const std::string name : {"", "-", "w", "X", "+x", "--x", "xy", "x ", "-zz", "0", "up"})
        EXPECT_FALSE(upAxisFromText(name)) << name;
}

TEST(VolumeUp, TurnsByWholeQuartersAndNeverMirrors) {
    for (const std::string name : kAxes) {
        SCOPED_TRACE(name);
        const glm::dmat3 turn = turnThatPutsUp(upAxis(name));
        EXPECT_EQ(glm::determinant(turn), 1.0);
        EXPECT_EQ(turn * glm::transpose(turn), glm::dmat3(1.0));
        EXPECT_EQ(turn * directionOf(upAxis(name)), glm::dvec3(0, 0, 1));
        for (int column = 0; column < 3; ++column)
            for (int row = 0; row < 3; ++row)
                EXPECT_TRUE(turn[column][row] == 0 || std::abs(turn[column][row]) == 1);
    }
    EXPECT_EQ(turnThatPutsUp(upAxis("z")), glm::dmat3(1.0));
    // A picture to the north stays a picture to the north.
    for (const std::string name : {"x", "-x", "-z"})
        EXPECT_EQ(turnThatPutsUp(upAxis(name)) * glm::dvec3(0, 1, 0), glm::dvec3(0, 1, 0)) << name;
}

TEST(VolumeUp, AVoxelGoesWhereTheWorldTurns) {
    for (const bool mirrored : {false, true})
        for (const std::string name : kAxes) {
            SCOPED_TRACE(name);
            VolumeFrame frame;
            frame.size = {5, 7, 9};
            frame.spacing = {0.5, 0.25, 2};
            frame.origin = {3, -4, 5};
            frame.axes =
                glm::dmat3(glm::dvec3(0, 1, 0), glm::dvec3(mirrored ? 1 : -1, 0, 0), glm::dvec3(0, 0, 1));
            const double handedness = glm::determinant(frame.axes);
            const glm::dvec3 marked(4, 2, 7), before = frame.worldFromVoxel(marked);
            VolumeFrame turned = frame;
            turnUp(turned, upAxis(name));
            EXPECT_EQ(turned.worldFromVoxel(marked), turnThatPutsUp(upAxis(name)) * before);
            EXPECT_EQ(turned.worldFromVoxel(marked).z, glm::dot(before, directionOf(upAxis(name))));
            EXPECT_EQ(turned.voxelFromWorld(turned.worldFromVoxel(marked)), marked);
            EXPECT_EQ(glm::determinant(turned.axes), handedness);
            EXPECT_EQ(turned.size, frame.size);
            EXPECT_EQ(turned.spacing, frame.spacing);
        }
}

}  // namespace
}  // namespace stereonav
