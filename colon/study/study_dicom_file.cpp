// GDCM allocates whatever a length says and ends the program over lengths and kinds of values that make no
// sense (found by damaging files); so elements are walked over here first.
#include "colon/study/study_dicom_file.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "engine/base/memory.h"
#include "engine/base/stop.h"
#include "engine/text/number.h"

namespace stereonav {
namespace {
namespace fs = std::filesystem;

constexpr std::uint64_t kHeadAt = 132;
constexpr std::uint32_t kUnknownLength = 0xffffffff;
constexpr std::uint32_t kItem = 0xfffee000, kItemEnd = 0xfffee00d, kSequenceEnd = 0xfffee0dd;
constexpr std::uint32_t kPixels = 0x7fe00010;
constexpr int kDeepest = 32;                     // sequences within sequences
constexpr std::uint64_t kLongestKept = 1 << 17;  // bytes of a value: a table of 65536
constexpr std::size_t kMostItems = 1'000'000;    // items of sequences that a study is read from
constexpr std::size_t kTellEach = 64 << 20;      // bytes that are unpacked between two looks for a stop
// Bytes of a data set of the deflated syntax.
constexpr std::uint64_t kFirstDeflated = 1 << 20, kMostDeflatedHead = 64 << 20, kMostDeflated = 1 << 30;
constexpr double kMostSpare = 1 << 20;  // bytes: largest remainder of the pixels beyond their rows and frames
constexpr const char *kImplicit = "1.2.840.10008.1.2", *kDeflated = "1.2.840.10008.1.2.1.99",
                     *kBigEndian = "1.2.840.10008.1.2.2", *kDirectory = "1.2.840.10008.1.3.10";

constexpr std::uint32_t kKept[] = {
    0x00080005, 0x00080008, 0x00080016, 0x00080018, 0x00080020, 0x00080030, 0x00080050, 0x00080060,
    0x00080090, 0x00081030, 0x0008103e, 0x00100010, 0x00100020, 0x00100030, 0x00100040, 0x00180088,
    0x00181210, 0x0020000d, 0x0020000e, 0x00200010, 0x00200032, 0x00200037, 0x00200052, 0x00209113,
    0x00209116, 0x00280002, 0x00280008, 0x00280010, 0x00280011, 0x00280030, 0x00280100, 0x00280101,
    0x00280102, 0x00280103, 0x00280120, 0x00280121, 0x00281052, 0x00281053, 0x00283000, 0x00283002,
    0x00283006, 0x00289110, 0x00289145, 0x3004000c, 0x3004000e, 0x52009229, 0x52009230};

bool isKept(std::uint32_t tag) {
    return std::binary_search(std::begin(kKept), std::end(kKept), tag);
}

// Returns whether the element is a sequence, by its tag, for syntaxes that do not state the type.
bool isSequence(std::uint32_t tag) {
    return tag == 0x52009229 || tag == 0x52009230 || tag == 0x00209113 || tag == 0x00209116 ||
           tag == 0x00283000 || tag == 0x00289110 || tag == 0x00289145;
}

bool isOneOf(const char* kind, std::initializer_list<const char*> names) {
    return std::any_of(names.begin(), names.end(),
                       [&](const char* n) { return std::memcmp(n, kind, 2) == 0; });
}
bool isShortKind(const char* kind) {
    return isOneOf(kind, {"AE", "AS", "AT", "CS", "DA", "DS", "DT", "FD", "FL", "IS", "LO",
                          "LT", "PN", "SH", "SL", "SS", "ST", "TM", "UI", "UL", "US"});
}
bool isLongKind(const char* kind) {
    return isOneOf(kind, {"OB", "OD", "OF", "OL", "OV", "OW", "SQ", "SV", "UC", "UN", "UR", "UT", "UV"});
}

std::string plainText(const std::string& bytes) {
    const auto first = bytes.find_first_not_of(' ');
    if (first == std::string::npos) return "";
    const auto last = bytes.find_last_not_of(std::string(" \0", 2));
    return last == std::string::npos || last < first ? "" : bytes.substr(first, last - first + 1);
}

struct Fault {
    std::string clause;
};

// Unpacks a deflate stream without a header, as far as its bytes are needed.
class Inflater {
public:
    Inflater(const unsigned char* data, std::uint64_t size) : mData(data), mLeft(size) {
        if (inflateInit2(&mStream, -MAX_WBITS) != Z_OK) throw std::bad_alloc();
    }
    ~Inflater() { inflateEnd(&mStream); }
    Inflater(const Inflater&) = delete;
    Inflater& operator=(const Inflater&) = delete;

