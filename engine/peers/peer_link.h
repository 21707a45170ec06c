// Carries bytes between the processes of a run: MPI's module (engine/peers/mpi), or in tests a queue. No
// function waits, so that callers can sleep between calls and notice a stop.
#pragma once

#include <memory>
#include <optional>

#include "engine/peers/peer_bytes.h"

namespace stereonav {

enum class PeerKind : int { Hello, Welcome, Request, Order, Done, Result, Tell, Failure, Leave };

// A message that came from the process of rank `from`.
struct PeerMessage {
    int from = 0;
    PeerKind kind = PeerKind::Hello;
    PeerBytes bytes;
};

// May be called by any thread.
class PeerLink {
public:
    virtual ~PeerLink() = default;
    virtual int rank() const = 0;
    virtual int count() const = 0;
    // Begins to send. Messages from one process to another arrive in the order of sending.
    virtual void send(int to, PeerKind kind, PeerBytes bytes) = 0;
    // Returns the next message that has arrived, if any.
    virtual std::optional<PeerMessage> next() = 0;
    // Returns whether a message is on its way to or from here, so that next() should be called again without
    // a pause.
    virtual bool busy() = 0;
    // Ends the link; the last call of every process.
    virtual void leave() = 0;
    // Ends all processes of the run, including this one.
    [[noreturn]] virtual void abort() = 0;
};

// Joins the processes of this MPI run, through the module stereonav_mpi. Once. Throws Error.
std::unique_ptr<PeerLink> joinMpi();

struct MpiFunctions {
    decltype(&stereonav::joinMpi) join;
};

}  // namespace stereonav
