// NIfTI-1 and NIfTI-2 headers, in either byte order, with the samples in the same file or in an .img beside
// it. Values and places are those that nibabel gives: the sform counts where its code is above 0, else the
// qform, else the grid is centred. What does not count may hold anything. Offsets: nifti1.h, nifti2.h.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>

#include "colon/study/study_header.h"
#include "colon/study/study_stream.h"
#include "colon/study/study_text.h"
#include "engine/base/regular_file.h"

namespace stereonav {
namespace {
namespace fs = std::filesystem;

constexpr std::size_t kFirstSize = 348, kSecondSize = 540;
constexpr double kMostMillimetres = 1e12;  // far beyond any body
constexpr double kMostSquare = 1.001;      // a rotation in 32-bit floats has no more than 1 + 4e-7

struct NiftiNumbers {
    bool turned = false, pair = false;
    int axes = 0, datatype = 0, qformCode = 0, sformCode = 0, units = 0;
    std::int64_t size[8] = {};
    double pixdim[4] = {}, offset = 0, slope = 0, intercept = 0;
    double quatern[3] = {}, qoffset[3] = {}, srow[3][4] = {};
    std::size_t pixdimAt = 0, quaternAt = 0, slopeAt = 0;
    int numberBytes = 4;
    std::string description;
};

template <typename T>
T niftiNumber(const std::string& head, std::size_t at, bool turned) {
    char bytes[sizeof(T)];
    std::memcpy(bytes, head.data() + at, sizeof(T));
    if (turned) std::reverse(bytes, bytes + sizeof(T));
    T number;
    std::memcpy(&number, bytes, sizeof(T));
    return number;
}

bool hasMagic(const std::string& head, std::size_t at, const char* magic, std::size_t bytes) {
    return head.size() >= at + bytes && std::memcmp(head.data() + at, magic, bytes) == 0;
}

// 1 or 2, or 0 where it is neither.
int versionOf(const std::string& head, bool turned) {
    if (head.size() < kFirstSize) return 0;
    const auto size = niftiNumber<std::int32_t>(head, 0, turned);
    if (size == kFirstSize && (hasMagic(head, 344, "n+1", 4) || hasMagic(head, 344, "ni1", 4))) {
        const auto axes = niftiNumber<std::int16_t>(head, 40, turned);
        return axes >= 1 && axes <= 7 ? 1 : 0;
    }
    if (size == kSecondSize && head.size() >= kSecondSize &&
        (hasMagic(head, 4, "n+2", 4) || hasMagic(head, 4, "ni2", 4))) {
        const auto axes = niftiNumber<std::int64_t>(head, 16, turned);
        return axes >= 1 && axes <= 7 ? 2 : 0;
    }
    return 0;
}

// Places of the numbers that both versions have, and their types.
struct FirstVersion {
    using Size = std::int16_t;
    using Number = float;
    using Offset = float;
    using Code = std::int16_t;
    static constexpr std::size_t kDim = 40, kDatatype = 70, kPixdim = 76, kOffset = 108, kSlope = 112,
                                 kDescription = 148, kCodes = 252, kQuatern = 256, kRows = 280;
};
struct SecondVersion {
    using Size = std::int64_t;
    using Number = double;
    using Offset = std::int64_t;
    using Code = std::int32_t;
    static constexpr std::size_t kDim = 16, kDatatype = 12, kPixdim = 104, kOffset = 168, kSlope = 176,
                                 kDescription = 240, kCodes = 344, kQuatern = 352, kRows = 400;
};

template <typename V>
NiftiNumbers numbersOf(const std::string& head, bool turned) {
    using Number = typename V::Number;
    NiftiNumbers n;
    n.turned = turned;
    const auto number = [&](std::size_t at, std::size_t index) {
        return static_cast<double>(niftiNumber<Number>(head, at + index * sizeof(Number), turned));
    };
    for (std::size_t axis = 0; axis < 8; ++axis)
        n.size[axis] = niftiNumber<typename V::Size>(head, V::kDim + axis * sizeof(typename V::Size), turned);
    n.axes = static_cast<int>(n.size[0]);
    n.datatype = niftiNumber<std::int16_t>(head, V::kDatatype, turned);
    for (std::size_t axis = 0; axis < 4; ++axis) n.pixdim[axis] = number(V::kPixdim, axis);
    n.offset = static_cast<double>(niftiNumber<typename V::Offset>(head, V::kOffset, turned));
    n.slope = number(V::kSlope, 0);
    n.intercept = number(V::kSlope, 1);
    n.qformCode = niftiNumber<typename V::Code>(head, V::kCodes, turned);
    n.sformCode = niftiNumber<typename V::Code>(head, V::kCodes + sizeof(typename V::Code), turned);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        n.quatern[axis] = number(V::kQuatern, axis);
        n.qoffset[axis] = number(V::kQuatern, 3 + axis);
        for (std::size_t c = 0; c < 4; ++c) n.srow[axis][c] = number(V::kRows, 4 * axis + c);
    }
    n.pixdimAt = V::kPixdim;
    n.quaternAt = V::kQuatern;
    n.slopeAt = V::kSlope;
    n.numberBytes = sizeof(Number);
    const std::string text = head.substr(V::kDescription, 80);
    n.description = trimmedText(text.substr(0, text.find('\0')));
    for (char& c : n.description)
        if (static_cast<unsigned char>(c) < ' ') c = ' ';
    return n;
}

NiftiNumbers numbersOf(const fs::path& file, const std::string& head) {
    for (const bool turned : {false, true}) {
        const int version = versionOf(head, turned);
        if (version == 1) {
            NiftiNumbers n = numbersOf<FirstVersion>(head, turned);
            n.units = static_cast<unsigned char>(head[123]);
            n.pair = head[345] == 'i';
            return n;
        }
        if (version == 2) {
            NiftiNumbers n = numbersOf<SecondVersion>(head, turned);
            n.units = niftiNumber<std::int32_t>(head, 500, turned);
            n.pair = head[5] == 'i';
            return n;
        }
    }
    throw Error(file.string(), "", "expected a NIfTI file, found no header of one",
                "give a volume file (.nrrd, .nhdr, .nii, .nii.gz, .hdr, .mha, .mhd) or a folder of DICOM");
}

bool isLength(double number) {
    return std::abs(number) < kMostMillimetres;
}

// Returns whether values are scaled at all, as nibabel has it.
bool isScaled(const NiftiNumbers& n) {
    return std::isfinite(n.slope) && n.slope != 0;
}

double squareOf(const double (&quatern)[3]) {
    return quatern[0] * quatern[0] + quatern[1] * quatern[1] + quatern[2] * quatern[2];
}

bool isUsableQform(const NiftiNumbers& n) {
    bool usable = squareOf(n.quatern) <= kMostSquare;
    for (int axis = 0; axis < 3; ++axis) usable &= isLength(n.pixdim[axis + 1]) && isLength(n.qoffset[axis]);
    return usable;
}

// Throws Error over numbers that count.
void checkNumbers(const fs::path& file, const NiftiNumbers& n) {
    for (int axis = 1; axis <= std::min(n.axes, 3); ++axis)
        if (n.size[axis] < 1)
            throw Error(file.string(), "",
                        fmt::format("expected a size above 0 along axis {}, found {}", axis, n.size[axis]),
                        "correct it in the header");
    const auto check = [&](std::size_t start, std::size_t index, double number, const char* what) {
        if (!isLength(number))
            throw Error(file.string(), fmt::format("byte {}", start + index * n.numberBytes),
                        fmt::format("expected a number of millimetres for {}, found {:g}", what, number),
                        "correct it in the header");
    };
    constexpr const char* kPlace = "the directions and the origin";
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (n.sformCode > 0) {
            for (std::size_t c = 0; c < 4; ++c) check(n.quaternAt, 6 + 4 * axis + c, n.srow[axis][c], kPlace);
            continue;
        }
        check(n.pixdimAt, axis + 1, n.pixdim[axis + 1], "the spacing");
        if (n.qformCode <= 0) continue;
        check(n.quaternAt, axis, n.quatern[axis], kPlace);
        check(n.quaternAt, 3 + axis, n.qoffset[axis], kPlace);
    }
    if (isScaled(n) && !std::isfinite(n.intercept))
        throw Error(
            file.string(), fmt::format("byte {}", n.slopeAt + n.numberBytes),
            fmt::format("expected a finite number for scl_inter beside a scl_slope of {:g}, found {:g}",
                        n.slope, n.intercept),
            "correct it in the header: a scl_slope of 0 for values as they are stored");
}

