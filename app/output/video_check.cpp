#include "app/output/video_check.h"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <string>

namespace stereonav {
namespace {

constexpr std::uint64_t kAviOfOneRiff = 1'000'000'000;  // bytes; longer files have several counts

class Container {
public:
    explicit Container(const std::filesystem::path& file) : mIn(file, std::ios::binary) {
        std::error_code code;
        mBytes = std::filesystem::file_size(file, code);
        if (code) mBytes = 0;
    }

    std::uint64_t bytes() const { return mBytes; }

    // Returns false beyond the end.
    bool go(std::uint64_t to) {
        if (to >= mBytes) return false;
        mIn.clear();
        return static_cast<bool>(mIn.seekg(static_cast<std::streamoff>(to)));
    }
    std::uint64_t big(int count) {
        std::uint64_t value = 0;
        for (int n = 0; n < count; ++n) value = value << 8 | byte();
        return value;
    }
    std::uint64_t little(int count) {
        std::uint64_t value = 0;
        for (int n = 0; n < count; ++n) value |= std::uint64_t{byte()} << (8 * n);
        return value;
    }
    std::string name() {
        std::string four;
        for (int n = 0; n < 4; ++n) four += static_cast<char>(byte());
        return four;
    }
    bool good() const { return mIn.good(); }

private:
    std::uint8_t byte() {
        const int c = mIn.get();
        return c < 0 ? 0 : static_cast<std::uint8_t>(c);
    }
    std::ifstream mIn;
    std::uint64_t mBytes = 0;
};

// Format by ISO/IEC 14496-12: a sequence of boxes, one of which is the index.
bool isEndedMp4(Container file) {
    bool index = false;
    std::uint64_t at = 0;
    while (file.go(at)) {
        std::uint64_t size = file.big(4);
        const std::string name = file.name();
        if (size == 1) size = file.big(8);  // box with a 64-bit size
        if (!file.good() || size < 8) return false;
        index = index || name == "moov";
        at += size;
    }
    return index && at == file.bytes();
}

// Returns the largest size in the index, which has entries of 16 bytes, one per picture.
std::uint64_t largestPicture(Container& file, std::uint64_t index, std::uint64_t bytes) {
    std::uint64_t largest = 0;
    for (std::uint64_t at = index; at + 16 <= index + bytes; at += 16)
        if (file.go(at + 12)) largest = std::max(largest, file.little(4));
    return largest;
}

// Format by RIFF: a sequence of chunks, of which the first has the header with its counts; then follow
// pictures and the index. FFmpeg fills in the size of the largest picture last.
bool isEndedAvi(Container file, long long frames) {
    std::uint64_t at = 0;
    while (file.go(at)) {
        const bool riff = file.name() == "RIFF";
        const std::uint64_t size = file.little(4);
        if (!file.good() || !riff || size < 4) return false;
        at += 8 + size;
    }
    if (at != file.bytes() || at == 0) return false;
    constexpr std::uint64_t kChunks = 12, kFrames = 140, kLargest = 144;  // offsets in the stream's header
    if (!file.go(kFrames) || static_cast<long long>(file.little(4)) != frames) return false;
    if (file.bytes() > kAviOfOneRiff) return true;
    for (at = kChunks; file.go(at);) {
        const std::string name = file.name();
        const std::uint64_t size = file.little(4), next = at + 8 + size + size % 2;
        if (!file.good() || next > file.bytes()) return false;
        if (name == "idx1") {
            const std::uint64_t largest = largestPicture(file, at + 8, size);
            return next == file.bytes() && file.go(kLargest) && file.little(4) == largest;
        }
        at = next;
    }
    return false;
}

// Format by RFC 8794: a header and a segment, whose size has all bits set until it is known.
bool isEndedMkv(Container file) {
    constexpr std::uint64_t kHeader = 0x1A45DFA3, kSegment = 0x18538067;
    std::uint64_t at = 0;
    for (const std::uint64_t expected : {kHeader, kSegment}) {
        if (!file.go(at) || file.big(4) != expected) return false;
        const std::uint64_t first = file.big(1);
        int more = 0;
        while (more < 8 && !(first & (0x80u >> more))) ++more;
        if (more == 8) return false;
        const std::uint64_t size = (first & (0x7Fu >> more)) << (8 * more) | file.big(more);
        const std::uint64_t unknown = (std::uint64_t{1} << (7 * (more + 1))) - 1;
        if (!file.good() || size == unknown) return false;
        at += 4 + 1 + static_cast<std::uint64_t>(more) + size;
    }
    return at == file.bytes();
}

}  // namespace

bool isEndedVideo(const std::filesystem::path& file, long long frames) {
    const std::string extension = file.extension().string();
    if (extension == ".mp4") return isEndedMp4(Container(file));
    if (extension == ".avi") return isEndedAvi(Container(file), frames);
    if (extension == ".mkv") return isEndedMkv(Container(file));
    return true;
}

}  // namespace stereonav
