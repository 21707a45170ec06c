#include "engine/base/hash.h"

#include <cstring>

namespace stereonav {

Hash& Hash::add(const void* data, std::size_t bytes) {
    constexpr std::uint64_t kPrime = 0x100000001b3ull;
    const auto* p = static_cast<const unsigned char*>(data);
    for (; bytes >= 8; bytes -= 8, p += 8) {
        std::uint64_t word;
        std::memcpy(&word, p, 8);
        mState = (mState ^ word) * kPrime;
        mState ^= mState >> 29;
    }
    for (; bytes > 0; --bytes, ++p) mState = (mState ^ *p) * kPrime;
    return *this;
}

std::uint64_t Hash::value() const {
    std::uint64_t x = mState;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
    return x ^ (x >> 31);
}

}  // namespace stereonav