    // Unpacks more bytes until there are `bytes` bytes, or the stream ends.
    void fill(std::vector<unsigned char>& to, std::uint64_t bytes) {
        std::uint64_t at = to.size();
        to.resize(bytes);
        while (mState == Z_OK && at < bytes) {
            throwIfStopped();
            if (mStream.avail_in == 0) {
                mStream.next_in = const_cast<Bytef*>(mData);  // zlib only reads it
                mStream.avail_in = static_cast<uInt>(std::min<std::uint64_t>(mLeft, 1 << 30));
                mData += mStream.avail_in, mLeft -= mStream.avail_in;
            }
            const auto room = static_cast<uInt>(std::min<std::uint64_t>(bytes - at, kTellEach));
            mStream.next_out = to.data() + at;
            mStream.avail_out = room;
            mState = inflate(&mStream, Z_NO_FLUSH);
            at += room - mStream.avail_out;
        }
        to.resize(at);
    }
    bool goesOn() const { return mState == Z_OK; }
    bool isWhole() const { return mState == Z_STREAM_END; }

private:
    const unsigned char* mData;
    std::uint64_t mLeft;
    z_stream mStream{};
    int mState = Z_OK;
};

std::string tagText(std::uint32_t tag) {
    return fmt::format("({:04x},{:04x})", tag >> 16, tag & 0xffff);
}

}  // namespace

std::string DicomItem::text(std::uint32_t tag) const {
    const DicomValue* value = find(tag);
    return value ? plainText(value->bytes) : "";
}

std::vector<double> DicomItem::numbers(std::uint32_t tag, std::size_t count) const {
    std::vector<double> numbers;
    const std::string all = text(tag);
    std::string_view rest = all;
    while (numbers.size() < count) {
        const std::optional<double> number = takeNumber(rest, Plus::Allowed);
        if (!number || !std::isfinite(*number)) break;
        numbers.push_back(*number);
        rest.remove_prefix(std::min(rest.find_first_not_of(" \\"), rest.size()));
    }
    return numbers;
}

// Throws Fault.
class DicomFile::Walk {
public:
    explicit Walk(DicomFile& file)
        : mFile(file), mData(file.mData), mExplicit(file.mExplicit), mBig(file.mBig) {}

    void all() { set(mFile.mStart, mFile.mSize, false, &mFile.mSet, 0); }

private:
    std::uint32_t two(std::uint64_t at) const {
        return mBig ? mData[at] << 8 | mData[at + 1] : mData[at] | mData[at + 1] << 8;
    }
    std::uint32_t four(std::uint64_t at) const {
        return mBig ? two(at) << 16 | two(at + 2) : two(at) | two(at + 2) << 16;
    }
    std::uint32_t tagAt(std::uint64_t at) const { return two(at) << 16 | two(at + 2); }

    struct Head {
        std::uint32_t tag = 0, length = 0;
        bool sequence = false, implicitInside = false;
        std::uint64_t body = 0;
    };