SampleType niftiType(const fs::path& file, int datatype) {
    switch (datatype) {
        case 2:
            return SampleType::UInt8;
        case 4:
            return SampleType::Int16;
        case 8:
            return SampleType::Int32;
        case 16:
            return SampleType::Float32;
        case 64:
            return SampleType::Float64;
        case 256:
            return SampleType::Int8;
        case 512:
            return SampleType::UInt16;
        case 768:
            return SampleType::UInt32;
        case 1024:
            return SampleType::Int64;
        case 1280:
            return SampleType::UInt64;
        default:
            break;
    }
    static constexpr struct {
        int code;
        const char* name;
    } kOthers[] = {{1, "single bits"},       {32, "complex numbers"},   {128, "colours"},
                   {1536, "128-bit floats"}, {1792, "complex numbers"}, {2048, "complex numbers"},
                   {2304, "colours"}};
    std::string name = "a type that is not known";
    for (const auto& other : kOthers)
        if (other.code == datatype) name = other.name;
    throw Error(file.string(), "",
                fmt::format("expected one real number of 8 to 64 bits a voxel, found {} (datatype {})", name,
                            datatype),
                "save it with 16-bit integers");
}

struct Affine {
    glm::dmat3 steps{1.0};
    glm::dvec3 origin{0.0};
};

