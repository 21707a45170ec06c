// The first process's desk: receives messages of the others, on a thread of its own, and gives out pieces.
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
    void close();  // ends the phase: processes that ask for more are told that there is none
    // Does the work of PieceDealer::deal().
    void deal(const PieceWork& work);

    // Returns the line of the first process that failed, if any.
    std::optional<std::string> failure() const;
    bool hasFailed() const { return mFailed; }
    // Sends to all others and returns when all was sent. Throws PeerFailure and Cancelled.
    void tellAll(const PeerBytes& bytes);
    // Waits until all others have left. Throws PeerFailure and Cancelled.
    void waitForAll();

private:
    struct Asking {
        int rank, phase;
    };
    void run();
    void handle(PeerMessage message);
    void answer();          // answers processes that wait for a piece; needs the lock
    bool mayBegin() const;  // whether another piece may be begun; needs the lock
    void wait(std::unique_lock<std::mutex>& lock);
    bool takeOne(std::unique_lock<std::mutex>& lock);
    bool makeOne(std::unique_lock<std::mutex>& lock);
    void throwFailure();  // needs the lock
    void giveUpIfNobodyListens();

    PeerLink& mLink;
    std::thread mThread;
    std::atomic<bool> mEnd = false, mFailed = false;
    std::atomic<bool> mHeard = false;  // whether the main thread has noticed the failure
    mutable std::mutex mMutex;
    std::condition_variable mNews;
    std::vector<Asking> mAsking;
    int mPhase = 0;      // number of phases opened so far
    bool mOpen = false;  // whether the last phase is open
    std::optional<std::string> mFailure;
    double mFailed_s = 0;
    int mLeft = 0;  // number of other processes that are done

    // The present work; null between deals.
    const PieceWork* mWork = nullptr;
    int mDeal = 0;  // number of the deal, by which late results of earlier ones are recognised
    std::size_t mNext = 0, mTaken = 0, mAway = 0;
    std::map<std::size_t, PeerBytes> mReady;
};

}  // namespace stereonav