    Head head(std::uint64_t at, std::uint64_t end) const {
        Head h;
        if (end - at < 8) throw Fault{fmt::format("is cut off or damaged at byte {}", at)};
        h.tag = tagAt(at);
        const bool delimiter = h.tag >> 16 == 0xfffe;
        if (delimiter || !mExplicit) {
            h.length = four(at + 4);
            h.body = at + 8;
            h.sequence = isSequence(h.tag);
            return h;
        }
        const char* kind = reinterpret_cast<const char*>(mData + at + 4);
        if (isShortKind(kind)) {
            h.length = two(at + 6);
            h.body = at + 8;
            return h;
        }
        const auto capital = [](char c) { return c >= 'A' && c <= 'Z'; };
        // Kinds of later editions have long lengths (PS3.5 7.1.2).
        if (!isLongKind(kind) && !(capital(kind[0]) && capital(kind[1])))
            throw Fault{
                fmt::format("is damaged: element {} at byte {} has no kind of value", tagText(h.tag), at)};
        if (end - at < 12) throw Fault{fmt::format("is cut off or damaged at byte {}", at)};
        h.length = four(at + 8);
        h.body = at + 12;
        h.sequence = std::memcmp(kind, "SQ", 2) == 0;
        h.implicitInside = std::memcmp(kind, "UN", 2) == 0;  // PS3.5 6.2.2
        return h;
    }

    // Elements up to `end`, or up to the item's delimiter. Returns where it stopped.
    std::uint64_t set(std::uint64_t at, std::uint64_t end, bool delimited, DicomItem* into, int depth) {
        if (depth > kDeepest) throw Fault{"is damaged: its sequences go too deep"};
        while (at < end) {
            if (depth == 0 && restIsPadding(at, end)) return end;
            const Head h = head(at, end);
            if (delimited && h.tag == kItemEnd) return h.body;
            if (h.tag == kPixels && depth == 0) {
                at = pixels(h, end);
                continue;
            }
            const bool unknown = h.length == kUnknownLength;
            if (!unknown && h.length > end - h.body)
                throw Fault{
                    fmt::format("is cut off or damaged: element {} at byte {} says {} bytes, {} are left",
                                tagText(h.tag), at, h.length, end - h.body)};
            DicomValue* kept = into && isKept(h.tag) ? &into->values[h.tag] : nullptr;
            if (h.sequence || unknown) {
                const bool was = std::exchange(mExplicit, mExplicit && !h.implicitInside);
                at = items(h.body, unknown ? end : h.body + h.length, unknown, kept, depth + 1);
                mExplicit = was;
                continue;
            }
            if (kept && h.length <= kLongestKept)
                kept->bytes.assign(reinterpret_cast<const char*>(mData + h.body), h.length);
            at = h.body + h.length;
        }
        if (delimited) throw Fault{"is cut off or damaged: a sequence has no end"};
        return at;
    }

    std::uint64_t items(std::uint64_t at, std::uint64_t end, bool delimited, DicomValue* kept, int depth) {
        while (at < end) {
            if (end - at < 8) throw Fault{fmt::format("is cut off or damaged at byte {}", at)};
            const std::uint32_t tag = tagAt(at), length = four(at + 4);
            if (delimited && tag == kSequenceEnd) return at + 8;
            if (tag != kItem)
                throw Fault{fmt::format("is damaged: a sequence at byte {} holds no items", at)};
            at += 8;
            if (length != kUnknownLength && length > end - at)
                throw Fault{
                    fmt::format("is cut off or damaged: an item at byte {} says {} bytes, {} are left", at,
                                length, end - at)};
            if (kept && ++mItems > kMostItems)
                throw Fault{fmt::format("is damaged: its sequences have more than {} items", kMostItems)};
            DicomItem* item = kept ? &kept->items.emplace_back() : nullptr;
            if (length == kUnknownLength)
                at = set(at, end, true, item, depth);
            else
                at = set(at, at + length, false, item, depth);
        }
        if (delimited) throw Fault{"is cut off or damaged: a sequence has no end"};
        return at;
    }

    // Zeros behind the last element, as tapes leave them. Where they begin is looked up once.
    bool restIsPadding(std::uint64_t at, std::uint64_t end) {
        if (!mFile.mPixels.found) return false;
        if (!mPadding) {
            mPadding = end;
            while (*mPadding > at && mData[*mPadding - 1] == 0) --*mPadding;
        }
        return at >= *mPadding;
    }

