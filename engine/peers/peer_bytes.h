// Writes values and arrays one after the other into bytes, for messages between processes of one build on
// machines of one kind: as they lie in memory.
#pragma once

#include <cstddef>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/base/error.h"

namespace stereonav {

using PeerBytes = std::vector<std::byte>;

class ByteWriter {
public:
    template <typename T>
    ByteWriter& put(const T& value) {
        return putAll(std::span<const T>(&value, 1));
    }
    // Writes the values without their number, which the reader must know.
    template <typename T>
    ByteWriter& putAll(std::span<const T> values) {
        static_assert(std::is_trivially_copyable_v<T>);
        append(std::as_bytes(values));
        return *this;
    }
    // Writes the values after their number.
    template <typename T>
    ByteWriter& putArray(std::span<const T> values) {
        return put(values.size()).putAll(values);
    }
    ByteWriter& putText(const std::string& text) { return putArray(std::span<const char>(text)); }
    PeerBytes take() { return std::move(mBytes); }

private:
    void append(std::span<const std::byte> bytes);

    PeerBytes mBytes;
};

// Reads what ByteWriter wrote, in the same order. Throws Error where there are fewer bytes than needed. The
// bytes must outlive this object.
class ByteReader {
public:
    explicit ByteReader(std::span<const std::byte> bytes) : mLeft(bytes) {}

    // These four functions throw Error where fewer bytes are left than they need.
    template <typename T>
    T get() {
        T value{};
        getAll(std::span<T>(&value, 1));
        return value;
    }
    template <typename T>
    void getAll(std::span<T> values) {
        static_assert(std::is_trivially_copyable_v<T>);
        if (values.empty()) return;
        std::memcpy(values.data(), next(values.size(), sizeof(T)).data(), values.size_bytes());
    }
    template <typename T>
    std::vector<T> getArray() {
        const auto count = get<std::size_t>();
        const std::span<const std::byte> bytes = next(count, sizeof(T));
        std::vector<T> values(count);
        if (count > 0) std::memcpy(values.data(), bytes.data(), bytes.size());
        return values;
    }
    std::string getText() {
        const std::vector<char> text = getArray<char>();
        return {text.begin(), text.end()};
    }
    std::size_t left() const { return mLeft.size(); }

private:
    std::span<const std::byte> next(std::size_t count, std::size_t each) {
        if (count > mLeft.size() / each)
            throw Error("", "message between processes", "is shorter than it says",
                        "start all processes from the same build");
        const std::span<const std::byte> bytes = mLeft.first(count * each);
        mLeft = mLeft.subspan(count * each);
        return bytes;
    }
    std::span<const std::byte> mLeft;
};

}  // namespace stereonav