Affine sformOf(const NiftiNumbers& n) {
    Affine a;
    for (int row = 0; row < 3; ++row) {
        for (int axis = 0; axis < 3; ++axis) a.steps[axis][row] = n.srow[row][axis];
        a.origin[row] = n.srow[row][3];
    }
    return a;
}

// Spacings of the qform: those below 0 count as above it, as other readers have it.
double qformSpacing(const NiftiNumbers& n, int axis) {
    return std::abs(n.pixdim[axis + 1]);
}

Affine qformOf(const fs::path& file, const NiftiNumbers& n) {
    double b = n.quatern[0], c = n.quatern[1], d = n.quatern[2];
    const double square = squareOf(n.quatern);
    if (square > kMostSquare)
        throw Error(file.string(), fmt::format("byte {}", n.quaternAt),
                    fmt::format("expected a rotation in the qform, found a quaternion of length {:g}",
                                std::sqrt(square)),
                    "correct it in the header");
    double a = 0;
    if (square > 1) {
        const double length = std::sqrt(square);
        b /= length, c /= length, d /= length;
    } else {
        a = std::sqrt(1 - square);
    }
    const glm::dmat3 turn({a * a + b * b - c * c - d * d, 2 * (b * c + a * d), 2 * (b * d - a * c)},
                          {2 * (b * c - a * d), a * a + c * c - b * b - d * d, 2 * (c * d + a * b)},
                          {2 * (b * d + a * c), 2 * (c * d - a * b), a * a + d * d - b * b - c * c});
    Affine affine;
    for (int axis = 0; axis < 3; ++axis) affine.steps[axis] = turn[axis] * qformSpacing(n, axis);
    if (n.pixdim[0] < 0) affine.steps[2] = -affine.steps[2];
    affine.origin = {n.qoffset[0], n.qoffset[1], n.qoffset[2]};
    return affine;
}

