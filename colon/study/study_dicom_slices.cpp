// What a DICOM file says of its slices: one, or the frames of an enhanced image, whose places lie in
// sequences of functional groups (PS3.3 C.7.6.16).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "colon/study/study_dicom_file.h"
#include "colon/study/study_parts.h"

namespace stereonav {
namespace {
namespace fs = std::filesystem;

constexpr std::uint32_t kImageType = 0x00080008, kSopClass = 0x00080016, kModality = 0x00080060,
                        kSeriesDescription = 0x0008103e, kKernel = 0x00181210, kSeriesUid = 0x0020000e,
                        kPosition = 0x00200032, kOrientation = 0x00200037, kPlanePosition = 0x00209113,
                        kPlaneOrientation = 0x00209116, kSamplesOfPixel = 0x00280002, kFrames = 0x00280008,
                        kRows = 0x00280010, kColumns = 0x00280011, kPixelSpacing = 0x00280030,
                        kBitsAllocated = 0x00280100, kSigned = 0x00280103, kPadding = 0x00280120,
                        kPaddingLimit = 0x00280121, kIntercept = 0x00281052, kSlope = 0x00281053,
                        kModalityLut = 0x00283000, kTableHead = 0x00283002, kTableData = 0x00283006,
                        kSpacingBetween = 0x00180088, kFrameOffsets = 0x3004000c, kDoseScaling = 0x3004000e,
                        kMeasures = 0x00289110, kTransformation = 0x00289145, kShared = 0x52009229,
                        kPerFrame = 0x52009230;
constexpr const char* kSecondaryCapture = "1.2.840.10008.5.1.4.1.1.7";
constexpr int kMostFrames = 100000;

void takePosition(const DicomItem& item, DicomSlice& slice, bool& known) {
    const auto position = item.numbers(kPosition, 3);
    known = position.size() == 3;
    if (known) slice.position = {position[0], position[1], position[2]};
}

void takeOrientation(const DicomItem& item, DicomSlice& slice, bool& known) {
    const auto o = item.numbers(kOrientation, 6);
    known = false;
    if (o.size() != 6) return;
    const glm::dvec3 along(o[0], o[1], o[2]), down(o[3], o[4], o[5]);
    if (!(glm::length(along) > 0.5) || !(glm::length(down) > 0.5)) return;
    known = true;
    slice.along = glm::normalize(along);
    slice.down = glm::normalize(down);
}

void takeSpacing(const DicomItem& item, DicomSlice& slice) {
    const auto spacing = item.numbers(kPixelSpacing, 2);  // between rows, then between columns
    slice.hasSpacing = spacing.size() == 2;
    if (slice.hasSpacing) slice.spacing = {spacing[1], spacing[0]};
}

void takeRescale(const DicomItem& item, DicomSlice& slice) {
    if (const auto slope = item.numbers(kSlope, 1); !slope.empty())
        slice.slope = slope[0];
    else if (const auto dose = item.numbers(kDoseScaling, 1); !dose.empty())
        slice.slope = dose[0];
    if (const auto start = item.numbers(kIntercept, 1); !start.empty()) slice.intercept = start[0];
}

void takePadding(const DicomFile& file, DicomSlice& slice) {
    const bool isSigned = file.word(kSigned, 0) == 1;
    const auto number = [&](std::uint32_t tag, std::int64_t otherwise) -> std::int64_t {
        if (!file.set().find(tag)) return otherwise;
        const int word = file.word(tag, 0);
        return isSigned ? static_cast<std::int16_t>(word) : word;
    };
    slice.hasPadding = file.set().find(kPadding) != nullptr;
    slice.padding = number(kPadding, 0);
    slice.paddingLimit = number(kPaddingLimit, slice.padding);
    if (slice.paddingLimit < slice.padding) std::swap(slice.padding, slice.paddingLimit);
}

std::string asideOf(const DicomSlice& slice, const DicomItem& set) {
    const std::string type = set.text(kImageType), sop = set.text(kSopClass);
    if (type.find("LOCALIZER") != std::string::npos) return "localizer";
    if (sop == kSecondaryCapture || sop.starts_with(std::string(kSecondaryCapture) + "."))
        return "secondary capture";
    if (slice.samples != 1) return "picture in colour";
    return "";
}

// Returns true for the storage of pictures (PS3.4 B.5), not for reports, plans, waveforms and the like.
bool isImageClass(const std::string& uid) {
    static const std::string kStorage = "1.2.840.10008.5.1.4.1.1.";
    if (!uid.starts_with(kStorage) || uid == kStorage + "4.2") return false;  // 4.2: spectra
    const std::string kind = uid.substr(kStorage.size());
    const std::string first = kind.substr(0, kind.find('.'));
    for (const char* known : {"1", "2", "3", "4", "6", "7", "12", "20", "128", "130"})
        if (first == known) return true;
    return false;
}

// The item of a group, of this frame or shared by all; an empty one where there is none.
const DicomItem& groupOf(const DicomItem& frame, const DicomItem& shared, std::uint32_t group) {
    static const DicomItem kNone;
    for (const DicomItem* from : {&frame, &shared})
        if (const DicomValue* value = from->find(group); value && !value->items.empty())
            return value->items[0];
    return kNone;
}

void addFrames(const DicomFile& file, const DicomSlice& all, std::vector<DicomSlice>& slices) {
    static const DicomItem kNone;
    const DicomValue* perFrame = file.set().find(kPerFrame);
    const DicomValue* groups = file.set().find(kShared);
    const DicomItem& shared = groups && !groups->items.empty() ? groups->items[0] : kNone;
    for (int n = 0; n < all.frames; ++n) {
        DicomSlice slice = all;
        slice.frame = n;
        slice.name = fmt::format("{} frame {}", all.name, n + 1);
        const DicomItem& own = perFrame->items[static_cast<std::size_t>(n)];
        bool position = false, orientation = false;
        takePosition(groupOf(own, shared, kPlanePosition), slice, position);
        takeOrientation(groupOf(own, shared, kPlaneOrientation), slice, orientation);
        slice.hasPlace = position && orientation;
        takeSpacing(groupOf(own, shared, kMeasures), slice);
        takeRescale(groupOf(own, shared, kTransformation), slice);
        slices.push_back(std::move(slice));
    }
}

std::string damageOf(const DicomFile& file, const DicomSlice& slice) {
    const DicomFile::Pixels& pixels = file.pixels();
    if (!pixels.found) return "is cut off or damaged: it has no pixels";
    const std::uint64_t each = static_cast<std::uint64_t>((file.word(kBitsAllocated, 16) + 7) / 8);
    const std::uint64_t expected = each * static_cast<std::uint64_t>(slice.columns) * slice.rows *
                                   slice.frames * static_cast<std::uint64_t>(slice.samples);
    if (!pixels.encapsulated && pixels.bytes < expected)
        return fmt::format("is cut off: {} bytes of its pixels are missing", expected - pixels.bytes);
    if (pixels.encapsulated && pixels.fragments.size() < 2) return "is cut off or damaged: it has no pixels";
    return "";
}

// Values by a table (PS3.3 C.11.1): its head says how many, the first number that it is for, and bits of
// each. Returns what is wrong, "" where nothing is.
std::string takeTable(const DicomFile& file, DicomSlice& slice) {
    const DicomValue* sequence = file.set().find(kModalityLut);
    if (!sequence || sequence->items.empty()) return "";
    if (file.set().find(kSlope))
        return "has both a table of values (modality LUT) and a rescale slope: which counts is not known";
    const DicomValue *head = sequence->items[0].find(kTableHead), *data = sequence->items[0].find(kTableData);
    if (!head || !data || head->bytes.size() < 6)
        return "is damaged: its table of values has no header or no data";
    const auto word = [&](const std::string& bytes, std::size_t n) {
        const int a = static_cast<unsigned char>(bytes[2 * n]),
                  b = static_cast<unsigned char>(bytes[2 * n + 1]);
        return static_cast<std::uint16_t>(file.bigEndian() ? a << 8 | b : a | b << 8);
    };
    const std::size_t count = word(head->bytes, 0) == 0 ? 65536 : word(head->bytes, 0);
    const int bits = word(head->bytes, 2);
    const bool isSigned = file.word(kSigned, 0) == 1;
    slice.tableFirst = isSigned ? static_cast<std::int16_t>(word(head->bytes, 1)) : word(head->bytes, 1);
    const bool bytesEach = bits == 8 && data->bytes.size() == (count + 1) / 2 * 2;
    if (!bytesEach && (bits < 8 || bits > 16 || data->bytes.size() != 2 * count))
        return fmt::format("is damaged: its table of {} values of {} bits has {} bytes", count, bits,
                           data->bytes.size());
    std::vector<std::uint16_t> values(count);
    for (std::size_t n = 0; n < count; ++n)
        values[n] = bytesEach ? static_cast<unsigned char>(data->bytes[n]) : word(data->bytes, n);
    slice.table = std::make_shared<const std::vector<std::uint16_t>>(std::move(values));
    return "";
}

// Frames without functional groups: along the normal by offsets of their own (PS3.3 C.8.8.3.2), or by one
// distance between them. Returns nothing where the file says neither.
std::vector<DicomSlice> steppedFrames(const DicomItem& set, const DicomSlice& all) {
    const auto count = static_cast<std::size_t>(all.frames);
    std::vector<double> offsets = set.numbers(kFrameOffsets, count);
    std::string by = "their offsets (3004,000c)";
    if (offsets.size() != count) {
        const auto step = set.numbers(kSpacingBetween, 1);
        if (step.empty() || !(step[0] > 0)) return {};
        by = fmt::format("a distance of {:g} mm (0018,0088): the file has no places of each", step[0]);
        offsets.clear();
        for (std::size_t n = 0; n < count; ++n) offsets.push_back(step[0] * static_cast<double>(n));
    }
    std::vector<DicomSlice> slices;
    const glm::dvec3 normal = glm::cross(all.along, all.down);
    for (std::size_t n = 0; n < count; ++n) {
        DicomSlice slice = all;
        slice.frame = static_cast<int>(n);
        slice.name = fmt::format("{} frame {}", all.name, n + 1);
        slice.position += (offsets[n] - offsets[0]) * normal;
        slice.placedBy = by;
        slice.hasPlace = true;
        slices.push_back(std::move(slice));
    }
    return slices;
}

}  // namespace

std::vector<DicomSlice> readSlices(const fs::path& path, bool& isDicom) {
    const DicomFile file(path);
    isDicom = file.isDicom() || file.isDirectory();
    if (!file.isDicom() || file.isDirectory()) return {};
    const DicomItem& set = file.set();
    DicomSlice slice;
    slice.file = path;
    slice.name = path.filename().string();
    slice.uid = set.text(kSeriesUid);
    slice.description = set.text(kSeriesDescription);
    slice.modality = set.text(kModality);
    slice.kernel = set.text(kKernel);
    slice.kernel = slice.kernel.substr(0, slice.kernel.find('\\'));  // the first of several
    slice.rows = file.word(kRows, 0);
    slice.columns = file.word(kColumns, 0);
    slice.samples = file.word(kSamplesOfPixel, 1);
    const auto frames = set.numbers(kFrames, 1);
    if (!frames.empty()) slice.frames = static_cast<int>(std::clamp(frames[0], 1.0, 1.0 * kMostFrames));
    slice.damage = file.damage();
    if (slice.damage.empty() && (slice.rows <= 0 || slice.columns <= 0)) {
        if (!isImageClass(file.mediaClass()) && !isImageClass(set.text(kSopClass))) return {};
        slice.damage = "is cut off or damaged: it has no picture";
    }
    if (slice.damage.empty()) slice.damage = damageOf(file, slice);
    if (slice.damage.empty()) slice.damage = takeTable(file, slice);
    if (!slice.damage.empty() && slice.uid.empty())  // no series is known to leave out
        throw Error(path.string(), "", slice.damage, "copy the file again, or take it out of the folder");
    slice.aside = asideOf(slice, set);
    takePadding(file, slice);
    takeRescale(set, slice);
    const DicomValue* perFrame = set.find(kPerFrame);
    if (perFrame && slice.damage.empty() && perFrame->items.size() != static_cast<std::size_t>(slice.frames))
        slice.damage = fmt::format("is damaged: it has {} frames and places of {}", slice.frames,
                                   perFrame->items.size());
    if (perFrame && perFrame->items.size() == static_cast<std::size_t>(slice.frames)) {
        std::vector<DicomSlice> slices;
        addFrames(file, slice, slices);
        return slices;
    }
    bool position = false, orientation = false;
    takePosition(set, slice, position);
    takeOrientation(set, slice, orientation);
    takeSpacing(set, slice);
    slice.hasPlace = position && orientation && slice.frames == 1;
    if (position && orientation && slice.frames > 1 && slice.damage.empty())
        if (std::vector<DicomSlice> slices = steppedFrames(set, slice); !slices.empty()) return slices;
    return {slice};
}

}  // namespace stereonav
