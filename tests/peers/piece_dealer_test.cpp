// Pieces of work among processes that threads stand for: what is made, in which order it is taken, and how it
// ends.
#include "engine/peers/piece_dealer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <numeric>

#include "engine/base/error.h"
#include "tests/support/thread_peers.h"
#include "tests/support/wait_for.h"

namespace stereonav {
namespace {

PeerBytes numberBytes(std::size_t number) {
    return ByteWriter().put(number).take();
}
std::size_t numberIn(std::span<const std::byte> bytes) {
    return ByteReader(bytes).get<std::size_t>();
}

// A piece n comes to 3 n + what its order says, which is n squared.
PeerBytes madeOf(std::size_t piece, std::span<const std::byte> order) {
    return numberBytes(3 * piece + numberIn(order));
}

PieceWork workOf(std::size_t count, std::vector<std::size_t>& taken) {
    PieceWork work;
    work.count = count;
    work.order = [](std::size_t n) { return numberBytes(n * n); };
    work.make = madeOf;
    work.take = [&taken](std::size_t n, std::span<const std::byte> result) {
        EXPECT_EQ(numberIn(result), 3 * n + n * n);
        taken.push_back(n);
    };
    return work;
}

std::vector<std::size_t> upTo(std::size_t count) {
    std::vector<std::size_t> all(count);
    std::iota(all.begin(), all.end(), 0u);
    return all;
}

TEST(Pieces, AreEachTakenOnceInTheirOrder) {
    for (const int processes : {1, 2, 5})
        for (const std::size_t count : {0u, 1u, 100u}) {
            std::vector<std::size_t> taken;
            runAsPeers(processes, [&](Peers& peers) {
                if (!peers.first()) return peers.serve(madeOf);
                PieceWork work = workOf(count, taken);
                work.inOrder = true;
                work.ahead = 3;
                PieceDealer(peers).deal(work);
            });
            EXPECT_EQ(taken, upTo(count)) << processes;
        }
}

TEST(Pieces, AreTakenAsTheyComeWhereOrderIsNotAsked) {
    std::vector<std::size_t> taken;
    runAsPeers(3, [&](Peers& peers) {
        if (!peers.first()) return peers.serve(madeOf);
        PieceDealer(peers).deal(workOf(200, taken));
    });
    std::sort(taken.begin(), taken.end());
    EXPECT_EQ(taken, upTo(200));
}

TEST(Pieces, AreBegunNoFurtherAheadThanAllowed) {
    constexpr std::size_t kAhead = 4;
    std::atomic<std::size_t> taken = 0, furthest = 0;
    const auto make = [&](std::size_t n, std::span<const std::byte>) {
        std::size_t now = furthest, is = n - std::min(n, taken.load());
        while (is > now && !furthest.compare_exchange_weak(now, is)) {
        }
        if (n % 7 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(2));  // others run ahead
        return PeerBytes{};
    };
    runAsPeers(4, [&](Peers& peers) {
        if (!peers.first()) return peers.serve(make);
        PieceWork work;
        work.count = 60;
        work.inOrder = true;
        work.ahead = kAhead;
        work.make = make;
        work.take = [&](std::size_t n, std::span<const std::byte>) { taken = n + 1; };
        PieceDealer(peers).deal(work);
    });
    EXPECT_EQ(taken, 60u);
    EXPECT_LE(furthest, kAhead);
}

// The first process makes none of its own here: it waits for the others in `make`.
TEST(Pieces, AreMadeByTheOthersToo) {
    std::atomic<int> byOthers = 0;
    runAsPeers(2, [&](Peers& peers) {
        const auto make = [&](std::size_t, std::span<const std::byte>) {
            if (!peers.first()) ++byOthers;
            if (peers.first()) test::waitFor([&] { return byOthers >= 5; });
            return PeerBytes{};
        };
        if (!peers.first()) return peers.serve(make);
        PieceWork work;
        work.count = 10;
        work.make = make;
        work.take = [](std::size_t, std::span<const std::byte>) {};
        PieceDealer(peers).deal(work);
    });
    EXPECT_GE(byOthers, 5);
}

// Several works one after the other within one time of serving; and one who comes when all is over.
TEST(Pieces, OfSeveralWorksAndForLateComers) {
    std::vector<std::size_t> first, second, third;
    runAsPeers(3, [&](Peers& peers) {
        if (peers.rank() == 2) std::this_thread::sleep_for(std::chrono::milliseconds(50));
        if (!peers.first()) {
            peers.serve(madeOf);
            return peers.serve(madeOf);
        }
        {
            PieceDealer dealer(peers);
            dealer.deal(workOf(10, first));
            dealer.deal(workOf(10, second));
        }
        PieceDealer(peers).deal(workOf(10, third));
    });
    for (std::vector<std::size_t>* taken : {&first, &second, &third}) {
        std::sort(taken->begin(), taken->end());
        EXPECT_EQ(*taken, upTo(10));
    }
}

TEST(Pieces, EndWhereTheyAreToEnd) {
    for (const int processes : {1, 3}) {
        std::vector<std::size_t> taken;
        runAsPeers(processes, [&](Peers& peers) {
            if (!peers.first()) return peers.serve(madeOf);
            PieceWork work = workOf(1'000'000, taken);
            std::atomic<bool> ended = false;
            work.ended = [&ended] { return ended.load(); };
            const auto take = work.take;
            work.take = [&](std::size_t n, std::span<const std::byte> result) {
                take(n, result);
                if (taken.size() == 20) ended = true;
            };
            PieceDealer(peers).deal(work);
        });
        EXPECT_GE(taken.size(), 20u);
        EXPECT_LT(taken.size(), 100u);
    }
}

// What the first one tells may come while another still asks for pieces.
TEST(Peers, HearWhatTheyAreToldInItsOrder) {
    std::atomic<int> heard = 0;
    std::vector<std::size_t> taken;
    runAsPeers(4, [&](Peers& peers) {
        if (!peers.first()) {
            peers.serve(madeOf);
            if (numberIn(peers.hear()) == 1 && numberIn(peers.hear()) == 2) ++heard;
            return;
        }
        PieceDealer(peers).deal(workOf(20, taken));
        peers.tellAll(numberBytes(1));
        peers.tellAll(numberBytes(2));
    });
    EXPECT_EQ(heard, 3);
}

TEST(Peers, WithOtherWordsAreRefused) {
    const auto check = [](Peers& peers) {
        if (peers.first())
            EXPECT_THROW(peers.check(), Error);
        else
            peers.check();
    };
    runAsPeers(2, check, false);
    runAsPeers(2, [](Peers& peers) { peers.check(); });
}

// What the failing one says comes out of the first one's work.
TEST(Peers, ThatFailEndTheWorkOfAll) {
    const auto boxes = std::make_shared<QueueLink::Boxes>(2);
    std::thread other([&] {
        Peers peers(std::make_unique<QueueLink>(boxes, 1), "");
        QueueLink(boxes, 1).send(0, PeerKind::Failure, ByteWriter().putText("disk: is on fire").take());
    });
    Peers peers(std::make_unique<QueueLink>(boxes, 0), "");
    PieceWork work;
    work.count = 1'000'000;
    work.make = [](std::size_t, std::span<const std::byte>) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        return PeerBytes{};
    };
    work.take = [](std::size_t, std::span<const std::byte>) {};
    try {
        PieceDealer(peers).deal(work);
        ADD_FAILURE() << "expected the other's failure";
    } catch (const PeerFailure& failure) {
        EXPECT_STREQ(failure.what(), "disk: is on fire");
    }
    EXPECT_TRUE(peers.failed());
    EXPECT_THROW(peers.throwIfFailed(), PeerFailure);
    other.join();
}

TEST(Peers, OfOneProcessStartNothing) {
    Peers peers;
    EXPECT_TRUE(peers.alone());
    EXPECT_TRUE(peers.first());
    EXPECT_EQ(peers.threads(), 0);
    EXPECT_EQ(peers.desk(), nullptr);
    EXPECT_FALSE(peers.failed());
    peers.tellAll({});
    peers.leave();
}

}  // namespace
}  // namespace stereonav