// nibabel's: i towards the patient's left, j to the front, k upwards, the grid's middle at the origin.
Affine centred(const NiftiNumbers& n) {
    Affine affine;
    for (int axis = 0; axis < 3; ++axis) {
        const double sign = axis == 0 ? -1 : 1;
        affine.steps[axis] = glm::dvec3(0.0);
        affine.steps[axis][axis] = sign * qformSpacing(n, axis);
        affine.origin[axis] = -0.5 * static_cast<double>(n.size[axis + 1] - 1) * affine.steps[axis][axis];
    }
    return affine;
}

// Returns how far a corner of the grid moves at most between two placements, as a share of the shortest step.
double differenceOf(const Affine& a, const Affine& b, const NiftiNumbers& n, double& millimetres) {
    millimetres = 0;
    for (int corner = 0; corner < 8; ++corner) {
        glm::dvec3 voxel(0.0);
        for (int axis = 0; axis < 3; ++axis)
            if (corner >> axis & 1) voxel[axis] = static_cast<double>(n.size[axis + 1] - 1);
        const glm::dvec3 apart = a.steps * voxel + a.origin - (b.steps * voxel + b.origin);
        millimetres = std::max(millimetres, glm::length(apart));
    }
    double shortest = glm::length(a.steps[0]);
    for (int axis = 1; axis < 3; ++axis) shortest = std::min(shortest, glm::length(a.steps[axis]));
    return shortest > 0 ? millimetres / shortest : 0;
}

Affine affineOf(const fs::path& file, const NiftiNumbers& n, std::vector<std::string>& notes) {
    constexpr double kAlike = 0.1;  // share of a voxel
    if (n.sformCode > 0) {
        const Affine sform = sformOf(n);
        double millimetres = 0;
        if (n.qformCode > 0 && !isUsableQform(n))
            notes.push_back("its qform is no rotation of a grid and is left aside: the sform counts");
        else if (n.qformCode > 0 && differenceOf(sform, qformOf(file, n), n, millimetres) > kAlike)
            notes.push_back(
                fmt::format("its sform and qform differ by up to {:.3g} mm: the sform counts", millimetres));
        return sform;
    }
    if (n.qformCode > 0) {
        if (!std::isfinite(n.pixdim[0]))
            notes.push_back("its qfac (pixdim[0]) is no number: 1 is taken, a grid that is not mirrored");
        return qformOf(file, n);
    }
    notes.push_back(
        "the header has neither sform nor qform: i is taken for the patient's left, j for front, k for up, "
        "which may be a mirror image");
    return centred(n);
}

void takeNiftiPlaces(const fs::path& file, const NiftiNumbers& n, VolumeHeader& header) {
    const Affine affine = affineOf(file, n, header.notes);
    header.directed = n.sformCode > 0 || n.qformCode > 0;
    constexpr int kMetre = 1, kMicron = 3, kSpaceUnits = 7;
    const int unit = n.units & kSpaceUnits;
    const double scale = unit == kMetre ? 1e3 : unit == kMicron ? 1e-3 : 1;
    if (scale != 1)
        header.notes.push_back(
            fmt::format("lengths of the header are in {}", unit == kMetre ? "metres" : "micrometres"));
    const glm::dvec3 toLps(-scale, -scale, scale);
    for (int axis = 0; axis < 3; ++axis) header.steps[axis] = affine.steps[axis] * toLps;
    header.origin = affine.origin * toLps;
}

bool isGzip(const fs::path& file) {
    std::error_code code;
    return fs::is_regular_file(file, code) && firstBytes(file, 2) == "\x1f\x8b";
}

