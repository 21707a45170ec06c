#include "terrain/read/gdal/netcdf_size.h"

#include <algorithm>
#include <fstream>
#include <string_view>
#include <vector>

namespace stereonav {
namespace {

constexpr std::uint64_t kMostBytes = 1ull << 50;  // more than any file has

// Big-endian numbers one after the other; after the end all is 0, and whole() is false. Each count that is
// read is of things that take bytes of their own, so that none is larger than the file.
class HeaderReader {
public:
    explicit HeaderReader(const std::filesystem::path& file) : mStream(file, std::ios::binary) {
        std::error_code failed;
        mBytes = std::filesystem::file_size(file, failed);
        if (failed) mBytes = 0;
        char magic[4] = {};
        mStream.read(magic, sizeof magic);
        if (std::string_view(magic, 3) == "CDF") mVersion = static_cast<unsigned char>(magic[3]);
    }
    int version() const { return mVersion; }
    bool whole() const { return mStream.good() && !mTooMany; }

    std::uint64_t number(int bytes) {
        unsigned char read[8] = {};
        mStream.read(reinterpret_cast<char*>(read), bytes);
        std::uint64_t value = 0;
        for (int n = 0; n < bytes; ++n) value = value << 8 | read[n];
        return value;
    }
    // How many things follow: a number of 4 bytes, in version 5 of 8.
    std::uint64_t count() {
        const std::uint64_t value = number(mVersion == 5 ? 8 : 4);
        mTooMany |= value > mBytes;
        return whole() ? value : 0;
    }
    std::uint64_t size() { return number(mVersion == 5 ? 8 : 4); }
    std::uint64_t place() { return number(mVersion == 1 ? 4 : 8); }
    void skip(std::uint64_t bytes) {
        mStream.seekg(static_cast<std::streamoff>((bytes + 3) / 4 * 4), std::ios::cur);
    }
    // Reads a list's tag and returns the number of its entries.
    std::uint64_t list() {
        number(4);
        return count();
    }
    void skipName() { skip(count()); }

private:
    std::ifstream mStream;
    std::uint64_t mBytes = 0;
    int mVersion = 0;
    bool mTooMany = false;
};

std::uint64_t bytesOfType(std::uint64_t type) {
    constexpr std::uint64_t kBytes[] = {0, 1, 1, 2, 4, 4, 8, 1, 2, 4, 8, 8};
    return type < std::size(kBytes) ? kBytes[type] : 0;
}

void skipAttributes(HeaderReader& header) {
    for (std::uint64_t n = header.list(); n > 0 && header.whole(); --n) {
        header.skipName();
        const std::uint64_t type = header.number(4);
        header.skip(header.count() * bytesOfType(type));
    }
}

// Returns the product, kMostBytes where it would be larger than any file.
std::uint64_t times(std::uint64_t a, std::uint64_t b) {
    return b != 0 && a > kMostBytes / b ? kMostBytes : a * b;
}

struct Variable {
    std::uint64_t begin = 0, bytes = 0;  // place and size of one record, where it has records
    bool hasRecords = false;
};

Variable readVariable(HeaderReader& header, const std::vector<std::uint64_t>& dimensions) {
    Variable variable;
    header.skipName();
    std::uint64_t samples = 1;
    const std::uint64_t axes = header.count();
    for (std::uint64_t n = 0; n < axes && header.whole(); ++n) {
        const std::uint64_t dimension = header.size();
        if (dimension >= dimensions.size()) continue;
        if (n == 0 && dimensions[dimension] == 0)
            variable.hasRecords = true;
        else
            samples = times(samples, dimensions[dimension]);
    }
    skipAttributes(header);
    variable.bytes = times(samples, bytesOfType(header.number(4)));
    header.size();  // which large ones do not tell
    variable.begin = header.place();
    return variable;
}

}  // namespace

std::optional<std::uint64_t> classicNetCdfSize(const std::filesystem::path& file) {
    HeaderReader header(file);
    if (header.version() != 1 && header.version() != 2 && header.version() != 5) return std::nullopt;
    const std::uint64_t records = header.size();
    const bool streamed = records == (header.version() == 5 ? ~0ull : 0xffffffffull);
    std::vector<std::uint64_t> dimensions;
    for (std::uint64_t n = header.list(); n > 0 && header.whole(); --n) {
        header.skipName();
        dimensions.push_back(header.size());
    }
    skipAttributes(header);
    std::uint64_t end = 0, record = 0, first = 0;
    for (std::uint64_t n = header.list(); n > 0 && header.whole(); --n) {
        const Variable variable = readVariable(header, dimensions);
        if (variable.begin > kMostBytes) return kMostBytes;
        if (!variable.hasRecords) {
            end = std::max(end, variable.begin + variable.bytes);
            continue;
        }
        first = first == 0 ? variable.begin : std::min(first, variable.begin);
        record += (variable.bytes + 3) / 4 * 4;
    }
    if (!header.whole()) return kMostBytes;
    if (record > 0 && !streamed)
        end = std::max(end, first + times(record, records) - std::min<std::uint64_t>(record, 3));
    return end;
}

}  // namespace stereonav
