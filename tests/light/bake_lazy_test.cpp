// Background light on made-up samples: what is asked for becomes known, coarse first, the present wish before
// former ones, and nobody waits.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <future>
#include <limits>
#include <map>
#include <set>

#include "engine/light/bake/lazy_bake.h"
#include "tests/support/wait_for.h"
#include "tests/volume/test_volumes.h"

namespace stereonav {
namespace {

std::uint32_t brickOf(const TexelLayout& layout, const glm::ivec3& t) {
    return static_cast<std::uint32_t>(((t.z >> 3) * layout.bricks.y + (t.y >> 3)) * layout.bricks.x +
                                      (t.x >> 3));
}
bool isDead(const glm::ivec3& t) {
    return (3 * t.x + t.y + t.z) % 11 == 5;
}
double lazyTruth(const glm::ivec3& t) {
    return 0.5 + 0.01 * t.x + 0.02 * t.y;
}

constexpr double kLimit_s = static_cast<double>(test::kLongestWait.count());

// A ball's surface through 6^3 bricks; the source tells what it was asked, and answers as many calls as it
// may.
struct Background {
    Background() {
        source.addIrradiance = [this](std::span<const glm::ivec3> texels, int count,
                                      std::span<TexelSum> sums) {
            for (const glm::ivec3& t : texels)
                EXPECT_EQ(brickOf(to.layout, t), brickOf(to.layout, texels[0]));
            pass(texels, count);
            add(texels, count, sums);
        };
        choice.lowest = choice.highest = 160;
    }
    void pass(std::span<const glm::ivec3> texels, int count) {
        std::size_t call = 0;
        {
            const std::lock_guard lock(mutex);
            calls.push_back({brickOf(to.layout, texels[0]), static_cast<int>(texels.size()), count});
            call = calls.size();
        }
        test::waitFor([&] { return call <= mayPass; });
        if (slow) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    static void add(std::span<const glm::ivec3> texels, int count, std::span<TexelSum> sums) {
        for (std::size_t n = 0; n < texels.size(); ++n)
            for (int k = 0; k < count; ++k) {
                if (isDead(texels[n])) {
                    sums[n].samples = -1;
                    break;
                }
                const double noise = 0.1 * std::sin(12.9898 * sums[n].samples + texels[n].z);
                const auto value = static_cast<float>(lazyTruth(texels[n]) + noise);
                sums[n].samples += 1;
                sums[n].mean += (glm::vec3(value) - sums[n].mean) / sums[n].samples;
            }
    }
    std::vector<std::uint32_t> all() const {
        std::vector<std::uint32_t> bricks;
        for (std::uint32_t n = 0; n < to.layout.count() / 512; ++n) bricks.push_back(n);
        return bricks;
    }
    std::set<std::uint32_t> holding() const {
        Progress progress;
        std::set<std::uint32_t> bricks;
        for (const TexelBrick& b : wantedBricks(volume, volume.frame, choice, progress))
            bricks.insert(b.number);
        return bricks;
    }
    PackedTexel at(const glm::ivec3& t) const { return to.texels[to.layout.index(t.x, t.y, t.z)]; }

    struct Call {
        std::uint32_t brick;
        int texels, samples;
    };
    std::vector<Call> seen() {
        const std::lock_guard lock(mutex);
        return calls;
    }

    GreyVolume volume = test::greyVolume(test::slantedFrame({48, 48, 48}),
                                         [](const glm::dvec3& v) { return 10 * glm::length(v - 23.3); });
    TexelChoice choice;
    IlluminationVolume to{volume.frame};
    BakeSource source;
    std::atomic<std::size_t> mayPass = std::numeric_limits<std::size_t>::max();  // calls
    std::atomic<bool> slow = false;
    std::mutex mutex;
    std::vector<Call> calls;
};

TEST(LazyBake, WhatIsAskedForBecomesKnown) {
    for (const int threads : {1, 2, 4}) {
        Background b;
        LazyBake lazy(b.volume, b.choice, b.source, b.to, {32, 32, threads});
        EXPECT_TRUE(lazy.done());
        lazy.request(b.all());
        ASSERT_TRUE(lazy.waitUntilDone(kLimit_s));
        EXPECT_TRUE(lazy.done());
        Progress progress;
        std::size_t known = 0;
        for (const TexelBrick& brick : wantedBricks(b.volume, b.volume.frame, b.choice, progress))
            for (const glm::ivec3& t : texelsIn(b.to.layout, brick)) {
                ASSERT_EQ(texelWeight(b.at(t)), isDead(t) ? 0.0f : 1.0f);
                ASSERT_NEAR(texelLight(b.at(t)).x, isDead(t) ? 0 : lazyTruth(t), 0.05);
                known += !isDead(t);
            }
        EXPECT_EQ(lazy.texelsLit(), known);
        EXPECT_GT(lazy.changes(), 0u);
        std::size_t inVolume = 0;
        for (std::size_t n = 0; n < b.to.layout.count(); ++n) inVolume += texelWeight(b.to.texels[n]) > 0;
        EXPECT_EQ(inVolume, known) << "and nothing else";
    }
}

TEST(LazyBake, TheSameBytesAsTheWholeBake) {
    Background b;
    Progress progress;
    BakeSums sums(b.volume.frame, wantedBricks(b.volume, b.volume.frame, b.choice, progress), {});
    runBake(sums, b.source, {100, 0, 0}, progress);
    const IlluminationVolume whole = illuminationOf(sums);
    LazyBake lazy(b.volume, b.choice, b.source, b.to, {100, 100, 3});
    lazy.request(b.all());
    ASSERT_TRUE(lazy.waitUntilDone(kLimit_s));
    for (std::size_t n = 0; n < whole.layout.count(); ++n) ASSERT_EQ(b.to.texels[n], whole.texels[n]) << n;
}

TEST(LazyBake, OnlyWhatIsAskedFor) {
    Background b;
    LazyBake lazy(b.volume, b.choice, b.source, b.to);
    const std::set<std::uint32_t> holding = b.holding();
    const std::vector<std::uint32_t> some{*holding.begin(), *std::next(holding.begin(), 7), 99999999u,
                                          *holding.begin()};
    lazy.request(some);
    ASSERT_TRUE(lazy.waitUntilDone(kLimit_s));
    const std::vector<Background::Call> calls = b.seen();
    EXPECT_FALSE(calls.empty());
    for (const Background::Call& call : calls)
        ASSERT_TRUE(call.brick == some[0] || call.brick == some[1]) << call.brick;
    EXPECT_GT(lazy.texelsLit(), 20u);
    lazy.request({});
    EXPECT_TRUE(lazy.waitUntilDone(kLimit_s));
}

// One texel of a block in every brick, nearest bricks first, before a second one anywhere.
TEST(LazyBake, CoarseFirst) {
    Background b;
    std::vector<std::uint32_t> order = b.all();
    std::reverse(order.begin(), order.end());
    {
        LazyBake lazy(b.volume, b.choice, b.source, b.to, {8, 8, 1});
        lazy.request(order);
        ASSERT_TRUE(lazy.waitUntilDone(kLimit_s));
    }
    const std::size_t bricks = b.holding().size();
    const std::vector<Background::Call> calls = b.seen();
    ASSERT_GT(calls.size(), 2 * bricks);
    std::set<std::uint32_t> met;
    for (std::size_t n = 0; n < bricks; ++n) {
        ASSERT_LE(calls[n].texels, 8);
        ASSERT_TRUE(met.insert(calls[n].brick).second) << "one of each before another of any";
        ASSERT_TRUE(n == 0 || calls[n].brick < calls[n - 1].brick) << "in the order asked for";
    }
    for (std::size_t n = bricks; n < 2 * bricks; ++n) ASSERT_LE(calls[n].texels, 64);
}

// While the coarse texels are all there is, lookups anywhere on the surface find light.
TEST(LazyBake, UnknownTexelsBorrowFromTheirBlock) {
    Background b;
    const std::set<std::uint32_t> holding = b.holding();
    std::atomic<std::size_t> count = 0;
    BakeSource source;
    std::atomic<bool> hold = true;
    // Lets the first level through, then stands still.
    source.addIrradiance = [&](std::span<const glm::ivec3> texels, int samples, std::span<TexelSum> sums) {
        if (++count > holding.size()) test::waitFor([&] { return !hold; });
        Background::add(texels, samples, sums);
    };
    LazyBake lazy(b.volume, b.choice, source, b.to, {8, 8, 1});
    lazy.request(b.all());
    ASSERT_TRUE(test::waitFor([&] { return count > holding.size(); }));
    Progress progress;
    std::size_t own = 0, borrowed = 0, unknown = 0;
    for (const TexelBrick& brick : wantedBricks(b.volume, b.volume.frame, b.choice, progress))
        for (const glm::ivec3& t : texelsIn(b.to.layout, brick)) {
            const float weight = texelWeight(b.at(t));
            own += weight == 1;
            borrowed += weight > 0 && weight < 0.1f;
            unknown += weight == 0;
            ASSERT_NEAR(texelLight(b.at(t)).x, weight > 0 ? lazyTruth(t) : 0, 0.25);
        }
    EXPECT_GT(own, holding.size());
    EXPECT_GT(borrowed, 5 * own);
    EXPECT_LT(unknown, (own + borrowed) / 4)
        << "those on no surface, and blocks whose chosen texel is on none";
    hold = false;
}

TEST(LazyBake, AMovedWishIsServedFirst) {
    for (const int threads : {1, 2}) {
        Background b;
        LazyBake lazy(b.volume, b.choice, b.source, b.to, {64, 64, threads});
        const std::set<std::uint32_t> set = b.holding();
        const std::vector<std::uint32_t> holding(set.begin(), set.end());
        const std::vector<std::uint32_t> first(holding.begin(), holding.end() - 3),
            moved(holding.end() - 3, holding.end());
        b.mayPass = 20;
        lazy.request(first);
        ASSERT_TRUE(test::waitFor([&] { return b.seen().size() > 20; }));
        lazy.request(moved);
        const std::size_t before = b.seen().size();
        b.mayPass = std::numeric_limits<std::size_t>::max();
        ASSERT_TRUE(lazy.waitUntilDone(kLimit_s));
        const std::vector<Background::Call> calls = b.seen();
        // What was under way may end: one batch a thread, and one that had been looked for meanwhile.
        int old = 0;
        for (std::size_t n = before; n < calls.size(); ++n)
            old += std::find(moved.begin(), moved.end(), calls[n].brick) == moved.end();
        EXPECT_LE(old, 2 * threads);
        EXPECT_GT(calls.size(), before + 5);
        for (const std::uint32_t n : moved) {
            const std::vector<Background::Call>::const_iterator found = std::find_if(
                calls.begin(), calls.end(), [&](const Background::Call& c) { return c.brick == n; });
            EXPECT_NE(found, calls.end());
        }
    }
}

TEST(LazyBake, WhatWasBegunIsNotBegunAgain) {
    Background b;
    LazyBake lazy(b.volume, b.choice, b.source, b.to, {64, 64, 1});
    const std::set<std::uint32_t> holding = b.holding();
    std::vector<std::uint32_t> some(holding.begin(), std::next(holding.begin(), 4));
    // A wish that changes all the time, as when one moves.
    for (std::size_t n = 0; n < 60; ++n) {
        std::rotate(some.begin(), some.begin() + 1, some.end());
        b.mayPass = n;
        lazy.request(some);
        ASSERT_TRUE(test::waitFor([&] { return b.seen().size() > n || lazy.done(); }));
    }
    b.mayPass = std::numeric_limits<std::size_t>::max();
    ASSERT_TRUE(lazy.waitUntilDone(kLimit_s));
    long long samples = 0;
    for (const Background::Call& call : b.seen())
        samples += static_cast<long long>(call.texels) * call.samples;
    Progress progress;
    long long needed = 0;
    for (const TexelBrick& brick : wantedBricks(b.volume, b.volume.frame, b.choice, progress))
        if (std::find(some.begin(), some.end(), brick.number) != some.end())
            needed += 64LL * countTexels(brick.wanted);
    EXPECT_EQ(samples, needed);
}

// While all batches are held one asks for others; once they go on, a bake that is to end leaves the rest.
TEST(LazyBake, NobodyWaits) {
    constexpr std::size_t kFew = 1000;  // batches, of many thousands: those of seconds, not of milliseconds
    Background b;
    b.slow = true;
    b.mayPass = 0;
    std::size_t held = 0;
    {
        LazyBake lazy(b.volume, b.choice, b.source, b.to, {640, 640, 2});
        lazy.request(b.all());
        ASSERT_TRUE(test::waitFor([&] { return b.seen().size() == 2; }));
        const std::future<void> asked = std::async(std::launch::async, [&] {
            std::vector<std::uint32_t> order = b.all();
            TexelChoice other = b.choice;
            for (int n = 0; n < 41; ++n) {
                std::rotate(order.begin(), order.begin() + 1, order.end());
                lazy.request(order);
                other.lowest = other.highest = static_cast<float>(150 + n);
                lazy.setChoice(other);
            }
        });
        EXPECT_TRUE(test::waitFor(
            [&] { return asked.wait_for(std::chrono::seconds(0)) == std::future_status::ready; }));
        EXPECT_FALSE(lazy.waitUntilDone(0.01));
        held = b.seen().size();
        EXPECT_EQ(held, 2u) << "one of each thread";
        b.mayPass = std::numeric_limits<std::size_t>::max();
    }
    EXPECT_LT(b.seen().size(), held + kFew) << "ends after the batch under way";
}

TEST(LazyBake, OtherSurfacesWantOtherTexelsAndKeepWhatIsLit) {
    Background b;
    LazyBake lazy(b.volume, b.choice, b.source, b.to, {16, 16, 2});
    lazy.request(b.all());
    ASSERT_TRUE(lazy.waitUntilDone(kLimit_s));
    const std::uint64_t lit = lazy.texelsLit();
    std::vector<PackedTexel> before(b.to.texels.data(), b.to.texels.data() + b.to.layout.count());
    b.choice.lowest = b.choice.highest = 100;
    lazy.setChoice(b.choice);
    ASSERT_TRUE(lazy.waitUntilDone(kLimit_s));
    EXPECT_GT(lazy.texelsLit(), lit);
    for (std::size_t n = 0; n < before.size(); ++n)
        ASSERT_TRUE(texelWeight(before[n]) < 1 || b.to.texels[n] == before[n]) << n;
    Progress progress;
    for (const TexelBrick& brick : wantedBricks(b.volume, b.volume.frame, b.choice, progress))
        for (const glm::ivec3& t : texelsIn(b.to.layout, brick))
            ASSERT_EQ(texelWeight(b.at(t)), isDead(t) ? 0.0f : 1.0f);
    // And back: nothing is left to do.
    const std::size_t calls = b.seen().size();
    b.choice.lowest = b.choice.highest = 160;
    lazy.setChoice(b.choice);
    ASSERT_TRUE(lazy.waitUntilDone(kLimit_s));
    EXPECT_EQ(b.seen().size(), calls);
}

TEST(LazyBake, GoesOnToMoreSamples) {
    Background b;
    LazyBake lazy(b.volume, b.choice, b.source, b.to, {16, 100, 1});
    lazy.request(b.all());
    ASSERT_TRUE(lazy.waitUntilDone(kLimit_s));
    std::map<std::uint32_t, long long> samples;
    for (const Background::Call& call : b.seen())
        samples[call.brick] += static_cast<long long>(call.texels) * call.samples;
    Progress progress;
    for (const TexelBrick& brick : wantedBricks(b.volume, b.volume.frame, b.choice, progress)) {
        long long needed = 0;
        for (const glm::ivec3& t : texelsIn(b.to.layout, brick)) needed += isDead(t) ? 16 : 100;
        ASSERT_EQ(samples[brick.number], needed);
    }
}

TEST(LazyBake, WhatIsBakedAlreadyStays) {
    Background b;
    const std::uint32_t number = *b.holding().begin();
    const PackedTexel baked = packTexel(glm::vec3(9), 1);
    for (int t = 0; t < 512; t += 2) b.to.texels[number * 512u + t] = baked;
    LazyBake lazy(b.volume, b.choice, b.source, b.to);
    lazy.request({number});
    ASSERT_TRUE(lazy.waitUntilDone(kLimit_s));
    for (int t = 0; t < 512; t += 2) ASSERT_EQ(b.to.texels[number * 512u + t], baked);
    EXPECT_GT(lazy.texelsLit(), 0u);
}

// --- transfer

constexpr int kLazyOrder = 3;
const LazyBakeSetting kTransfer{48, 48, 2, {BakeKind::Transfer, kLazyOrder, 1}};

std::vector<glm::vec3> skyOf(float turn) {
    std::vector<glm::vec3> sky(kLazyOrder * kLazyOrder, glm::vec3(0.02f));
    sky[0] = {1.0f, 0.8f, 0.6f};
    sky[1] = glm::vec3(0.3f * std::cos(turn), 0.1f, 0.3f * std::sin(turn));
    return sky;
}

// Numbers that differ from sample to sample, texel to texel, coefficient to coefficient.
struct TransferBackground : Background {
    TransferBackground() {
        source = {};
        source.addTransfer = [this](std::span<const glm::ivec3> texels, int first, int count, int order,
                                    int channels, std::span<float> sums, std::span<std::uint8_t> alive) {
            EXPECT_EQ(order, kLazyOrder);
            pass(texels, count);
            const std::size_t each = static_cast<std::size_t>(order * order * channels);
            for (std::size_t n = 0; n < texels.size(); ++n) {
                alive[n] = !isDead(texels[n]);
                for (std::size_t c = 0; alive[n] && c < each; ++c)
                    for (int k = first; k < first + count; ++k)
                        sums[n * each + c] +=
                            static_cast<float>((c == 0 ? lazyTruth(texels[n]) : 0.1) +
                                               0.1 * std::sin(12.9 * k + 3.1 * c + texels[n].z));
            }
        };
    }
    // The bake without a window, under a sky.
    IlluminationVolume whole(const std::vector<glm::vec3>& sky, int samples) const {
        Progress progress;
        BakeSums sums(volume.frame, wantedBricks(volume, volume.frame, choice, progress), kTransfer.shape);
        runBake(sums, source, {samples, 0, 0}, progress);
        IlluminationVolume lit(volume.frame);
        transferOf(sums).relightAll(sky, lit);
        return lit;
    }
    void expectSame(const IlluminationVolume& other) const {
        for (std::size_t n = 0; n < other.layout.count(); ++n) ASSERT_EQ(to.texels[n], other.texels[n]) << n;
    }
};

TEST(LazyTransfer, TheSameBytesAsTheWholeBake) {
    for (const auto& [samples, threads] : {std::pair{1, 1}, std::pair{48, 3}, std::pair{150, 2}}) {
        TransferBackground b;
        LazyBakeSetting setting = kTransfer;
        setting.samples = setting.refineTo = samples;
        setting.threads = threads;
        LazyBake lazy(b.volume, b.choice, b.source, b.to, setting);
        lazy.setLight(skyOf(0));
        lazy.request(b.all());
        ASSERT_TRUE(lazy.waitUntilDone(kLimit_s));
        EXPECT_GT(lazy.texelsLit(), 1000u);
        b.expectSame(b.whole(skyOf(0), samples));
    }
}

// Light that is set before, while and after texels are lit is the same light.
TEST(LazyTransfer, TheSkyTurnsMeanwhile) {
    TransferBackground b;
    {
        b.mayPass = 0;
        LazyBake lazy(b.volume, b.choice, b.source, b.to, kTransfer);
        lazy.request(b.all());
        for (std::size_t n = 0; n < 100; ++n) {
            lazy.setLight(skyOf(0.1f * static_cast<float>(n)));
            b.mayPass = n;
            ASSERT_TRUE(test::waitFor([&] { return b.seen().size() > n; }));
        }
        EXPECT_FALSE(lazy.done()) << "it was turned while texels were lit";
        b.mayPass = std::numeric_limits<std::size_t>::max();
        ASSERT_TRUE(lazy.waitUntilDone(kLimit_s));
        b.expectSame(b.whole(skyOf(9.9f), kTransfer.samples));
        const std::size_t calls = b.seen().size();
        const std::uint64_t lit = lazy.texelsLit();
        lazy.setLight(skyOf(1));
        EXPECT_EQ(b.seen().size(), calls) << "nothing is lit anew";
        b.expectSame(b.whole(skyOf(1), kTransfer.samples));
        EXPECT_EQ(lazy.texelsLit(), lit);
    }
    EXPECT_TRUE(texelWeight(b.to.texels[b.to.layout.index(0, 0, 0)]) == 0) << "and nothing else is";
}

// Left alone midway, by another wish, it goes on where it was.
TEST(LazyTransfer, GoesOnWhereItWasLeft) {
    TransferBackground b;
    b.mayPass = 60;
    LazyBake lazy(b.volume, b.choice, b.source, b.to, kTransfer);
    lazy.setLight(skyOf(0));
    lazy.request(b.all());
    ASSERT_TRUE(test::waitFor([&] { return b.seen().size() > 60; }));
    lazy.request({});
    b.mayPass = std::numeric_limits<std::size_t>::max();
    ASSERT_TRUE(lazy.waitUntilDone(kLimit_s));
    lazy.request(b.all());
    ASSERT_TRUE(lazy.waitUntilDone(kLimit_s));
    b.expectSame(b.whole(skyOf(0), kTransfer.samples));
    long long samples = 0, needed = 0;
    for (const Background::Call& call : b.seen())
        samples += static_cast<long long>(call.texels) * call.samples;
    Progress progress;
    for (const TexelBrick& brick : wantedBricks(b.volume, b.volume.frame, b.choice, progress))
        for (const glm::ivec3& t : texelsIn(b.to.layout, brick)) needed += isDead(t) ? 24 : 48;
    // The bake without a window added its own calls, once.
    EXPECT_EQ(samples, 2 * needed) << "no sample is made twice";
}

// While coarse texels are all there is, others borrow from them, also after the sky has turned.
TEST(LazyTransfer, BorrowedLightTurnsToo) {
    TransferBackground b;
    const std::size_t bricks = b.holding().size();
    std::atomic<std::size_t> count = 0;
    std::atomic<bool> hold = true;
    BakeSource source = b.source;
    source.addTransfer = [&](auto texels, int first, int samples, int order, int channels, auto sums,
                             auto alive) {
        if (++count > 2 * bricks) test::waitFor([&] { return !hold; });
        b.source.addTransfer(texels, first, samples, order, channels, sums, alive);
    };
    LazyBakeSetting setting = kTransfer;
    setting.threads = 1;
    LazyBake lazy(b.volume, b.choice, source, b.to, setting);
    lazy.setLight(skyOf(0));
    lazy.request(b.all());
    ASSERT_TRUE(test::waitFor([&] { return count > 2 * bricks; }));
    const std::vector<PackedTexel> before(b.to.texels.data(), b.to.texels.data() + b.to.layout.count());
    std::vector<glm::vec3> doubled = skyOf(0);
    for (glm::vec3& c : doubled) c *= 2;
    lazy.setLight(doubled);
    std::size_t borrowed = 0, own = 0;
    for (std::size_t n = 0; n < before.size(); ++n) {
        const float weight = texelWeight(before[n]);
        ASSERT_EQ(texelWeight(b.to.texels[n]), weight);
        ASSERT_NEAR(texelLight(b.to.texels[n]).x, 2 * texelLight(before[n]).x, 2e-3) << n;
        borrowed += weight > 0 && weight < 1;
        own += weight == 1;
    }
    EXPECT_GT(own, bricks / 2);
    EXPECT_GT(borrowed, 5 * own);
    hold = false;
}

}  // namespace
}  // namespace stereonav
