// A 64-bit content hash (FNV-1a over 8-byte words with a final mix): cache keys and playback
// tests. Stable between runs and machines of the same byte order; not for security.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace stereonav {

class Hash {
public:
    // Hashes these bytes after all earlier ones. The other overloads add the bytes of a text or of a number.
    Hash& add(const void* data, std::size_t bytes);
    Hash& add(std::string_view text) { return add(text.data(), text.size()); }
    Hash& add(double value) { return add(&value, sizeof value); }
    Hash& add(std::int64_t value) { return add(&value, sizeof value); }
    std::uint64_t value() const;

private:
    std::uint64_t mState = 0xcbf29ce484222325ull;
};

}  // namespace stereonav
