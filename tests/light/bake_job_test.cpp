// The bake's bookkeeping on made-up samples whose mean and spread are known: the light of a texel is its
// place plus noise of a known variance.
#include "engine/light/bake/bake_job.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <mutex>
#include <thread>

#include "engine/base/parallel.h"
#include "engine/base/stopwatch.h"
#include "engine/light/bake/brick_work.h"
#include "tests/support/thread_peers.h"
#include "tests/support/whole_progress.h"
#include "tests/volume/test_volumes.h"

namespace stereonav {
namespace {

constexpr double kSpread = 0.6;  // noise is uniform in +- kSpread: of variance kSpread^2 / 3
constexpr int kOrder = 2;

// Returns a number in [-1, 1) for a texel, a sample and a channel: no two alike.
double noise(const glm::ivec3& t, int sample, int channel) {
    std::uint64_t x = static_cast<std::uint64_t>(((t.x * 64 + t.y) * 64 + t.z)) << 32 |
                      static_cast<std::uint64_t>(sample * 16 + channel);
    x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9ull;
    x = (x ^ x >> 27) * 0x94d049bb133111ebull;
    x ^= x >> 31;
    return static_cast<double>(x >> 11) / 4503599627370496.0 - 1;
}
double truth(const glm::ivec3& t) {
    return 1 + 0.1 * t.x + 0.05 * t.y;
}
bool dead(const glm::ivec3& t) {
    return (t.x + t.y + t.z) % 7 == 3;
}

BakeSource madeUp(double brightness = 1) {
    BakeSource source;
    source.addIrradiance = [=](std::span<const glm::ivec3> texels, int count, std::span<TexelSum> sums) {
        for (std::size_t n = 0; n < texels.size(); ++n) {
            TexelSum& sum = sums[n];
            ASSERT_GE(sum.samples, 0) << "dead texels are left out";
            if (dead(texels[n])) sum.samples = -1;
            if (sum.samples < 0) continue;
            // The call's own samples first, then both together: rounds otherwise where calls are cut
            // otherwise.
            TexelSum part;
            for (int k = 0; k < count; ++k) {
                const auto value = static_cast<float>(
                    brightness *
                    (truth(texels[n]) + kSpread * noise(texels[n], static_cast<int>(sum.samples) + k, 0)));
                const float before = value - part.mean.x;
                part.samples += 1;
                part.mean += glm::vec3(before / part.samples);
                part.squares += before * (value - part.mean.x);
            }
            const float all = sum.samples + part.samples, apart = part.mean.x - sum.mean.x;
            sum.squares += part.squares + apart * apart * sum.samples * part.samples / all;
            sum.mean += glm::vec3(apart * part.samples / all);
            sum.samples = all;
        }
    };
    source.addTransfer = [=](std::span<const glm::ivec3> texels, int first, int count, int order,
                             int channels, std::span<float> sums, std::span<std::uint8_t> alive) {
        const int each = order * order * channels;
        for (std::size_t n = 0; n < texels.size(); ++n) {
            ASSERT_TRUE(alive[n]);
            if (dead(texels[n])) alive[n] = 0;
            for (int c = 0; c < each && alive[n]; ++c) {
                float part = 0;
                for (int k = first; k < first + count; ++k)
                    part += static_cast<float>(
                        brightness * (truth(texels[n]) / (1 + c) + kSpread * noise(texels[n], k, c)));
                sums[n * each + c] += part;
            }
        }
    };
    return source;
}

BakeSums emptySums(BakeKind kind, int channels = 1) {
    VolumeFrame frame = test::slantedFrame({21, 12, 17});
    const TexelLayout layout(frame.size);
    std::vector<TexelBrick> bricks;
    const auto count = static_cast<std::uint32_t>(layout.bricks.x * layout.bricks.y * layout.bricks.z);
    for (std::uint32_t n = 0; n < count; ++n) {
        TexelBrick brick{n, {}};
        const glm::ivec3 first = brickPlace(layout, n) * 8;
        for (int k = 0; k < 8; ++k)
            for (int bit = 0; bit < 64; ++bit)
                if (frame.contains(first + glm::ivec3(bit & 7, bit >> 3, k)) && (bit * 5 + k) % 3 != 0)
                    brick.wanted[k] |= 1ull << bit;
        bricks.push_back(brick);
    }
    return BakeSums(frame, bricks, {kind, kOrder, channels});
}

// Every byte that a bake keeps.
std::string bytesOf(BakeSums& sums) {
    std::string all;
    const auto add = [&](const auto& span) {
        all.append(reinterpret_cast<const char*>(span.data()), span.size_bytes());
    };
    for (std::size_t n = 0; n < sums.bricks().size(); ++n) {
        sums.shape().kind == BakeKind::Transfer ? add(sums.transfer(n)) : add(sums.light(n));
        add(sums.alive(n));
    }
    add(std::span(sums.samples));
    add(std::span(sums.estimates));
    return all;
}

BakeEnd bake(BakeSums& sums, const BakeGoal& goal, const BakeSource& source = madeUp()) {
    Progress progress;
    return runBake(sums, source, goal, progress);
}

class EveryKind : public testing::TestWithParam<BakeKind> {};

TEST_P(EveryKind, SumsAreThoseOfTheSamplesAskedFor) {
    for (const int samples : {1, 15, 16, 100, 200}) {
        BakeSums sums = emptySums(GetParam());
        EXPECT_EQ(bake(sums, {samples, 0, 0}), BakeEnd::Reached);
        for (std::size_t n = 0; n < sums.bricks().size(); ++n) {
            ASSERT_EQ(sums.samples[n], static_cast<std::uint32_t>(samples));
            const std::vector<glm::ivec3> texels = texelsIn(sums.layout(), sums.bricks()[n]);
            for (std::size_t t = 0; t < texels.size(); ++t) {
                double sum = 0;
                for (int k = 0; k < samples; ++k) sum += truth(texels[t]) + kSpread * noise(texels[t], k, 0);
                if (GetParam() == BakeKind::Transfer) {
                    ASSERT_EQ(sums.alive(n)[t], !dead(texels[t]));
                    ASSERT_NEAR(sums.transfer(n)[t * kOrder * kOrder], dead(texels[t]) ? 0 : sum, 1e-5 * sum);
                } else {
                    ASSERT_EQ(sums.light(n)[t].samples, dead(texels[t]) ? -1 : samples);
                    ASSERT_NEAR(sums.light(n)[t].mean.x, dead(texels[t]) ? 0 : sum / samples, 1e-5);
                }
            }
        }
    }
}

TEST_P(EveryKind, SameBytesForAnyThreadCount) {
    std::string bytes[3];
    int n = 0;
    for (const int threads : {1, 2, 7}) {
        setThreadCount(threads);
        BakeSums sums = emptySums(GetParam(), GetParam() == BakeKind::Transfer ? 3 : 1);
        bake(sums, {100, 0, 0});
        bytes[n++] = bytesOf(sums);
    }
    EXPECT_EQ(bytes[0], bytes[1]);
    EXPECT_EQ(bytes[0], bytes[2]);
}

// A bake that is cancelled after some batches, continued, cancelled again and so on gives the same result as
// one that is never cancelled.
TEST_P(EveryKind, CancellingKeepsWhatIsDoneAndTheRestGivesTheSameBytes) {
    const int kSamples = 700;
    BakeSums whole = emptySums(GetParam());
    bake(whole, {kSamples, 0, 0});
    for (const int every : {1, 5, 37}) {
        BakeSums sums = emptySums(GetParam());
        int cancelled = 0;
        BakeEnd end = BakeEnd::Cancelled;
        while (end == BakeEnd::Cancelled) {
            Progress progress;
            std::atomic<int> batches = 0;
            const BakeSource plain = madeUp();
            BakeSource source = plain;
            const auto count = [&] {
                if (++batches >= every + cancelled % 3) progress.cancel();
            };
            source.addIrradiance = [&](auto texels, int n, auto to) {
                plain.addIrradiance(texels, n, to);
                count();
            };
            source.addTransfer = [&](auto texels, int first, int n, int order, int channels, auto to,
                                     auto alive) {
                plain.addTransfer(texels, first, n, order, channels, to, alive);
                count();
            };
            const std::uint32_t before = sums.fewestSamples();
            end = runBake(sums, source, {kSamples, 0, 0}, progress);
            ASSERT_GE(sums.fewestSamples(), before);
            if (end == BakeEnd::Cancelled) ++cancelled;
            ASSERT_LT(cancelled, 10000);
        }
        EXPECT_GT(cancelled, 0);
        EXPECT_EQ(sums.fewestSamples(), static_cast<std::uint32_t>(kSamples));
        sums.estimates = whole.estimates;  // for transfer they depend on how passes were cut
        EXPECT_EQ(bytesOf(sums), bytesOf(whole)) << every;
    }
}

TEST_P(EveryKind, MoreSamplesGoOnFromThoseThereAre) {
    BakeSums whole = emptySums(GetParam()), parts = emptySums(GetParam());
    bake(whole, {600, 0, 0});
    for (const int samples : {128, 384, 384, 16, 600}) bake(parts, {samples, 0, 0});
    parts.estimates = whole.estimates;
    EXPECT_EQ(bytesOf(parts), bytesOf(whole));
}

// The true relative RMSE, which is known here, against what the bake estimates of it.
TEST_P(EveryKind, TheEstimatedErrorIsTheTrueOne) {
    for (const int samples : {16, 32, 64, 100, 512}) {
        BakeSums sums = emptySums(GetParam());
        bake(sums, {samples, 0, 0});
        double error = 0, square = 0;
        for (std::size_t n = 0; n < sums.bricks().size(); ++n) {
            const std::vector<glm::ivec3> texels = texelsIn(sums.layout(), sums.bricks()[n]);
            for (std::size_t t = 0; t < texels.size(); ++t) {
                if (dead(texels[t])) continue;
                const bool transfer = GetParam() == BakeKind::Transfer;
                for (int c = 0; c < (transfer ? kOrder * kOrder : 1); ++c) {
                    const double wanted = truth(texels[t]) / (1 + c);
                    const double found = transfer ? sums.transfer(n)[t * kOrder * kOrder + c] / samples
                                                  : sums.light(n)[t].mean.x;
                    error += (found - wanted) * (found - wanted);
                    square += wanted * wanted;
                }
            }
        }
        EXPECT_NEAR(sums.error() / std::sqrt(error / square), 1, 0.1) << samples;
    }
}

TEST_P(EveryKind, StopsWhereTheErrorIsReached) {
    for (const double error : {0.1, 0.03, 0.011}) {
        BakeSums sums = emptySums(GetParam());
        EXPECT_EQ(bake(sums, {0, error, 0}), BakeEnd::Reached);
        EXPECT_LE(sums.error(), error);
        const std::uint32_t used = sums.fewestSamples();
        // Not twice as many as needed, unless the very first passes are enough.
        EXPECT_TRUE(used <= 32 || sums.error() > 0.7 * error) << used;
        const std::string bytes = bytesOf(sums);
        bake(sums, {0, error, 0});
        EXPECT_EQ(bytesOf(sums), bytes) << "there was nothing to add";
    }
}

TEST_P(EveryKind, StopsWhenTheTimeIsUp) {
    BakeSums sums = emptySums(GetParam());
    const Stopwatch watch;
    EXPECT_EQ(bake(sums, {0, 0, 0.003}), BakeEnd::TimeUp);
    EXPECT_GE(watch.elapsed_ms(), 180);  // nothing else ends it
    EXPECT_GT(sums.fewestSamples(), 0u);
    EXPECT_GT(sums.error(), 0);
}

TEST_P(EveryKind, BlackIsWithoutError) {
    BakeSums sums = emptySums(GetParam());
    EXPECT_EQ(bake(sums, {0, 0.01, 0}, madeUp(0)), BakeEnd::Reached);
    EXPECT_EQ(sums.error(), 0);
    EXPECT_LE(sums.fewestSamples(), 32u);
}

TEST_P(EveryKind, NothingWantedIsDoneAtOnce) {
    BakeSums sums(test::slantedFrame({9, 9, 9}), {}, {GetParam(), kOrder, 1});
    EXPECT_EQ(bake(sums, {1000000, 0, 0}), BakeEnd::Reached);
    EXPECT_EQ(sums.error(), 0);
    BakeSums none;
    EXPECT_EQ(bake(none, {10, 0, 0}), BakeEnd::Reached);
}

INSTANTIATE_TEST_SUITE_P(BakeJob, EveryKind,
                         testing::Values(BakeKind::Irradiance, BakeKind::Transfer, BakeKind::Openness),
                         [](const auto& kind) { return std::string(nameOf(kind.param)); });

// Threads that stand for processes.
TEST_P(EveryKind, SharedBakesGiveTheBytesOfOneProcess) {
    for (const BakeGoal& goal : {BakeGoal{100, 0, 0}, BakeGoal{0, 0.02, 0}}) {
        BakeSums whole = emptySums(GetParam()), shared = emptySums(GetParam());
        bake(whole, goal);
        std::atomic<int> helped = 0;
        runAsPeers(3, [&](Peers& peers) {
            BakeSums scratch = emptySums(GetParam());
            BakeSource source = madeUp();
            if (!peers.first()) {
                BakeSource counted = source;
                counted.addIrradiance = [&](auto texels, int count, auto sums) {
                    ++helped;
                    source.addIrradiance(texels, count, sums);
                };
                counted.addTransfer = [&](auto texels, int first, int count, int order, int channels,
                                          auto sums, auto alive) {
                    ++helped;
                    source.addTransfer(texels, first, count, order, channels, sums, alive);
                };
                return serveBake(scratch, counted, peers);
            }
            Progress progress;
            EXPECT_EQ(runBake(shared, source, goal, progress, {}, &peers), BakeEnd::Reached);
        });
        for (std::size_t n = 0; n < whole.bricks().size(); ++n) {
            ASSERT_EQ(shared.samples[n], whole.samples[n]);
            ASSERT_EQ(shared.estimates[n].variance, whole.estimates[n].variance);
            const auto bytes = [](const auto& span) {
                return std::string(reinterpret_cast<const char*>(span.data()), span.size_bytes());
            };
            ASSERT_EQ(bytes(shared.light(n)), bytes(whole.light(n)));
            ASSERT_EQ(bytes(shared.transfer(n)), bytes(whole.transfer(n)));
            ASSERT_EQ(bytes(shared.alive(n)), bytes(whole.alive(n)));
        }
        EXPECT_EQ(shared.error(), whole.error());
    }
}

TEST(BakeJob, TellsWhatItDoes) {
    BakeSums sums = emptySums(BakeKind::Irradiance);
    std::mutex mutex;
    std::vector<std::string> lines;
    double last = -1;
    Progress progress([&](double fraction, const std::string& what) {
        const std::lock_guard lock(mutex);
        EXPECT_GE(fraction, 0);
        EXPECT_LE(fraction, 1);
        last = fraction;
        lines.push_back(what);
    });
    EXPECT_EQ(runBake(sums, madeUp(), {0, 0, 0.005}, progress), BakeEnd::TimeUp);
    ASSERT_GE(lines.size(), 3u);
    EXPECT_THAT(lines.front(), testing::HasSubstr("error not known yet"));
    EXPECT_THAT(lines.back(),
                testing::ContainsRegex("irradiance: [0-9]+ samples a texel, error .* %, 0:0[01] left"));
    EXPECT_GT(last, 0.5);
}

// Whatever ends it; more may be foreseen to be done on the way than was before.
TEST(BakeJob, TellsAWholeProgress) {
    for (const BakeGoal& goal : {BakeGoal{100, 0, 0}, BakeGoal{0, 0.01, 0}, BakeGoal{0, 0, 0.003},
                                 BakeGoal{100, 0.5, 0}, BakeGoal{0, 0.01, 5}}) {
        SCOPED_TRACE(testing::Message() << goal.samples << " " << goal.error << " " << goal.minutes);
        BakeSums sums = emptySums(BakeKind::Irradiance);
        test::WrittenProgress written;
        ASSERT_NE(runBake(sums, madeUp(), goal, written.progress()), BakeEnd::Cancelled);
        written.expectWhole("a bake");
        test::WrittenProgress again;
        ASSERT_NE(runBake(sums, madeUp(), goal, again.progress()), BakeEnd::Cancelled);
        again.expectWhole("one that goes on");
    }
    for (const int processes : {2, 3})
        runAsPeers(processes, [&](Peers& peers) {
            BakeSums sums = emptySums(BakeKind::Irradiance);
            if (!peers.first()) return serveBake(sums, madeUp(), peers);
            test::WrittenProgress written;
            EXPECT_EQ(runBake(sums, madeUp(), {100, 0, 0}, written.progress(), {}, &peers), BakeEnd::Reached);
            written.expectWhole("one of several processes");
        });
}

TEST(BakeJob, KeepsNowAndThen) {
    Progress progress;
    int kept = 0;
    std::uint32_t before = 0;
    BakeKeeping keeping;
    keeping.everySeconds = 0.01;
    keeping.keep = [&](const BakeSums& now) {
        ++kept;
        EXPECT_GE(now.fewestSamples(), before);
        before = now.fewestSamples();
    };
    // More time where a busy machine hardly lets it run.
    for (double minutes = 0.003; kept <= 3 && minutes < 0.2; minutes *= 2) {
        BakeSums sums = emptySums(BakeKind::Irradiance);
        kept = 0;
        before = 0;
        runBake(sums, madeUp(), {0, 0, minutes}, progress, keeping);
    }
    EXPECT_GT(kept, 3);
}

TEST(BakeJob, BatchesHaveFixedEnds) {
    std::uint32_t first = 0;
    for (int n = 0; n < 1000; ++n) {
        const std::uint32_t end = batchEnd(first);
        ASSERT_GT(end, first);
        for (std::uint32_t inside = first; inside < end; ++inside) ASSERT_EQ(batchEnd(inside), end);
        ASSERT_EQ(end % 128, 0u);
        first = end;
    }
}

TEST(BakeSums, BecomeWhatIsLookedUp) {
    BakeSums sums = emptySums(BakeKind::Openness);
    bake(sums, {64, 0, 0});
    const IlluminationVolume volume = illuminationOf(sums);
    std::size_t known = 0;
    for (std::size_t n = 0; n < sums.bricks().size(); ++n)
        for (const glm::ivec3& t : texelsIn(sums.layout(), sums.bricks()[n])) {
            const PackedTexel texel = volume.texels[volume.layout.index(t.x, t.y, t.z)];
            ASSERT_EQ(texelWeight(texel), dead(t) ? 0.0f : 1.0f);
            ASSERT_NEAR(texelLight(texel).y, dead(t) ? 0 : truth(t), 0.4);
            known += !dead(t);
        }
    std::size_t inVolume = 0;
    for (std::size_t n = 0; n < volume.layout.count(); ++n) inVolume += texelWeight(volume.texels[n]) > 0;
    EXPECT_EQ(inVolume, known);
}

// Light in other units, of a sky in candela a square metre or one of nearly nothing, keeps its contrast.
TEST(BakeSums, HoldLightOfAnyUnit) {
    BakeSums sums = emptySums(BakeKind::Openness);
    bake(sums, {64, 0, 0});
    EXPECT_EQ(lightUnitOf(sums), 1) << "as it is";
    const IlluminationVolume once = illuminationOf(sums);
    for (const float factor : {0x1p40f, 0x1p-40f}) {
        BakeSums scaled = emptySums(BakeKind::Openness);
        bake(scaled, {64, 0, 0});
        for (std::size_t n = 0; n < scaled.bricks().size(); ++n)
            for (TexelSum& texel : scaled.light(n)) texel.mean *= factor;
        const float unit = lightUnitOf(scaled);
        const IlluminationVolume light = illuminationOf(scaled, unit);
        for (std::size_t n = 0; n < light.layout.count(); ++n) {
            ASSERT_EQ(texelWeight(light.texels[n]), texelWeight(once.texels[n]));
            const float wanted = texelLight(once.texels[n]).x,
                        found = texelLight(light.texels[n]).x * (unit / factor);
            ASSERT_NEAR(found, wanted, 2e-3f * wanted);
        }
    }
    EXPECT_EQ(lightUnitOf(emptySums(BakeKind::Openness)), 1) << "nothing is known";
}

TEST(BakeSums, BecomeTransferWithoutWhatLiesOnNoSurface) {
    BakeSums sums = emptySums(BakeKind::Transfer, 3);
    bake(sums, {100, 0, 0});
    const TransferVolume volume = transferOf(sums);
    EXPECT_EQ(volume.channels(), 3);
    std::size_t known = 0;
    for (std::size_t n = 0; n < sums.bricks().size(); ++n) {
        const std::vector<glm::ivec3> texels = texelsIn(sums.layout(), sums.bricks()[n]);
        for (std::size_t t = 0; t < texels.size(); ++t) {
            const std::vector<float> numbers = volume.at(texels[t]);
            ASSERT_EQ(numbers.empty(), dead(texels[t]));
            known += !numbers.empty();
            for (std::size_t c = 0; c < numbers.size(); ++c)
                ASSERT_NEAR(numbers[c], sums.transfer(n)[t * numbers.size() + c] / 100, 0.002);
        }
    }
    EXPECT_EQ(volume.texels(), known);
    EXPECT_TRUE(transferOf(emptySums(BakeKind::Transfer)).empty());
}

TEST(BakeSums, RefuseMoreThanTheMemoryHolds) {
    VolumeFrame frame = test::slantedFrame({1024, 1024, 1023});
    TexelBrick brick{0, {}};
    brick.wanted.fill(~0ull);
    const std::vector<TexelBrick> bricks(1u << 21, brick);
    try {
        const BakeSums sums(frame, bricks, {BakeKind::Transfer, 6, 3});
        FAIL();
    } catch (const Error& error) {
        // 433 bytes each, and 24 MB beside them.
        EXPECT_THAT(error.what(), testing::HasSubstr("1073741824 texels need 465.0 GB"));
    }
}

}  // namespace
}  // namespace stereonav
