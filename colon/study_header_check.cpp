// What is looked at in a header before a library reads it. The libraries behind ITK and GDCM print complaints
// of their own, go on for ever or end the program over some of what damaged files hold (found by damaging
// files at random); here it becomes one line that names the place.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>

#include "colon/study_parts.h"

namespace stereonav {
namespace {
namespace fs = std::filesystem;

constexpr int kMostAxes = 10;                           // that MetaImage knows
constexpr std::uint32_t kLongestMetaElement = 1 << 20;  // of a DICOM file's group 2: names and versions

// As many numbers as the text begins with.
std::vector<double> numbersIn(const std::string& text) {
    std::vector<double> numbers;
    const char* at = text.c_str();
    for (char* end = nullptr;; at = end) {
        const double number = std::strtod(at, &end);
        if (end == at) return numbers;
        numbers.push_back(number);
    }
}

// A number of a NIfTI header, whose bytes may stand the other way around.
template <typename T>
T niftiNumber(const std::string& head, std::size_t at, bool turned) {
    char bytes[sizeof(T)];
    std::memcpy(bytes, head.data() + at, sizeof(T));
    if (turned) std::reverse(bytes, bytes + sizeof(T));
    T number;
    std::memcpy(&number, bytes, sizeof(T));
    return number;
}

// The library behind ITK prints its complaints about sizes and, where a spacing, a direction or an origin
// is no number that it can invert, ends the program. Offsets: nifti1.h.
void checkNiftiNumbers(const fs::path& file, const std::string& head, bool turned) {
    const auto axes = niftiNumber<std::int16_t>(head, 40, turned);
    for (int axis = 1; axis <= std::min<int>(axes, 3); ++axis) {
        const auto size = niftiNumber<std::int16_t>(head, 40 + 2 * axis, turned);
        if (size < 1)
            throw Error(file.string(), "",
                        fmt::format("expected a size above 0 along axis {}, found {}", axis, size),
                        "correct it in the header");
    }
    constexpr std::size_t kPixdim = 76, kQuatern = 256, kRowsEnd = 328;
    constexpr float kMostMillimetres = 1e12f;  // far beyond any body, and its square is a float
    const auto check = [&](std::size_t at, const char* what) {
        const auto number = niftiNumber<float>(head, at, turned);
        if (!(std::abs(number) < kMostMillimetres))
            throw Error(file.string(), fmt::format("byte {}", at),
                        fmt::format("expected a number of millimetres for {}, found {}", what, number),
                        "correct it in the header");
    };
    for (std::size_t at = kPixdim; at < kPixdim + 16; at += 4) check(at, "the spacing");
    for (std::size_t at = kQuatern; at < kRowsEnd; at += 4) check(at, "the directions and the origin");
}

}  // namespace

// The size of the header (348, or 540 for version 2) and the number of axes, in either byte order.
void checkNiftiHeader(const fs::path& file, const std::string& head) {
    bool good = head.size() >= 348;
    if (good) {
        const auto axesOf = [&](bool turned) { return niftiNumber<std::int16_t>(head, 40, turned); };
        const auto sizeOf = [&](bool turned) { return niftiNumber<std::int32_t>(head, 0, turned); };
        for (const bool turned : {false, true})
            if (sizeOf(turned) == 348 && axesOf(turned) >= 1 && axesOf(turned) <= 7)
                return checkNiftiNumbers(file, head, turned);
        good = sizeOf(false) == 540 || sizeOf(true) == 540;
    }
    if (!good)
        throw Error(file.string(), "", "expected a NIfTI file, found no header of one",
                    "give a volume file (.nrrd, .nhdr, .nii, .nii.gz, .mha, .mhd) or a folder of DICOM");
}

void MetaHeaderCheck::take(const std::string& key, const std::string& value) {
    ++mLine;
    const auto wrong = [&](const std::string& problem) {
        throw Error(mFile.string(), std::to_string(mLine), problem, "correct it in the header");
    };
    if (key == "ndims") {
        const auto numbers = numbersIn(value);
        if (numbers.empty() || !(numbers[0] >= 1 && numbers[0] <= kMostAxes))
            wrong(fmt::format("expected 1 to {} axes in NDims, found {}", kMostAxes, value));
        mAxes = static_cast<int>(numbers[0]);
    }
    const bool size = key == "dimsize", spacing = key == "elementspacing" || key == "elementsize";
    const bool place = key == "offset" || key == "position" || key == "origin";
    const bool axes = key == "transformmatrix" || key == "rotation" || key == "orientation";
    mSized |= size;
    mTyped |= key == "elementtype";
    if (!size && !spacing && !place && !axes) return;
    if (mAxes == 0) wrong("expected NDims, the number of axes, above this line");
    const auto numbers = numbersIn(value);
    const std::size_t expected = axes ? static_cast<std::size_t>(mAxes) * static_cast<std::size_t>(mAxes)
                                      : static_cast<std::size_t>(mAxes);
    if (numbers.size() < expected)
        wrong(fmt::format("expected {} numbers, found {}", expected, numbers.size()));
    for (const double number : numbers)
        if (!std::isfinite(number) || (spacing && !(number > 0)) || (size && !(number >= 1)))
            wrong(spacing ? "expected a spacing of numbers above 0, found " + value
                          : fmt::format("expected {}, found {}", size ? "sizes above 0" : "numbers", value));
}

void MetaHeaderCheck::finish() const {
    const char* missing = mAxes == 0 ? "NDims" : !mSized ? "DimSize" : !mTyped ? "ElementType" : nullptr;
    if (missing)
        throw Error(mFile.string(), "", fmt::format("its header has no {}", missing),
                    "the header is damaged: get it again");
}

// Group 2 (PS3.10, 7.1): elements of a tag, two capitals that name their kind of value, and a length.
void checkDicomMeta(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::array<char, 132> preamble{};
    if (!in.read(preamble.data(), preamble.size()) || std::memcmp(preamble.data() + 128, "DICM", 4) != 0)
        return;
    const auto damaged = [&](std::streamoff at) {
        throw Error(file.string(), fmt::format("byte {}", at), "the DICOM header is damaged",
                    "copy the file again");
    };
    std::array<unsigned char, 8> head{};
    for (;;) {
        const std::streamoff at = in.tellg();
        if (!in.read(reinterpret_cast<char*>(head.data()), head.size())) damaged(at);
        if (head[0] != 2 || head[1] != 0) return;
        const char kind[3] = {static_cast<char>(head[4]), static_cast<char>(head[5]), '\0'};
        static constexpr const char* kShort[] = {"AE", "AS", "AT", "CS", "DA", "DS", "DT",
                                                 "FD", "FL", "IS", "LO", "LT", "PN", "SH",
                                                 "SL", "SS", "ST", "TM", "UI", "UL", "US"};
        static constexpr const char* kLong[] = {"OB", "OD", "OF", "OL", "OV", "OW", "SQ",
                                                "SV", "UC", "UN", "UR", "UT", "UV"};
        const auto named = [&](const char* name) { return std::strcmp(kind, name) == 0; };
        std::uint32_t length = head[6] | static_cast<std::uint32_t>(head[7]) << 8;
        if (std::any_of(std::begin(kLong), std::end(kLong), named)) {
            std::array<unsigned char, 4> bytes{};
            if (!in.read(reinterpret_cast<char*>(bytes.data()), bytes.size())) damaged(at);
            length = bytes[0] | bytes[1] << 8 | bytes[2] << 16 | static_cast<std::uint32_t>(bytes[3]) << 24;
        } else if (std::none_of(std::begin(kShort), std::end(kShort), named)) {
            damaged(at);
        }
        if (length > kLongestMetaElement || !in.ignore(length) || in.gcount() != length) damaged(at);
    }
}

}  // namespace stereonav
