#include "engine/peers/piece_dealer.h"

#include "engine/peers/piece_desk.h"

namespace stereonav {

PieceDealer::PieceDealer(Peers& peers) : mDesk(peers.desk()) {
    if (mDesk) mDesk->open();
}

PieceDealer::~PieceDealer() {
    if (mDesk) mDesk->close();
}

void PieceDealer::deal(const PieceWork& work) {
    if (mDesk) return mDesk->deal(work);
    for (std::size_t n = 0; n < work.count; ++n) {
        if (work.ended && work.ended()) return;
        const PeerBytes order = work.order ? work.order(n) : PeerBytes{};
        work.take(n, work.make(n, order));
    }
}

}  // namespace stereonav
