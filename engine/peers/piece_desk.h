// The first process's desk: takes in what the others send, on a thread of its own, and gives out pieces.
#pragma once

#include <atomic>
#include <condition_variable>
#include <map>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "engine/peers/peers.h"
#include "engine/peers/piece_dealer.h"

namespace stereonav {

class PieceDesk {
public:
    explicit PieceDesk(PeerLink& link) : mLink(link) {}
    ~PieceDesk() { stop(); }
    // Starts and ends the desk's thread.
    void start();
    void stop();

    void open();   // lets the others ask for pieces of the next phase
    void close();  // ends the phase: who asks for more is told that there is none
    // Does the work as PieceDealer::deal() says.
    void deal(const PieceWork& work);

    // The line of the first process that failed, if one has.
    std::optional<std::string> failure() const;
    bool hasFailed() const { return mFailed; }
    // Sends to all others and returns when it has gone. Throws PeerFailure and Cancelled.
    void tellAll(const PeerBytes& bytes);
    // Waits until all others have left. Throws PeerFailure and Cancelled.
    void waitForAll();

private:
    struct Asking {
        int rank, phase;
    };
    void run();
    void handle(PeerMessage message);
    void answer();          // answers those who wait; with the lock
    bool mayBegin() const;  // a piece; with the lock
    void wait(std::unique_lock<std::mutex>& lock);
    bool takeOne(std::unique_lock<std::mutex>& lock);
    bool makeOne(std::unique_lock<std::mutex>& lock);
    void throwFailure();  // with the lock
    void giveUpIfNobodyListens();

    PeerLink& mLink;
    std::thread mThread;
    std::atomic<bool> mEnd = false, mFailed = false;
    std::atomic<bool> mHeard = false;  // whether this process's own work has been told of the failure
    mutable std::mutex mMutex;
    std::condition_variable mNews;
    std::vector<Asking> mAsking;
    int mPhase = 0;      // opened so far
    bool mOpen = false;  // the last of them
    std::optional<std::string> mFailure;
    double mFailed_s = 0;
    int mLeft = 0;  // other processes that are done

    // The work at hand.
    const PieceWork* mWork = nullptr;
    int mDeal = 0;  // counts deals, so that what comes late is known
    std::size_t mNext = 0, mTaken = 0, mAway = 0;
    std::map<std::size_t, PeerBytes> mReady;
};

}  // namespace stereonav
