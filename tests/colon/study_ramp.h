// A small volume whose numbers rise from voxel to voxel, and the header that goes with it: what the tests of
// volume files write and look for.
#pragma once

#include <gtest/gtest.h>

#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "colon/study/study.h"

namespace stereonav::test {

inline constexpr glm::ivec3 kSize(5, 4, 3);

template <typename T>
std::vector<T> ramp(double start = -300, double step = 17) {
    std::vector<T> values;
    for (int n = 0; n < kSize.x * kSize.y * kSize.z; ++n) values.push_back(static_cast<T>(start + step * n));
    return values;
}

inline void expectRamp(const Study& study, double start = -300, double step = 17) {
    ASSERT_FALSE(study.isMask);
    ASSERT_EQ(study.grey.frame.size, kSize);
    for (int k = 0, n = 0; k < kSize.z; ++k)
        for (int j = 0; j < kSize.y; ++j)
            for (int i = 0; i < kSize.x; ++i, ++n)
                EXPECT_EQ(study.grey.at(i, j, k) * study.grey.scale + study.grey.offset, start + step * n);
}

inline void expectNear(const glm::dvec3& a, const glm::dvec3& b, double tolerance = 1e-9) {
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(a[axis], b[axis], tolerance) << "axis " << axis;
}

inline const std::string kShortLines =
    "type: short\ndimension: 3\nspace: left-posterior-superior\nsizes: 5 4 3\n"
    "space directions: (0.5,0,0) (0,0.6,0) (0,0,2)\nendian: little\nencoding: raw\nspace origin: (7,8,9)\n";

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

}  // namespace stereonav::test
