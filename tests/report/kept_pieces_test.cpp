// What makers of a report's pieces keep for more than one piece is kept for pieces of the same: after a piece
// of something else each comes to what it comes to by itself.
#include <gtest/gtest.h>

#include "app/report/run.h"
#include "engine/medium/model/medium_look.h"
#include "engine/medium/paths/delta_tracking.h"

namespace stereonav {
namespace {

// The order of the makers' own orders in their bytes.
struct LightOrder {
    std::uint64_t seed;
    int bricks, run, samples;
};
struct PixelOrder {
    std::uint64_t seed;
    std::uint32_t stream;
    int width, height, samples, firstRow, rows;
};
struct GroundOrder {
    std::uint64_t seed;
    int side, first, count, paths;
};
struct VoxelOrder {
    double radius;
    std::size_t texels, first, end;
};
struct SubjectOrder {
    bool wax;
    int size;
};
struct PathOrder {
    SubjectOrder subject;
    MediumModel model;
    TrackingSetting tracking;
    PictureRows rows;
};

template <typename Order>
PeerBytes madeBy(PeerBytes (*make)(ReportRun&, ByteReader&), ReportRun& run, const Order& order) {
    const PeerBytes bytes = ByteWriter().put(order).take();
    ByteReader reader(bytes);
    return make(run, reader);
}

// One order after the other by one run, and each by a run of its own.
template <typename Order>
void expectEachByItself(PeerBytes (*make)(ReportRun&, ByteReader&), const std::vector<Order>& orders) {
    Progress quiet;
    ReportOptions options;
    ReportRun run(options, quiet);
    std::vector<PeerBytes> apart;
    for (const Order& order : orders) {
        ReportRun own(options, quiet);
        apart.push_back(madeBy(make, own, order));
        for (std::size_t n = 0; n + 1 < apart.size(); ++n)
            EXPECT_TRUE(apart[n] != apart.back()) << "orders " << n << " and " << apart.size() - 1;
    }
    for (std::size_t n = 0; n <= orders.size(); ++n) {  // the first one again at the end
        const std::size_t at = n % orders.size();
        EXPECT_TRUE(madeBy(make, run, orders[at]) == apart[at]) << "order " << at;
    }
}

TEST(KeptPieces, OfBakedLight) {
    expectEachByItself<LightOrder>(makeLightTruth, {{1, 2, 0, 4}, {1, 3, 0, 4}, {2, 2, 0, 4}, {1, 2, 1, 4}});
}

TEST(KeptPieces, OfTracedPixels) {
    expectEachByItself<PixelOrder>(makePixelTruth, {{1, 0, 24, 16, 4, 5, 4},
                                                    {1, 0, 16, 24, 4, 5, 4},
                                                    {1, 0, 24, 20, 4, 5, 4},
                                                    {1, 1, 24, 16, 4, 5, 4},
                                                    {2, 0, 24, 16, 4, 5, 4},
                                                    {1, 0, 24, 16, 4, 9, 4}});
}

TEST(KeptPieces, OfGround) {
    expectEachByItself<GroundOrder>(
        makeGroundTruth, {{1, 33, 0, 3, 16}, {1, 41, 0, 3, 16}, {2, 33, 0, 3, 16}, {1, 33, 3, 3, 16}});
}

TEST(KeptPieces, OfOpenness) {
    expectEachByItself<VoxelOrder>(
        makeOpenness, {{0.006, 40, 10, 22}, {0.006, 60, 10, 22}, {0.008, 40, 10, 22}, {0.006, 40, 22, 34}});
}

TEST(KeptPieces, OfMedia) {
    TrackingSetting tracking;
    tracking.samples = 1;
    TrackingSetting seeded = tracking;
    seeded.seed = 2;
    expectEachByItself<PathOrder>(makeTrackedRows, {{{true, 24}, MediumModel::Direct, tracking, {9, 11}},
                                                    {{true, 32}, MediumModel::Direct, tracking, {9, 11}},
                                                    {{false, 24}, MediumModel::Direct, tracking, {9, 11}},
                                                    {{true, 24}, MediumModel::Indirect, tracking, {9, 11}},
                                                    {{true, 24}, MediumModel::Direct, seeded, {9, 11}}});
}

}  // namespace
}  // namespace stereonav