    std::uint64_t pixels(const Head& h, std::uint64_t end) {
        Pixels& pixels = mFile.mPixels;
        pixels.found = true;
        pixels.at = h.body;
        pixels.words = mExplicit && std::memcmp(mData + h.body - 8, "OW", 2) == 0;
        pixels.encapsulated = h.length == kUnknownLength;
        if (!pixels.encapsulated) {
            pixels.said = h.length;
            pixels.bytes = std::min<std::uint64_t>(h.length, end - h.body);
            if (h.length > end - h.body) throw Fault{cutPixels(h.length, end - h.body)};
            return h.body + h.length;
        }
        std::uint64_t at = h.body;
        while (end - at >= 8) {
            const std::uint32_t tag = tagAt(at), length = four(at + 4);
            at += 8;
            if (tag == kSequenceEnd) return at;
            if (tag != kItem || length > end - at)
                throw Fault{
                    fmt::format("is cut off or damaged: a part of its pixels at byte {} says {} bytes, {} "
                                "are left",
                                at, length, end - at)};
            pixels.fragments.emplace_back(at, length);
            pixels.bytes += length;
            at += length;
        }
        throw Fault{"is cut off or damaged: its pixels have no end"};
    }

    std::string cutPixels(std::uint64_t said, std::uint64_t left) const {
        const double expected = mFile.pixelBytes();
        if (static_cast<double>(said) <= expected + 1 && static_cast<double>(left) < expected)
            return fmt::format("is cut off: {:.0f} bytes of its pixels are missing",
                               expected - static_cast<double>(left));
        return mFile.tooManyPixels(said);
    }

