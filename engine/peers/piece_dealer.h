// Work in pieces, dealt out by the first process to whoever is free, itself among them: the fast get more.
// What the pieces come to does not depend on who made them.
#pragma once

#include <cstddef>
#include <functional>
#include <limits>

#include "engine/peers/peers.h"

namespace stereonav {

struct PieceWork {
    std::size_t count = 0;
    // Returns what a process has to know for the piece; may be empty. On another thread than `make` and
    // `take`, at a time when this piece is with nobody.
    std::function<PeerBytes(std::size_t piece)> order;
    // Makes a piece in this process, as others do in serve().
    Peers::Make make;
    // Takes what a piece came to: where `inOrder` by ascending pieces, else as they come.
    std::function<void(std::size_t piece, std::span<const std::byte> result)> take;
    bool inOrder = false;
    // How far, in order, pieces may be begun beyond the first that is not taken yet, which bounds what waits.
    std::size_t ahead = std::numeric_limits<std::size_t>::max();
    // Whether no more pieces are to be begun; may be empty. Those that others have are waited for shortly.
    std::function<bool()> ended;
};

// Deals work from the first process. While it lives the others may be in serve().
class PieceDealer {
public:
    explicit PieceDealer(Peers& peers);
    ~PieceDealer();
    PieceDealer(const PieceDealer&) = delete;
    PieceDealer& operator=(const PieceDealer&) = delete;

    // Deals all pieces, `make` and `take` on this thread. Throws what they do, PeerFailure where another
    // process failed, and Cancelled.
    // failed, and Cancelled.
    void deal(const PieceWork& work);

private:
    PieceDesk* mDesk;  // null: alone
};

}  // namespace stereonav