// The first bytes of a file, inflated where it is compressed; "" where it is none.
std::string plainBeginning(const fs::path& file, std::size_t bytes) {
    std::error_code code;
    if (!fs::is_regular_file(file, code)) return "";
    std::string text(bytes, '\0');
    const auto encoding = isGzip(file) ? SampleEncoding::Deflate : SampleEncoding::Raw;
    text.resize(openStream(file, 0, encoding)->read(reinterpret_cast<unsigned char*>(text.data()), bytes));
    return text;
}

// The other file of a pair: "a.img" and "a.hdr", each also with ".gz"; itself where it is neither.
fs::path otherOfPair(const fs::path& file, const char* wanted) {
    fs::path bare = file;
    const bool packed = loweredText(bare.extension().string()) == ".gz";
    if (packed) bare.replace_extension();
    const std::string extension = loweredText(bare.extension().string());
    if (extension != ".img" && extension != ".hdr" && extension != ".nii") return file;
    if (extension == wanted) return file;
    const bool capitals = bare.extension().string()[1] < 'a';
    std::string end = wanted;
    if (capitals)
        for (char& c : end) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    bare.replace_extension(end);
    fs::path withEnd = bare;
    withEnd += ".gz";
    std::error_code code;
    const bool first =
        packed ? fs::exists(withEnd, code) : !fs::exists(bare, code) && fs::exists(withEnd, code);
    return first ? withEnd : bare;
}

}  // namespace

bool isNiftiPair(const fs::path& file) {
    const std::string name = loweredText(file.filename().string());
    const auto ends = [&](const char* end) { return name.ends_with(end); };
    if (!ends(".img") && !ends(".img.gz") && !ends(".hdr") && !ends(".hdr.gz")) return false;
    std::string head;
    try {
        head = plainBeginning(otherOfPair(file, ".hdr"), kSecondSize);
    } catch (const Error&) {
        return false;  // packed, and damaged
    }
    return versionOf(head, false) != 0 || versionOf(head, true) != 0;
}

VolumeHeader readNiftiHeader(const fs::path& file) {
    const std::string name = loweredText(file.filename().string());
    const bool isImage = name.ends_with(".img") || name.ends_with(".img.gz");
    const fs::path headerFile = isImage ? otherOfPair(file, ".hdr") : file;
    firstBytes(headerFile, 1);  // that it is there
    const NiftiNumbers n = numbersOf(headerFile, plainBeginning(headerFile, kSecondSize));
    checkNumbers(headerFile, n);
    VolumeHeader header;
    header.format = "NIfTI";
    header.description = n.description;
    header.headers = {headerFile};
    std::vector<std::uint64_t> size;
    for (int axis = 1; axis <= n.axes; ++axis)
        size.push_back(static_cast<std::uint64_t>(std::max<std::int64_t>(n.size[axis], 1)));
    header.size = threeSizes(file, size);
    header.type = niftiType(headerFile, n.datatype);
    takeNiftiPlaces(headerFile, n, header);
    if (isScaled(n)) header.slope = n.slope, header.intercept = n.intercept;
    if (!std::isfinite(n.slope))
        header.notes.push_back(
            fmt::format("its scl_slope is {:g}: values are taken as they are stored", n.slope));
    SamplePlace& place = header.place;
    place.files = {n.pair ? otherOfPair(headerFile, ".img") : headerFile};
    if (isGzip(place.files[0])) place.encoding = SampleEncoding::Deflate;
    place.turned = n.turned;
    const bool second = n.numberBytes == 8;
    const double least = n.pair ? 0 : second ? 544 : 352;
    const double offset = n.offset == 0 ? least : n.offset;
    if (!(offset >= (n.pair ? 0 : second ? 540 : 348) && offset < 1e15))
        throw Error(
            headerFile.string(), fmt::format("byte {}", second ? 168 : 108),
            fmt::format("expected samples from byte {} on or later, found byte {:g}", least, n.offset),
            "correct it in the header");
    place.skip = static_cast<std::uint64_t>(offset);
    return header;
}

}  // namespace stereonav
