// Work in pieces, which the first process deals out to every process that is free, including itself: faster
// ones get more. The results do not depend on who made a piece.
#pragma once

#include <cstddef>
#include <functional>
#include <limits>

#include "engine/peers/peers.h"

namespace stereonav {

struct PieceWork {
    std::size_t count = 0;
    // Returns the data that a process needs for the piece; may be empty. Called on another thread than `make`
    // and `take`, before the piece is given to anybody.
    std::function<PeerBytes(std::size_t piece)> order;
    // Makes a piece in this process, like serve() in others.
    Peers::Make make;
    // Takes the result of a piece: in ascending order where `inOrder`, else as results come.
    std::function<void(std::size_t piece, std::span<const std::byte> result)> take;
    bool inOrder = false;
    // Number of pieces that may be begun after the first one that is not taken yet, if in order; it limits
    // the results that wait.
    std::size_t ahead = std::numeric_limits<std::size_t>::max();
    // Returns whether no more pieces should be begun; may be empty. Pieces that others are making are waited
    // for shortly.
    std::function<bool()> ended;
};

// Deals work from the first process. While it lives the others may call serve().
class PieceDealer {
public:
    explicit PieceDealer(Peers& peers);
    ~PieceDealer();
    PieceDealer(const PieceDealer&) = delete;
    PieceDealer& operator=(const PieceDealer&) = delete;

    // Deals all pieces; calls `make` and `take` on this thread. Throws their exceptions, PeerFailure where
    // another process failed, and Cancelled.
    void deal(const PieceWork& work);

private:
    PieceDesk* mDesk;  // null: this process is alone
};

}  // namespace stereonav
