// Carries bytes between the processes of a run: MPI's module (engine/peers/mpi), or in tests a queue. Nothing
// here waits, so that who waits can sleep, and hear of a stop.
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

// Any thread may call it.
class PeerLink {
public:
    virtual ~PeerLink() = default;
    virtual int rank() const = 0;
    virtual int count() const = 0;
    // Begins to send. Messages from one to another arrive in their order.
    virtual void send(int to, PeerKind kind, PeerBytes bytes) = 0;
    // Returns what came, if anything has.
    virtual std::optional<PeerMessage> next() = 0;
    // Returns whether something is on its way to or from here, so that next() is worth calling without a
    // pause.
    virtual bool busy() = 0;
    // Ends the link, as the last call of every process.
    virtual void leave() = 0;
    // Ends the run, this process among it.
    [[noreturn]] virtual void abort() = 0;
};

// Joins the processes of this MPI run, through the module stereonav_mpi. Once. Throws Error.
std::unique_ptr<PeerLink> joinMpi();

struct MpiFunctions {
    decltype(&stereonav::joinMpi) join;
};

}  // namespace stereonav
