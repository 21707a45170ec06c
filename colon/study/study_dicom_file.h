// A DICOM file taken apart: every element's length is held against the file's before any of it counts
// (PS3.5 7, PS3.10 7). Shared among colon/study/*.cpp only.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "colon/study/study_mapped.h"

namespace stereonav {

struct DicomItem;
struct DicomValue {
    std::string bytes;             // the bytes as they stand in the file
    std::vector<DicomItem> items;  // items of a sequence
};
// The elements that a study is read from, by group * 65536 + element; others are walked over.
struct DicomItem {
    std::map<std::uint32_t, DicomValue> values;

    const DicomValue* find(std::uint32_t tag) const {
        const auto at = values.find(tag);
        return at == values.end() ? nullptr : &at->second;
    }
    // Returns a text without blanks around it; "" where there is none.
    std::string text(std::uint32_t tag) const;
    // Returns "1.5\2.5" as numbers: as many as can be read, at most `count`.
    std::vector<double> numbers(std::uint32_t tag, std::size_t count) const;
};

class DicomFile {
public:
    // Where the pixels lie.
    struct Pixels {
        bool found = false, encapsulated = false;
        bool words = false;               // stands in words of 16 bits (OW), which big-endian files turn over
        std::uint64_t at = 0, bytes = 0;  // in data()
        std::uint64_t said = 0;           // bytes, by their length in the file; 0 where they are encapsulated
        std::vector<std::pair<std::uint64_t, std::uint64_t>>
            fragments;  // place and bytes; the first: offsets
    };

    // Takes a file apart. Throws Error where the file can not be opened, or is DICOM with a head that is
    // damaged.
    explicit DicomFile(const std::filesystem::path& file);

    bool isDicom() const { return mIsDicom; }
    bool isDirectory() const;  // a DICOMDIR, under any name
    const DicomItem& set() const { return mSet; }
    const Pixels& pixels() const { return mPixels; }
    const std::string& syntax() const { return mSyntax; }          // the transfer syntax, a UID
    const std::string& mediaClass() const { return mMediaClass; }  // the head's SOP class, a UID
    bool bigEndian() const { return mBig; }
    // Returns the bytes that elements lie in: the file, or what it unpacks to.
    const unsigned char* data() const { return mData; }
    // Returns a 16-bit number; `otherwise` where there is none.
    int word(std::uint32_t tag, int otherwise) const;
    // Returns a clause about what is wrong, that fits behind the file's name: "is cut off: ..."; "" where all
    // is well.
    const std::string& damage() const { return mDamage; }

private:
    class Walk;
    void readHead(const std::filesystem::path& file);
    double pixelBytes() const;
    std::string tooManyPixels(std::uint64_t said) const;
    std::optional<std::uint64_t> wantedOf();
    void unpack(const std::filesystem::path& file);

    MappedFile mFile;
    std::vector<unsigned char> mUnpacked;  // unpacked data set of the deflated syntax
    const unsigned char* mData = nullptr;
    std::uint64_t mSize = 0, mStart = 0;  // bytes of mData, and where the data set begins in it
    bool mIsDicom = false, mBig = false, mExplicit = true, mHasHead = false;
    std::string mSyntax, mMediaClass, mDamage;
    DicomItem mSet;
    Pixels mPixels;
};

}  // namespace stereonav
