// Several processes simulated by threads of one: messages go through queues instead of MPI.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "engine/peers/peers.h"

namespace stereonav {

class QueueLink final : public PeerLink {
public:
    struct Boxes {
        explicit Boxes(int count) : messages(static_cast<std::size_t>(count)) {}
        std::mutex mutex;
        std::vector<std::deque<PeerMessage>> messages;  // messages to each process
    };
    QueueLink(std::shared_ptr<Boxes> boxes, int rank) : mBoxes(std::move(boxes)), mRank(rank) {}

    int rank() const override { return mRank; }
    int count() const override { return static_cast<int>(mBoxes->messages.size()); }
    void send(int to, PeerKind kind, PeerBytes bytes) override {
        const std::lock_guard lock(mBoxes->mutex);
        mBoxes->messages[static_cast<std::size_t>(to)].push_back({mRank, kind, std::move(bytes)});
    }
    std::optional<PeerMessage> next() override {
        const std::lock_guard lock(mBoxes->mutex);
        std::deque<PeerMessage>& own = mBoxes->messages[static_cast<std::size_t>(mRank)];
        if (own.empty()) return std::nullopt;
        PeerMessage message = std::move(own.front());
        own.pop_front();
        return message;
    }
    bool busy() override { return false; }
    void leave() override {}
    [[noreturn]] void abort() override { std::terminate(); }

private:
    std::shared_ptr<Boxes> mBoxes;
    int mRank;
};

// Calls body(peers) once for each of `count` processes, all at once, and then leaves.
inline void runAsPeers(int count, const std::function<void(Peers&)>& body, bool sameWords = true) {
    const auto boxes = std::make_shared<QueueLink::Boxes>(count);
    std::vector<std::thread> threads;
    for (int rank = 0; rank < count; ++rank)
        threads.emplace_back([=, &body] {
            Peers peers(std::make_unique<QueueLink>(boxes, rank), sameWords ? "" : std::to_string(rank));
            body(peers);
            peers.leave();
        });
    for (std::thread& thread : threads) thread.join();
}

}  // namespace stereonav
