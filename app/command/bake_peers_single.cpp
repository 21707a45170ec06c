// One process: nobody to wait for.
#include "app/command/bake_peers.h"

namespace stereonav {

BakePeers::BakePeers() = default;
BakePeers::~BakePeers() = default;

int BakePeers::threads() const {
    return 0;
}

BakeEnd BakePeers::meet(BakeSums&, BakeEnd own) const {
    return own;
}

void BakePeers::gather(BakeSums&) const {}

bool BakePeers::decide(bool mine) const {
    return mine;
}

void BakePeers::checkSameStart(const BakeSums&) const {}

}  // namespace stereonav
