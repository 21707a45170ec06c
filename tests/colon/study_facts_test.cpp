// Values looked at while samples still come, against all of them looked at once they are there.
#include "colon/study/study_facts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <utility>
#include <vector>

#include "engine/base/parallel.h"

namespace stereonav {
namespace {

// A study large enough for a thread of its own.
RawStudy zerosOf64Megabytes() {
    RawStudy raw;
    raw.type = SampleType::UInt8;
    raw.frame.size = {1024, 1024, 65};
    raw.bytes = LazyArray<unsigned char>(raw.frame.count());
    return raw;
}

// 8-bit noise, but for a first slice of two values and a last one of zeros.
RawStudy noiseOf64Megabytes() {
    RawStudy raw = zerosOf64Megabytes();
    const std::size_t perSlice = std::size_t{1024} * 1024;
    std::uint32_t state = 1;
    for (std::size_t n = 0; n < raw.frame.count() - perSlice; ++n) {
        state = state * 1664525u + 1013904223u;
        raw.bytes[n] = static_cast<unsigned char>(n < perSlice ? (state >> 31) * 7 : 3 + (state >> 24) % 200);
    }
    return raw;
}

void expectSameFacts(const ValueFacts& a, const ValueFacts& b) {
    EXPECT_EQ(a.lowest, b.lowest);
    EXPECT_EQ(a.highest, b.highest);
    EXPECT_EQ(a.pairs, b.pairs);
    EXPECT_EQ(a.equalPairs, b.equalPairs);
    EXPECT_EQ(a.many, b.many);
    EXPECT_EQ(a.distinct, b.distinct);
    EXPECT_EQ(a.notNumbers, b.notNumbers);
    EXPECT_EQ(a.fractions, b.fractions);
}

TEST(StudyFacts, AreTheSameWhileSamplesCome) {
    const int threads = threadCount();
    setThreadCount(2);
    const RawStudy whole = noiseOf64Megabytes();
    const ValueFacts expected = factsOf(whole, {});
    RawStudy coming = zerosOf64Megabytes();
    FactsBeside beside(coming);
    const std::size_t perSlice = std::size_t{1024} * 1024, block = 5 * perSlice / 2;  // ends within slices
    for (std::size_t at = 0; at < coming.frame.count(); at += block) {
        const std::size_t count = std::min(block, coming.frame.count() - at);
        std::memcpy(coming.bytes.data() + at, whole.bytes.data() + at, count);
        beside.come(at + count);
    }
    SliceLooks looks = beside.take();
    EXPECT_LE(looks.facts.size(), 65u);
    EXPECT_TRUE(looks.air.empty());
    expectSameFacts(factsOf(coming, std::move(looks.facts)), expected);
    EXPECT_EQ(expected.lowest, 0);
    EXPECT_EQ(expected.highest, 202);
    setThreadCount(threads);
}

TEST(StudyFacts, OfAReadingThatEndsEarlyAreLeft) {
    const int threads = threadCount();
    setThreadCount(2);
    const RawStudy raw = zerosOf64Megabytes();
    {
        FactsBeside beside(raw);  // nothing comes
    }
    FactsBeside beside(raw);
    beside.come(3 * 1024 * 1024 + 1);
    EXPECT_LE(beside.take().facts.size(), 3u);
    setThreadCount(threads);
}

TEST(StudyFacts, StartNoThreadWhereThereIsOne) {
    const int threads = threadCount();
    setThreadCount(1);
    const RawStudy raw = zerosOf64Megabytes();
    FactsBeside beside(raw);
    beside.come(raw.frame.count());
    EXPECT_TRUE(beside.take().facts.empty());
    setThreadCount(threads);
}

// However many of the first slices are known already.
TEST(StudyFacts, AirIsThatOfTheWholeVolume) {
    RawStudy raw;
    raw.frame.size = {37, 5, 9};
    raw.bytes = LazyArray<unsigned char>(raw.frame.count() * 2);
    auto* samples = reinterpret_cast<std::int16_t*>(raw.bytes.data());
    GreyVolume grey(raw.frame);
    std::uint32_t state = 5;
    for (std::size_t n = 0; n < raw.frame.count(); ++n) {
        state = state * 1664525u + 1013904223u;
        samples[n] = grey.values[n] = static_cast<std::int16_t>(-1000 + (state >> 24) * 2);
    }
    const VoxelRuns expected = runsBelow(grey, -700);
    ASSERT_GT(expected.runs.size(), 100u);
    for (const int known : {0, 4, 9}) {
        SliceLooks looks;
        for (int k = 0; k < known; ++k) addLook(lookAtSlice(raw, k, false, -700), looks);
        const VoxelRuns air = airOf(raw, -700, std::move(looks.air));
        EXPECT_EQ(air.size, expected.size);
        EXPECT_EQ(air.rowStart, expected.rowStart);
        ASSERT_EQ(air.runs.size(), expected.runs.size());
        EXPECT_EQ(std::memcmp(air.runs.data(), expected.runs.data(), air.runs.size() * sizeof(VoxelRun)), 0);
    }
    EXPECT_TRUE(showsAir(raw));
    raw.slope = 2;
    EXPECT_FALSE(showsAir(raw));
}

// Pairs of neighbours by the plain rule, in rows longer than what is counted at once.
TEST(StudyFacts, CountPairsInLongRows) {
    RawStudy raw;
    raw.type = SampleType::Int16;
    raw.frame.size = {70'001, 2, 2};
    raw.bytes = LazyArray<unsigned char>(raw.frame.count() * 2);
    auto* samples = reinterpret_cast<std::int16_t*>(raw.bytes.data());
    std::uint32_t state = 3;
    for (std::size_t n = 0; n < raw.frame.count(); ++n) {
        state = state * 1664525u + 1013904223u;
        samples[n] = static_cast<std::int16_t>(n < 1000 || state >> 31 ? state >> 16 : 0);
    }
    std::size_t pairs = 0, equal = 0;
    for (std::size_t row = 0; row < 4; ++row)
        for (std::size_t i = 1; i < 70'001; ++i) {
            const std::int16_t a = samples[row * 70'001 + i], b = samples[row * 70'001 + i - 1];
            pairs += a != 0 || b != 0;
            equal += a == b && a != 0;
        }
    const ValueFacts facts = factsOf(raw, {});
    EXPECT_EQ(facts.pairs, pairs);
    EXPECT_EQ(facts.equalPairs, equal);
    EXPECT_TRUE(facts.many);
}

}  // namespace
}  // namespace stereonav
