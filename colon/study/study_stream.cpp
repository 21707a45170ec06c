#include "colon/study/study_stream.h"

#include <bzlib.h>
#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/regular_file.h"

namespace stereonav {
namespace {
namespace fs = std::filesystem;

constexpr std::size_t kInputBlock = 1 << 18;
constexpr std::size_t kMostAtOnce = 1 << 30;  // the libraries count in 32 bits
constexpr std::size_t kBehind = 1 << 16;  // bytes beyond the samples within which a checksum is looked for

class PlainStream : public ByteStream {
public:
    PlainStream(const fs::path& data, std::uint64_t offset) : mData(data), mIn(data) { mIn.seek(offset); }
    std::size_t read(unsigned char* to, std::size_t count) override { return mIn.read(to, count); }
    [[noreturn]] void refuse(const std::string& problem) const {
        throw Error(mData.string(), "", problem, "copy or save the file again");
    }

private:
    fs::path mData;
    RegularFile mIn;
};

// A stream of streams: gzip and bzip2 files may be several, one after another.
class PackedStream : public ByteStream {
public:
    PackedStream(const fs::path& data, std::uint64_t offset) : mFile(data, offset), mInput(kInputBlock) {}

    std::size_t read(unsigned char* to, std::size_t count) override {
        std::size_t done = 0;
        while (done < count && !mAtEnd) {
            if (mGiven == mHeld) fill();
            const std::size_t before = mGiven;
            const std::size_t made = decode(to + done, std::min(count - done, kMostAtOnce));
            done += made;
            if (made == 0 && mGiven == before && mGiven == mHeld && mFileAtEnd) break;  // cut off
        }
        return done;
    }
    void finish() override {
        std::vector<unsigned char> behind(kBehind);
        read(behind.data(), behind.size());
    }

protected:
    // From input() on; moves it with take(). Returns the bytes made.
    virtual std::size_t decode(unsigned char* to, std::size_t count) = 0;
    unsigned char* input() { return mInput.data() + mGiven; }
    std::size_t inputCount() const { return mHeld - mGiven; }
    void take(std::size_t count) { mGiven += count; }
    // Called at the end of one stream: returns true where another one follows that begins with `first`.
    bool another(unsigned char first) {
        if (mGiven == mHeld) fill();
        mAtEnd = mGiven == mHeld || mInput[mGiven] != first;
        return !mAtEnd;
    }
    [[noreturn]] void damaged(const char* what) const {
        mFile.refuse(fmt::format("damaged: its compressed samples can not be unpacked ({})", what));
    }

private:
    void fill() {
        mGiven = 0;
        mHeld = mFile.read(mInput.data(), mInput.size());
        mFileAtEnd = mHeld < mInput.size();
    }

    PlainStream mFile;
    std::vector<unsigned char> mInput;
    std::size_t mGiven = 0, mHeld = 0;
    bool mFileAtEnd = false, mAtEnd = false;
};

class InflateStream : public PackedStream {
public:
    InflateStream(const fs::path& data, std::uint64_t offset) : PackedStream(data, offset) {
        if (inflateInit2(&mStream, 32 + MAX_WBITS) != Z_OK) throw std::bad_alloc();  // 32: gzip or zlib
    }
    ~InflateStream() override { inflateEnd(&mStream); }

private:
    std::size_t decode(unsigned char* to, std::size_t count) override {
        mStream.next_in = input();
        mStream.avail_in = static_cast<uInt>(inputCount());
        mStream.next_out = to;
        mStream.avail_out = static_cast<uInt>(count);
        const int state = inflate(&mStream, Z_NO_FLUSH);
        take(inputCount() - mStream.avail_in);
        if (state == Z_STREAM_END) {
            if (another(0x1f)) inflateReset(&mStream);
        } else if (state != Z_OK && state != Z_BUF_ERROR) {
            damaged(mStream.msg ? mStream.msg : "not gzip or zlib");
        }
        return count - mStream.avail_out;
    }

    z_stream mStream{};
};

class Bzip2Stream : public PackedStream {
public:
    Bzip2Stream(const fs::path& data, std::uint64_t offset) : PackedStream(data, offset) { start(); }
    ~Bzip2Stream() override { BZ2_bzDecompressEnd(&mStream); }

private:
    void start() {
        mStream = {};
        if (BZ2_bzDecompressInit(&mStream, 0, 0) != BZ_OK) throw std::bad_alloc();
    }
    std::size_t decode(unsigned char* to, std::size_t count) override {
        mStream.next_in = reinterpret_cast<char*>(input());
        mStream.avail_in = static_cast<unsigned>(inputCount());
        mStream.next_out = reinterpret_cast<char*>(to);
        mStream.avail_out = static_cast<unsigned>(count);
        const int state = BZ2_bzDecompress(&mStream);
        take(inputCount() - mStream.avail_in);
        const std::size_t made = count - mStream.avail_out;
        if (state == BZ_STREAM_END) {
            BZ2_bzDecompressEnd(&mStream);
            another('B');
            start();
        } else if (state != BZ_OK) {
            damaged(state == BZ_DATA_ERROR_MAGIC ? "not bzip2" : "bzip2");
        }
        return made;
    }

    bz_stream mStream{};
};

}  // namespace

std::unique_ptr<ByteStream> openStream(const fs::path& data, std::uint64_t offset, SampleEncoding encoding) {
    switch (encoding) {
        case SampleEncoding::Deflate:
            return std::make_unique<InflateStream>(data, offset);
        case SampleEncoding::Bzip2:
            return std::make_unique<Bzip2Stream>(data, offset);
        default:
            return std::make_unique<PlainStream>(data, offset);
    }
}

}  // namespace stereonav
