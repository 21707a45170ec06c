// The bytes of a data file, decoded: as they are, inflated (gzip, zlib) or out of bzip2. Shared among
// colon/study/*.cpp only.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>

#include "colon/study/study_header.h"

namespace stereonav {

class ByteStream {
public:
    virtual ~ByteStream() = default;
    // Reads up to `count` bytes, fewer only at the end, and returns how many. Throws Error where they are
    // damaged.
    virtual std::size_t read(unsigned char* to, std::size_t count) = 0;
    // Called after the last byte that is wanted: throws Error where the stream's own checksum, if it stands
    // just behind, says that they are wrong.
    virtual void finish() {}
};

// Opens a stream. offset: bytes of the file to leave out. Text and Hex come as they are. Throws Error where
// `data` can not be opened, or is no file.
std::unique_ptr<ByteStream> openStream(const std::filesystem::path& data, std::uint64_t offset,
                                       SampleEncoding encoding);

}  // namespace stereonav
