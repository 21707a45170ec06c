// The desk and what comes late: results of a work that is over, requests of a time of serving that is over or
// still to come, further failures. The other process is played message by message.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "engine/peers/piece_desk.h"
#include "tests/support/gate.h"
#include "tests/support/thread_peers.h"

namespace stereonav {
namespace {

PeerBytes wholeBytes(std::size_t number) {
    return ByteWriter().put(number).take();
}

// The first process's end of the line. Counts messages that were dealt with: asked for the next one, the desk
// is done with the one before.
class WatchedLink final : public PeerLink {
public:
    explicit WatchedLink(std::shared_ptr<QueueLink::Boxes> boxes) : mLink(std::move(boxes), 0) {}
    int rank() const override { return 0; }
    int count() const override { return mLink.count(); }
    void send(int to, PeerKind kind, PeerBytes bytes) override { mLink.send(to, kind, std::move(bytes)); }
    std::optional<PeerMessage> next() override {
        if (std::exchange(mGiven, false)) ++dealtWith;
        auto message = mLink.next();
        mGiven = message.has_value();
        return message;
    }
    bool busy() override { return false; }
    void leave() override {}
    [[noreturn]] void abort() override { std::terminate(); }

    std::atomic<int> dealtWith = 0;

private:
    QueueLink mLink;
    bool mGiven = false;
};

class LateResults : public testing::Test {
protected:
    LateResults() { mDesk.start(); }

    // Sends from the other process; returns when the desk has dealt with it.
    void send(PeerKind kind, PeerBytes bytes) {
        const int before = mLink.dealtWith;
        mOther.send(0, kind, std::move(bytes));
        ASSERT_TRUE(test::waitFor([&] { return mLink.dealtWith > before; }));
    }
    void request(int phase) { send(PeerKind::Request, ByteWriter().put(phase).take()); }
    void result(int deal, std::size_t piece, std::size_t number) {
        send(PeerKind::Result, ByteWriter().put(deal).put(piece).put(number).take());
    }
    struct Order {
        int deal;
        std::size_t piece;
    };
    Order nextOrder() {
        std::optional<PeerMessage> message;
        EXPECT_TRUE(test::waitFor([&] { return (message = mOther.next()).has_value(); }));
        EXPECT_EQ(message->kind, PeerKind::Order);
        ByteReader reader(message->bytes);
        const int deal = reader.get<int>();
        return {deal, reader.get<std::size_t>()};
    }
    // Each piece comes to a hundred and its number.
    PieceWork workOf(std::size_t count) {
        PieceWork work;
        work.count = count;
        work.make = [](std::size_t n, std::span<const std::byte>) { return wholeBytes(100 + n); };
        work.take = [this](std::size_t n, std::span<const std::byte> bytes) {
            mTaken.emplace_back(n, ByteReader(bytes).get<std::size_t>());
        };
        return work;
    }
    // A work of two pieces of which the other process has the first, and which ends without it.
    Order workThatIsLeft() {
        std::atomic<bool> ended = false;
        PieceWork work = workOf(2);
        const auto take = work.take;
        work.take = [&](std::size_t n, std::span<const std::byte> bytes) { take(n, bytes), ended = true; };
        work.ended = [&] { return ended.load(); };
        mDesk.deal(work);
        const Order order = nextOrder();
        EXPECT_EQ(order.piece, 0u);
        EXPECT_EQ(mTaken, (Taken{{1, 101}}));
        mTaken.clear();
        return order;
    }

