#include "engine/peers/peer_bytes.h"

namespace stereonav {

void ByteWriter::append(std::span<const std::byte> bytes) {
    mBytes.insert(mBytes.end(), bytes.begin(), bytes.end());
}

}  // namespace stereonav
