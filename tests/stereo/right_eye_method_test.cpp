#include "engine/stereo/right_eye_method.h"

#include <gmock/gmock.h>

#include <set>

#include "engine/stereo/warp_method.h"

namespace stereonav {
namespace {

using testing::ElementsAre;

TEST(RightEyeMethods, NamesAndPlacesInTheList) {
    std::set<std::string_view> names;
    for (std::size_t n = 0; n < kRightEyeMethods.size(); ++n) {
        const NamedMethod& named = kRightEyeMethods[n];
        EXPECT_EQ(static_cast<std::size_t>(named.method), n) << named.name;
        EXPECT_EQ(nameOf(named.method), named.name);
        EXPECT_EQ(rightEyeMethodFromName(named.name), named.method) << named.name;
        EXPECT_TRUE(names.insert(named.name).second) << named.name;
    }
    EXPECT_FALSE(rightEyeMethodFromName("Linear"));
    EXPECT_FALSE(rightEyeMethodFromName(""));
}

TEST(RightEyeMethods, WhatFollowsFromEach) {
    std::vector<std::string_view> unwarped, black, jumps, dial;
    for (const NamedMethod& named : kRightEyeMethods) {
        if (!warpMethodOf(named.method).warpRow) unwarped.push_back(named.name);
        if (leavesHoles(named.method)) black.push_back(named.name);
        if (castsFromDepths(named.method)) jumps.push_back(named.name);
        if (hasQualityDial(named.method)) dial.push_back(named.name);
    }
    EXPECT_THAT(unwarped, ElementsAre("full"));
    EXPECT_THAT(black, ElementsAre("mcmillan", "nofill"));
    EXPECT_THAT(jumps, ElementsAre("depthsplat"));
    EXPECT_THAT(dial, ElementsAre("linear", "cubic", "selective"));
}

}  // namespace
}  // namespace stereonav
