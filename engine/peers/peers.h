// The processes of this run that share a command's work: this one alone, or those that mpirun or srun
// started. The first one (rank 0) deals out pieces of work as the others ask for them, makes pieces itself,
// and alone writes results (piece_dealer.h); the others make what they are given.
//
// The others call MPI on the thread that works. The first one has a thread of its own for messages, so that
// nobody waits for a piece that it makes. Who waits sleeps: MPI's own waiting keeps a core busy.
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

// The failure of another process: its whole line.
class PeerFailure : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

class Peers {
public:
    Peers();  // one process: nothing is loaded, no thread started
    // Joins the others; called by all processes at once. greeting: the same for all, or check() throws.
    // Throws Error where a message is not the one expected, and Cancelled.
    Peers(std::unique_ptr<PeerLink> link, const std::string& greeting);
    ~Peers();
    Peers(const Peers&) = delete;
    Peers& operator=(const Peers&) = delete;

    int rank() const { return mRank; }
    int count() const { return mCount; }
    bool first() const { return mRank == 0; }
    bool alone() const { return mCount == 1; }
    // Threads of this process, where those that may run on the same cores share them evenly; 0: it is alone,
    // and takes all.
    int threads() const { return mThreads; }
    // Throws Error where the processes were not given the same.
    void check() const;

    // A function that makes a piece by its order.
    using Make = std::function<PeerBytes(std::size_t piece, std::span<const std::byte> order)>;
    // Makes, in the other processes, what the first one deals (a PieceDealer) until it closes. Throws what
    // `make` does, and Cancelled.
    void serve(const Make& make);
    // Returns what the first one told all, in the order that it was told in. Throws Cancelled, and Error for
    // another message.
    PeerBytes hear();
    // Tells all others, from the first one, what they hear. Returns when it has been sent. Throws PeerFailure
    // and Cancelled.
    void tellAll(const PeerBytes& bytes);

    // Throws PeerFailure in the first one where another one has failed.
    void throwIfFailed() const;
    bool failed() const;
    // Ends the run well, called by all: the others wait for the first one. Throws PeerFailure and Cancelled.
    void leave();
    // Ends all processes of the run. Tells the line, on standard error and once for the run; a run that was
    // stopped has none but the first one's.
    [[noreturn]] void fail(const std::string& line);

    PieceDesk* desk() { return mDesk.get(); }  // null but for the first of several

private:
    void greet(const std::string& greeting);
    PeerMessage waitFor(PeerKind kind, PeerKind orKind);
    PeerMessage waitFor(PeerKind kind) { return waitFor(kind, kind); }

    std::unique_ptr<PeerLink> mLink;   // null: alone
    std::unique_ptr<PieceDesk> mDesk;  // null but for the first of several
    int mRank = 0, mCount = 1, mThreads = 0;
    bool mSame = true;
    int mPhase = 0;               // number of calls of serve()
    std::deque<PeerBytes> mTold;  // what came before it was asked for
};

// The peers of this process, which is alone until joinRun() has found otherwise.
Peers& peersOfThisRun();
// Returns what the first process found, so that all of them go on with it. T: trivially copyable.
template <typename T>
T asTheFirst(Peers& peers, const T& found) {
    if (peers.alone()) return found;
    if (!peers.first()) return ByteReader(peers.hear()).get<T>();
    peers.tellAll(ByteWriter().put(found).take());
    return found;
}
// Joins those that were started with this one, if any. greeting: as for Peers. Throws Error where they can
// not be reached, or were started with other words.
void joinRun(const std::string& greeting);

}  // namespace stereonav