    using Taken = std::vector<std::pair<std::size_t, std::size_t>>;
    std::shared_ptr<QueueLink::Boxes> mBoxes = std::make_shared<QueueLink::Boxes>(2);
    WatchedLink mLink{mBoxes};
    QueueLink mOther{mBoxes, 1};
    Taken mTaken;
    PieceDesk mDesk{mLink};  // last: its thread ends first
};

TEST_F(LateResults, OfAnEarlierWorkAreNotTaken) {
    mDesk.open();
    request(1);
    const Order left = workThatIsLeft();
    for (const bool inOrder : {false, true}) {
        SCOPED_TRACE(inOrder);
        result(left.deal, 1, 666);  // while there is no work
        PieceWork work = workOf(3);
        work.inOrder = inOrder;
        work.make = [&](std::size_t n, std::span<const std::byte>) {
            if (n == 0)
                for (std::size_t piece = 0; piece < 3; ++piece) result(left.deal, piece, 666);
            return wholeBytes(100 + n);
        };
        mDesk.deal(work);
        EXPECT_EQ(mTaken, (Taken{{0, 100}, {1, 101}, {2, 102}}));
        mTaken.clear();
    }
    mDesk.close();
}

// What is left of a work that threw is not taken by the next, either.
TEST_F(LateResults, OfAWorkThatFailedAreNotTaken) {
    mDesk.open();
    request(1);
    PieceWork failing = workOf(4);
    failing.make = [](std::size_t n, std::span<const std::byte>) -> PeerBytes {
        if (n == 3) throw std::runtime_error("the disk is full");
        return wholeBytes(100 + n);
    };
    EXPECT_THROW(mDesk.deal(failing), std::runtime_error);
    mTaken.clear();
    const Order left = nextOrder();
    PieceWork work = workOf(2);
    work.make = [&](std::size_t n, std::span<const std::byte>) {
        if (n == 0) result(left.deal, 1, 666);
        return wholeBytes(100 + n);
    };
    mDesk.deal(work);
    EXPECT_EQ(mTaken, (Taken{{0, 100}, {1, 101}}));
    mDesk.close();
}

// Results of the present work are taken, and a later work waits for those that the other process has,
// whatever happened to earlier ones.
TEST_F(LateResults, OfTheWorkAtHandAreTaken) {
    mDesk.open();
    request(1);
    const Order left = workThatIsLeft();
    request(1);
    PieceWork work = workOf(3);
    int made = 0;
    work.make = [&](std::size_t n, std::span<const std::byte>) {
        if (++made == 1) {
            const Order order = nextOrder();
            EXPECT_NE(order.deal, left.deal);
            EXPECT_EQ(order.piece, 0u);
            result(left.deal, 0, 666);
            result(order.deal, 0, 100);
        }
        return wholeBytes(100 + n);
    };
    mDesk.deal(work);
    std::sort(mTaken.begin(), mTaken.end());
    EXPECT_EQ(mTaken, (Taken{{0, 100}, {1, 101}, {2, 102}}));
    EXPECT_EQ(made, 2) << "that piece was the other's";
    mDesk.close();
}

// A time of serving that is over has nothing more for who asks late, and one that is to come has it wait.
TEST_F(LateResults, RequestsAreOfTheirTime) {
    mDesk.open();
    mDesk.close();
    request(1);
    const auto done = mOther.next();
    ASSERT_TRUE(done);
    EXPECT_EQ(done->kind, PeerKind::Done);
    request(2);
    EXPECT_FALSE(mOther.next()) << "it is not begun";
    mDesk.open();
    EXPECT_FALSE(mOther.next());
    request(1);  // somebody who was very late
    const auto late = mOther.next();
    ASSERT_TRUE(late);
    EXPECT_EQ(late->kind, PeerKind::Done) << "its time is over though another one is open";
    PieceWork work = workOf(2);
    int made = 0;
    work.make = [&](std::size_t n, std::span<const std::byte>) {
        if (++made == 1) {
            const Order order = nextOrder();
            EXPECT_EQ(order.piece, 0u);
            result(order.deal, 0, 100);
        }
        return wholeBytes(100 + n);
    };
    mDesk.deal(work);
    EXPECT_EQ(made, 1);
    request(2);
    EXPECT_FALSE(mOther.next()) << "there may be another work";
    mDesk.close();
    const auto end = mOther.next();
    ASSERT_TRUE(end);
    EXPECT_EQ(end->kind, PeerKind::Done);
}

TEST_F(LateResults, TheFirstFailureIsTheOneThatIsTold) {
    EXPECT_FALSE(mDesk.failure());
    mDesk.open();
    send(PeerKind::Failure, ByteWriter().putText("a.nrrd: is cut off").take());
    EXPECT_THROW(mDesk.deal(workOf(3)), PeerFailure);
    send(PeerKind::Failure, ByteWriter().putText("b.nrrd: is none").take());
    EXPECT_EQ(mDesk.failure(), "a.nrrd: is cut off");
    EXPECT_TRUE(mDesk.hasFailed());
    EXPECT_TRUE(mTaken.empty());
    mDesk.close();
}

}  // namespace
}  // namespace stereonav