    DicomFile& mFile;
    const unsigned char* mData;
    bool mExplicit, mBig;
    std::size_t mItems = 0;
    std::optional<std::uint64_t> mPadding;  // start of the zeros that reach to the end
};

int DicomFile::word(std::uint32_t tag, int otherwise) const {
    const DicomValue* value = mSet.find(tag);
    if (!value || value->bytes.size() < 2) return otherwise;
    const auto* b = reinterpret_cast<const unsigned char*>(value->bytes.data());
    return mBig ? b[0] << 8 | b[1] : b[0] | b[1] << 8;
}

bool DicomFile::isDirectory() const {
    return mMediaClass == kDirectory;
}

// Group 2, always explicit and little-endian (PS3.10, 7.1).
void DicomFile::readHead(const fs::path& file) {
    std::uint64_t at = kHeadAt;
    const auto damaged = [&] {
        throw Error(file.string(), fmt::format("byte {}", at), "the DICOM header is damaged",
                    "copy the file again");
    };
    for (;;) {
        if (mSize - at < 8) damaged();
        const unsigned char* h = mData + at;
        if (h[0] != 2 || h[1] != 0) break;
        const char* kind = reinterpret_cast<const char*>(h + 4);
        std::uint64_t length = h[6] | h[7] << 8, body = at + 8;
        if (isLongKind(kind)) {
            if (mSize - at < 12) damaged();
            length = h[8] | h[9] << 8 | h[10] << 16 | static_cast<std::uint32_t>(h[11]) << 24;
            body = at + 12;
        } else if (!isShortKind(kind)) {
            damaged();
        }
        if (length > mSize - body) damaged();
        const std::string value = plainText({reinterpret_cast<const char*>(mData + body), length});
        if (h[2] == 0x10 && h[3] == 0) mSyntax = value;
        if (h[2] == 0x02 && h[3] == 0) mMediaClass = value;
        at = body + length;
    }
    mStart = at;
    mExplicit = mSyntax != kImplicit;
    mBig = mSyntax == kBigEndian;
}

// Returns the number of bytes of the pixels, computed from the elements before them.
double DicomFile::pixelBytes() const {
    const std::uint64_t columns = word(0x00280011, 0), rows = word(0x00280010, 0);
    const std::uint64_t samples = word(0x00280002, 1), bits = word(0x00280100, 16);
    const std::uint64_t bytes = (bits + 7) / 8;
    const auto frames = mSet.numbers(0x00280008, 1);
    return static_cast<double>(columns * rows * samples * bytes) *
           (frames.empty() ? 1 : std::max(frames[0], 1.0));
}

std::string DicomFile::tooManyPixels(std::uint64_t said) const {
    return fmt::format("is damaged: it says {} bytes of pixels, {} x {} of them have {:.0f}", said,
                       word(0x00280011, 0), word(0x00280010, 0), pixelBytes());
}

// Returns how many bytes of a deflated data set to unpack, decided from the bytes unpacked so far: to the end
// of its pixels, or twice as many where these have not begun. Empty, with mDamage set, where it can be no
// picture.
std::optional<std::uint64_t> DicomFile::wantedOf() {
    mSet = {};
    mPixels = {};
    try {
        Walk(*this).all();
    } catch (const Fault&) {  // expected: what is unpacked so far ends in the middle of the set
    }
    if (!mPixels.found && mSize < kMostDeflatedHead) return 2 * mSize;
    if (!mPixels.found)
        mDamage = fmt::format("is damaged: it has no pixels in its first {} bytes, unpacked", mSize);
    else if (mPixels.encapsulated)
        mDamage = "is damaged: its pixels are compressed in a data set that is compressed";
    else if (static_cast<double>(mPixels.said) > pixelBytes() + kMostSpare)
        mDamage = tooManyPixels(mPixels.said);
    else if (mPixels.at + mPixels.said > kMostDeflated)
        mDamage = fmt::format("has {} bytes of pixels in a data set that is compressed, more than are read",
                              mPixels.said);
    else
        return mPixels.at + mPixels.said;
    return std::nullopt;
}

// Unpacks a data set of the deflated syntax, as far as the end of its pixels.
void DicomFile::unpack(const fs::path& file) {
    Inflater stream(mData + mStart, mSize - mStart);
    std::optional<std::uint64_t> wanted = kFirstDeflated;
    mStart = 0;
    while (wanted && *wanted > mUnpacked.size() && stream.goesOn()) {
        checkMemory(file.string(), static_cast<double>(*wanted),
                    "convert it to a syntax that is not deflated");
        stream.fill(mUnpacked, *wanted);
        mData = mUnpacked.data();
        mSize = mUnpacked.size();
        if (stream.goesOn()) wanted = wantedOf();
    }
    if (mDamage.empty() && !stream.goesOn() && !stream.isWhole())
        mDamage = "is cut off or damaged: it can not be unpacked";
    if (mDamage.empty() && stream.goesOn()) mSize = mPixels.at + mPixels.said;
    mSet = {};
    mPixels = {};
}

DicomFile::DicomFile(const fs::path& file) : mFile(file), mData(mFile.data()), mSize(mFile.size()) {
    mHasHead = mSize >= kHeadAt && std::memcmp(mData + 128, "DICM", 4) == 0;
    if (mHasHead) {
        readHead(file);
        if (isDirectory()) return;
        if (mSyntax == kDeflated) unpack(file);
    } else {
        // A file without a head, as before 1993: it begins with group 8, and no element in it is faulty.
        if (mSize < 16 || mData[0] != 8 || mData[1] != 0 || mData[3] != 0) return;
        const char* kind = reinterpret_cast<const char*>(mData + 4);
        mExplicit = isShortKind(kind) || isLongKind(kind);
        mSyntax = mExplicit ? "1.2.840.10008.1.2.1" : kImplicit;
    }
    mIsDicom = true;
    if (!mDamage.empty()) return;
    try {
        Walk(*this).all();
    } catch (const Fault& fault) {
        mIsDicom = mHasHead;
        mDamage = fault.clause;
    }
}

}  // namespace stereonav
