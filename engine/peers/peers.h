// The processes of this run that share a command's work: this one alone, or those that mpirun or srun
// started. The first one (rank 0) deals out pieces of work when the others ask for them, makes pieces itself,
// and is the only one to write results (piece_dealer.h); the others make the pieces that they are given.
//
// The other processes call MPI on their working thread. The first one has a thread of its own for messages,
// so that nobody waits for a piece that it makes. A process that waits sleeps: MPI's own waiting keeps a core
// busy.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>

#include "engine/peers/peer_link.h"

namespace stereonav {

class PieceDesk;

// Reports the failure of another process, with its whole line.
class PeerFailure : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

class Peers {
public:
    Peers();  // one process: nothing is loaded, no thread started
    // Joins the others; called by all processes at once. greeting: must be the same in all, or check()
    // throws. Throws Error where a message is not the expected one, and Cancelled.
    Peers(std::unique_ptr<PeerLink> link, const std::string& greeting);
    ~Peers();
    Peers(const Peers&) = delete;
    Peers& operator=(const Peers&) = delete;

    int rank() const { return mRank; }
    int count() const { return mCount; }
    bool first() const { return mRank == 0; }
    bool alone() const { return mCount == 1; }
    // Returns the number of threads for this process, where processes on the same cores share them evenly; 0:
    // it is alone, and uses all.
    int threads() const { return mThreads; }
    // Throws Error where the processes were started with different greetings.
    void check() const;

    // Makes a piece according to its order.
    using Make = std::function<PeerBytes(std::size_t piece, std::span<const std::byte> order)>;
    // Called in the other processes: makes the pieces that the first one deals (PieceDealer) until it closes.
    // Throws the exceptions of `make`, and Cancelled.
    void serve(const Make& make);
    // Returns what the first process sent by tellAll(), in the order of sending. Throws Cancelled, and Error
    // for any other message.
    PeerBytes hear();
    // Sends bytes from the first process to all others, which receive them with hear(). Returns when they
    // have been sent. Throws PeerFailure and Cancelled.
    void tellAll(const PeerBytes& bytes);

    // Throws PeerFailure in the first process where another one has failed.
    void throwIfFailed() const;
    bool failed() const;
    // Ends the run normally, called by all: the others wait for the first one. Throws PeerFailure and
    // Cancelled.
    void leave();
    // Ends all processes of the run. The line is printed on standard error, once for the run; after a stop
    // only the first process prints one.
    [[noreturn]] void fail(const std::string& line);

    PieceDesk* desk() { return mDesk.get(); }  // null except in the first of several processes

private:
    void greet(const std::string& greeting);
    PeerMessage waitFor(PeerKind kind, PeerKind orKind);
    PeerMessage waitFor(PeerKind kind) { return waitFor(kind, kind); }

    std::unique_ptr<PeerLink> mLink;   // null: this process is alone
    std::unique_ptr<PieceDesk> mDesk;  // null except in the first of several processes
    int mRank = 0, mCount = 1, mThreads = 0;
    bool mSame = true;
    int mPhase = 0;               // number of calls of serve()
    std::deque<PeerBytes> mTold;  // messages of tellAll() that arrived before hear()
};

// Returns the peers of this process; it is alone until joinRun() has found others.
Peers& peersOfThisRun();
// Returns the first process's value in all processes, so that they continue with the same. T: trivially
// copyable.
template <typename T>
T asTheFirst(Peers& peers, const T& found) {
    if (peers.alone()) return found;
    if (!peers.first()) return ByteReader(peers.hear()).get<T>();
    peers.tellAll(ByteWriter().put(found).take());
    return found;
}
// Joins the processes that were started with this one, if any. greeting: as for Peers. Throws Error where
// they can not be reached, or were started with another command.
void joinRun(const std::string& greeting);

}  // namespace stereonav
