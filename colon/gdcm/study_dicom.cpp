// A folder of DICOM files through GDCM: which series there are, how their slices lie, and their pixels in HU
// (stored number * slope + intercept, PS3.3 C.11.1), several slices at a time. Also reads JPEG 2000 and the
// other encodings that GDCM knows.
#include <fmt/format.h>
#include <gdcmGlobal.h>
#include <gdcmImageReader.h>
#include <gdcmReader.h>
#include <gdcmTrace.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <fstream>
#include <functional>
#include <glm/common.hpp>
#include <glm/trigonometric.hpp>
#include <map>
#include <mutex>

#include "colon/study_parts.h"
#include "engine/base/parallel.h"

namespace stereonav {
namespace {
namespace fs = std::filesystem;

constexpr int kLeastHu = -1024;  // of CT; lower numbers only mark what was not scanned

// GDCM reports to std::cerr otherwise, and builds its dictionaries at first use, on one thread only.
void prepareGdcm() {
    static std::once_flag once;
    std::call_once(once, [] {
        gdcm::Trace::DebugOff();
        gdcm::Trace::WarningOff();
        gdcm::Trace::ErrorOff();
        gdcm::Global::GetInstance().LoadResourcesFiles();
    });
}

std::string textOf(const gdcm::DataSet& set, std::uint16_t group, std::uint16_t element) {
    const gdcm::Tag tag(group, element);
    if (!set.FindDataElement(tag)) return "";
    const gdcm::ByteValue* bytes = set.GetDataElement(tag).GetByteValue();
    if (!bytes || !bytes->GetPointer()) return "";
    std::string text(bytes->GetPointer(), bytes->GetLength());
    while (!text.empty() && (text.back() == ' ' || text.back() == '\0')) text.pop_back();
    const auto first = text.find_first_not_of(' ');
    return first == std::string::npos ? "" : text.substr(first);
}

// "1.5\2.5" as numbers; fewer than `count` when there are no more that can be read.
std::vector<double> numbersOf(const gdcm::DataSet& set, std::uint16_t group, std::uint16_t element,
                              std::size_t count) {
    std::vector<double> numbers;
    const std::string text = textOf(set, group, element);
    const char* at = text.c_str();
    while (numbers.size() < count) {
        char* end = nullptr;
        const double number = std::strtod(at, &end);
        if (end == at || !std::isfinite(number)) break;
        numbers.push_back(number);
        while (*end == ' ' || *end == '\\') ++end;
        at = end;
    }
    return numbers;
}

// A 16-bit number, signed where asked.
std::optional<std::int64_t> wordOf(const gdcm::DataSet& set, std::uint16_t group, std::uint16_t element,
                                   bool isSigned) {
    const gdcm::Tag tag(group, element);
    if (!set.FindDataElement(tag)) return {};
    const gdcm::ByteValue* bytes = set.GetDataElement(tag).GetByteValue();
    if (!bytes || bytes->GetLength() < 2) return {};
    std::uint16_t word;
    std::memcpy(&word, bytes->GetPointer(), 2);  // GDCM has swapped it to this machine's order
    return isSigned ? static_cast<std::int16_t>(word) : static_cast<std::int64_t>(word);
}

void takeGeometry(const gdcm::DataSet& set, DicomSlice& slice) {
    const auto position = numbersOf(set, 0x0020, 0x0032, 3), orientation = numbersOf(set, 0x0020, 0x0037, 6);
    const auto spacing = numbersOf(set, 0x0028, 0x0030, 2);  // between rows, then between columns
    slice.hasSpacing = spacing.size() == 2;
    if (slice.hasSpacing) slice.spacing = {spacing[1], spacing[0]};
    if (position.size() != 3 || orientation.size() != 6) return;
    slice.position = {position[0], position[1], position[2]};
    const glm::dvec3 along(orientation[0], orientation[1], orientation[2]);
    const glm::dvec3 down(orientation[3], orientation[4], orientation[5]);
    if (!(glm::length(along) > 0.5) || !(glm::length(down) > 0.5)) return;
    slice.hasPlace = true;
    slice.along = glm::normalize(along);
    slice.down = glm::normalize(down);
}

void takeNumbers(const gdcm::DataSet& set, DicomSlice& slice) {
    const auto word = [&](std::uint16_t element) { return wordOf(set, 0x0028, element, false); };
    slice.rows = static_cast<int>(word(0x0010).value_or(0));
    slice.columns = static_cast<int>(word(0x0011).value_or(0));
    slice.samples = static_cast<int>(word(0x0002).value_or(1));
    if (const auto frames = numbersOf(set, 0x0028, 0x0008, 1); !frames.empty())
        slice.frames = static_cast<int>(std::clamp(frames[0], 0.0, 1e6));
    if (const auto slope = numbersOf(set, 0x0028, 0x1053, 1); !slope.empty()) slice.slope = slope[0];
    if (const auto start = numbersOf(set, 0x0028, 0x1052, 1); !start.empty()) slice.intercept = start[0];
    const bool isSigned = word(0x0103).value_or(0) == 1;
    const auto padding = wordOf(set, 0x0028, 0x0120, isSigned);
    slice.hasPadding = padding.has_value();
    slice.padding = padding.value_or(0);
    slice.paddingLimit = wordOf(set, 0x0028, 0x0121, isSigned).value_or(slice.padding);
    if (slice.paddingLimit < slice.padding) std::swap(slice.padding, slice.paddingLimit);
}

// Bytes of pixels that a file which stores them as they are lacks: GDCM would take zeros for them. Looks for
// the head of the pixels' element (PS3.5 7.1), of known length, in little-endian files.
std::uint64_t missingBytes(const gdcm::File& read, const DicomSlice& slice) {
    constexpr std::size_t kLongestHead = 4 << 20;
    const gdcm::TransferSyntax& syntax = read.GetHeader().GetDataSetTransferSyntax();
    const bool implicit = syntax == gdcm::TransferSyntax::ImplicitVRLittleEndian;
    if (!implicit && syntax != gdcm::TransferSyntax::ExplicitVRLittleEndian) return 0;
    const int bits = static_cast<int>(wordOf(read.GetDataSet(), 0x0028, 0x0100, false).value_or(16));
    const std::uint64_t pixels = static_cast<std::uint64_t>(slice.columns) * slice.rows * (bits / 8);
    const auto length = static_cast<std::uint32_t>(pixels + pixels % 2);
    std::string head("\xe0\x7f\x10\x00", 4);
    if (!implicit) head += std::string(bits > 8 ? "OW\0" : "OB\0", 4);
    head.append(reinterpret_cast<const char*>(&length), sizeof length);
    const std::uint64_t size = fs::file_size(slice.file);
    std::string text(std::min<std::uint64_t>(size, kLongestHead), '\0');
    std::ifstream(slice.file, std::ios::binary).read(text.data(), static_cast<std::streamsize>(text.size()));
    const std::size_t at = text.find(head);
    if (at == std::string::npos) return 0;
    const std::uint64_t end = at + head.size() + pixels;
    return end - std::min(end, size);
}

// What a file says before its pixels; nothing where it is not a DICOM image.
std::optional<DicomSlice> readSliceHeader(const fs::path& file) {
    checkDicomMeta(file);
    gdcm::Reader reader;
    reader.SetFileName(file.c_str());
    try {
        if (!reader.ReadUpToTag(gdcm::Tag(0x7fe0, 0x0010))) return {};
    } catch (const std::exception&) {
        return {};
    }
    const gdcm::DataSet& set = reader.GetFile().GetDataSet();
    DicomSlice slice;
    slice.file = file;
    slice.name = file.filename().string();
    slice.uid = textOf(set, 0x0020, 0x000e);
    slice.description = textOf(set, 0x0008, 0x103e);
    slice.modality = textOf(set, 0x0008, 0x0060);
    slice.kernel = textOf(set, 0x0018, 0x1210);
    slice.kernel = slice.kernel.substr(0, slice.kernel.find('\\'));  // the first of several
    takeGeometry(set, slice);
    takeNumbers(set, slice);
    if (slice.rows <= 0 || slice.columns <= 0) return {};
    slice.missingBytes = missingBytes(reader.GetFile(), slice);
    return slice;
}

std::vector<fs::path> filesIn(const fs::path& folder) {
    std::vector<fs::path> files;
    std::error_code code;
    for (const auto& entry : fs::directory_iterator(folder, code))
        if (entry.is_regular_file(code) && entry.path().filename() != "DICOMDIR")
            files.push_back(entry.path());
    if (code) throw Error(folder.string(), "", "can not be opened", "check the name and its permissions");
    std::sort(files.begin(), files.end());
    return files;
}

// Calls use with the pixels of one slice, as stored.
template <typename T>
void decodeAs(const std::vector<char>& bytes, std::size_t count,
              const std::function<void(const double*)>& use) {
    std::vector<double> values(count);
    const T* from = reinterpret_cast<const T*>(bytes.data());
    std::copy(from, from + count, values.begin());
    use(values.data());
}

void decodeSlice(const DicomSlice& slice, const std::function<void(const double*)>& use) {
    const std::size_t count = static_cast<std::size_t>(slice.columns) * slice.rows;
    const auto fail = [&](const std::string& problem) {
        throw Error(slice.file.string(), "", problem, "copy the file again");
    };
    gdcm::ImageReader reader;
    reader.SetFileName(slice.file.c_str());
    std::vector<char> bytes;
    try {
        if (!reader.Read()) fail("cut off or damaged: its pixels can not be read");
        const gdcm::Image& image = reader.GetImage();
        const gdcm::PixelFormat format = image.GetPixelFormat();
        const std::size_t expected = count * format.GetPixelSize();
        if (image.GetBufferLength() != expected)
            fail(fmt::format("cut off: expected {} bytes of pixels, found {}", expected,
                             image.GetBufferLength()));
        bytes.resize(expected);
        if (!image.GetBuffer(bytes.data())) fail("cut off or damaged: its pixels can not be decoded");
        switch (format.GetScalarType()) {
            case gdcm::PixelFormat::UINT8:
                return decodeAs<std::uint8_t>(bytes, count, use);
            case gdcm::PixelFormat::INT8:
                return decodeAs<std::int8_t>(bytes, count, use);
            case gdcm::PixelFormat::UINT12:
            case gdcm::PixelFormat::UINT16:
                return decodeAs<std::uint16_t>(bytes, count, use);
            case gdcm::PixelFormat::INT12:
            case gdcm::PixelFormat::INT16:
                return decodeAs<std::int16_t>(bytes, count, use);
            case gdcm::PixelFormat::UINT32:
                return decodeAs<std::uint32_t>(bytes, count, use);
            case gdcm::PixelFormat::INT32:
                return decodeAs<std::int32_t>(bytes, count, use);
            default:
                fail("expected whole numbers of 8 to 32 bits a pixel, found another type");
        }
    } catch (const Error&) {
        throw;
    } catch (const std::exception& error) {
        fail(std::string("can not be decoded: ") + error.what());
    }
}

struct PixelCounts {
    std::atomic<std::size_t> padding = 0;
    std::atomic<bool> fits = true;  // all values are whole and fit into 16 bits
};

// One slice in HU. Padding, and all that is too low for CT, becomes kLeastHu.
template <typename T>
void takeSlice(const DicomSlice& slice, T* target, PixelCounts& counts) {
    const std::size_t count = static_cast<std::size_t>(slice.columns) * slice.rows;
    const bool ct = slice.modality == "CT";
    decodeSlice(slice, [&](const double* stored) {
        std::size_t padded = 0;
        bool fits = true;
        for (std::size_t n = 0; n < count; ++n) {
            double value = stored[n] * slice.slope + slice.intercept;
            const bool padding = slice.hasPadding && stored[n] >= static_cast<double>(slice.padding) &&
                                 stored[n] <= static_cast<double>(slice.paddingLimit);
            if (ct && (padding || value < kLeastHu)) {
                padded += value != kLeastHu;
                value = kLeastHu;
            }
            fits &= value >= -32768 && value <= 32767 && value == std::floor(value);
            target[n] = static_cast<T>(std::is_integral_v<T> ? std::clamp(value, -32768.0, 32767.0) : value);
        }
        counts.padding += padded;
        if (!fits) counts.fits = false;
    });
}

// All slices; stops early where T is whole numbers and some value is not.
template <typename T>
void takeSlices(const DicomSeries& series, RawStudy& raw, PixelCounts& counts, Progress& progress) {
    const int slices = static_cast<int>(series.slices.size());
    const std::size_t perSlice = raw.frame.count() / slices;
    int done = 0;
    std::mutex reporting;
    raw.bytes = LazyArray<unsigned char>(raw.frame.count() * sizeof(T));
    parallelFor(slices, [&](int k) {
        if (progress.cancelled()) throw Cancelled();
        if (std::is_integral_v<T> && !counts.fits) return;
        takeSlice(series.slices[k], reinterpret_cast<T*>(raw.bytes.data()) + perSlice * k, counts);
        const std::lock_guard lock(reporting);
        progress.report(0.1 + 0.7 * ++done / slices, fmt::format("reading {} slices", slices));
    });
}

// Voxels of padding. In 16 bits where that loses nothing, else again as fractions.
std::size_t decodeAll(const DicomSeries& series, RawStudy& raw, Progress& progress) {
    PixelCounts whole, fractions;
    raw.type = SampleType::Int16;
    takeSlices<std::int16_t>(series, raw, whole, progress);
    if (whole.fits) return whole.padding;
    raw.type = SampleType::Float32;
    takeSlices<float>(series, raw, fractions, progress);
    return fractions.padding;
}

std::string joined(std::initializer_list<std::string> parts) {
    std::string text;
    for (const std::string& part : parts)
        if (!part.empty()) text += (text.empty() ? "" : ", ") + part;
    return text;
}

}  // namespace

std::vector<DicomSeries> scanFolder(const fs::path& folder) {
    prepareGdcm();
    const std::vector<fs::path> files = filesIn(folder);
    std::vector<std::optional<DicomSlice>> slices(files.size());
    parallelFor(static_cast<int>(files.size()), [&](int n) { slices[n] = readSliceHeader(files[n]); });
    std::map<std::string, DicomSeries> byUid;
    for (auto& slice : slices) {
        if (!slice) continue;
        DicomSeries& series = byUid[slice->uid];
        series.info = {slice->uid, slice->description, series.info.slices + 1};
        series.slices.push_back(std::move(*slice));
    }
    if (byUid.empty())
        throw Error(folder.string(), "",
                    fmt::format("expected DICOM images, found none among {} files", files.size()),
                    "give the folder that holds the slices themselves");
    std::vector<DicomSeries> all;
    for (auto& [uid, series] : byUid) all.push_back(std::move(series));
    return all;
}

DicomSeries chooseSeries(const fs::path& folder, const std::string& wanted) {
    std::vector<DicomSeries> all = scanFolder(folder);
    if (wanted.empty() && all.size() == 1) return std::move(all[0]);
    std::string list;
    for (std::size_t n = 0; n < all.size(); ++n) {
        const SeriesInfo& info = all[n].info;
        if (!wanted.empty() && (wanted == info.uid || wanted == std::to_string(n + 1)))
            return std::move(all[n]);
        list += fmt::format("{}{}: {} slices \"{}\"", n ? ", " : "", n + 1, info.slices, info.description);
    }
    if (wanted.empty())
        throw Error(folder.string(), "", fmt::format("holds {} series ({})", all.size(), list),
                    "choose one with --series N");
    throw Error(folder.string(), "", fmt::format("has no series \"{}\", only {}", wanted, list),
                "choose one of these by its number or UID");
}

VolumeFile readDicom(const fs::path& folder, const StudyOptions& options, Progress& progress) {
    progress.report(0, "looking through " + folder.filename().string());
    DicomSeries series = chooseSeries(folder, options.series);
    const SlicePlaces places = placeSlices(folder, series.slices, options.resample);
    const DicomSlice& first = series.slices.front();
    const glm::ivec3 size = places.frame.size;
    checkSize(folder.string(),
              {static_cast<std::uint64_t>(size.x), static_cast<std::uint64_t>(size.y),
               static_cast<std::uint64_t>(size.z)},
              2 * static_cast<int>(sizeof(std::int16_t)));
    progress.report(0.1, fmt::format("reading {} slices", size.z));
    VolumeFile result;
    result.format = "DICOM";
    result.description = joined({first.modality, first.description, first.kernel});
    result.raw.frame = places.frame;
    if (const std::size_t padded = decodeAll(series, result.raw, progress); padded > 0)
        result.notes.push_back(
            fmt::format("{} voxels of padding or below {} HU were set to {} HU", padded, kLeastHu, kLeastHu));
    if (places.upright) return result;
    result.raw = resampleSlices(result.raw, places, folder.string());
    result.notes.push_back(
        fmt::format("resampled onto an even upright grid of {:.3f} mm steps: the largest gap was {:.2f} mm, "
                    "the tilt {:.2f} degrees",
                    places.frame.spacing.z * 1e3, places.largestGap * 1e3, glm::degrees(places.tilt)));
    return result;
}

}  // namespace stereonav
