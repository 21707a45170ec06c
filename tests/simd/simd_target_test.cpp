#include "engine/simd/simd_target.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/base/error.h"

namespace stereonav {
namespace {

using testing::HasSubstr;

TEST(SimdTarget, LimitHidesWiderSets) {
    EXPECT_EQ(limitedTarget(SimdTarget::Avx512, nullptr), SimdTarget::Avx512);
    EXPECT_EQ(limitedTarget(SimdTarget::Avx512, ""), SimdTarget::Avx512);
    EXPECT_EQ(limitedTarget(SimdTarget::Avx512, "avx512"), SimdTarget::Avx512);
    EXPECT_EQ(limitedTarget(SimdTarget::Avx512, "avx2"), SimdTarget::Avx2);
    EXPECT_EQ(limitedTarget(SimdTarget::Avx512, "plain"), SimdTarget::Plain);
}

TEST(SimdTarget, LimitAddsNothing) {
    EXPECT_EQ(limitedTarget(SimdTarget::Plain, "avx512"), SimdTarget::Plain);
    EXPECT_EQ(limitedTarget(SimdTarget::Avx2, "avx512"), SimdTarget::Avx2);
}

TEST(SimdTarget, LimitThatIsNoSetIsRefused) {
    for (const char* limit : {"sse", "auto", "AVX2", " avx2"}) try {
            limitedTarget(SimdTarget::Avx512, limit);
            ADD_FAILURE() << limit;
        } catch (const Error& error) {
            EXPECT_THAT(error.what(), HasSubstr("STEREONAV_SIMD")) << limit;
            EXPECT_THAT(error.what(), HasSubstr("expected plain, avx2 or avx512")) << limit;
        }
}

TEST(SimdTarget, EverySetThatMayBeUsedIsListedNarrowestFirst) {
    const std::vector<SimdTarget> targets = simdTargets();
    ASSERT_FALSE(targets.empty());
    EXPECT_EQ(targets.front(), SimdTarget::Plain);
    EXPECT_EQ(targets.back(), availableTarget(SimdTarget::Auto));
    EXPECT_LE(targets.back(), widestOfProcessor());
    for (std::size_t k = 1; k < targets.size(); ++k) EXPECT_LT(targets[k - 1], targets[k]);
    for (const SimdTarget target : targets) EXPECT_EQ(availableTarget(target), target);
}

TEST(SimdTarget, WhatMayNotBeUsedIsRefusedByName) {
    for (const NamedSimdTarget& known : kSimdTargets) {
        if (known.target <= simdTargets().back()) continue;
        try {
            availableTarget(known.target);
            ADD_FAILURE() << known.name;
        } catch (const Error& error) {
            EXPECT_THAT(error.what(), HasSubstr(std::string(known.name)));
        }
    }
}

TEST(SimdTarget, KernelsAreThoseOfTheSet) {
    const int plain = 1, avx2 = 2, avx512 = 3;
    for (const SimdTarget target : simdTargets())
        EXPECT_EQ(kernelsOf(target, plain, avx2, avx512), static_cast<int>(target)) << nameOf(target);
}

}  // namespace
}  // namespace stereonav
