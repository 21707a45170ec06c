// DICOM files, a folder of them or one: which series there are, how their slices lie, and their pixels in HU
// (stored number * slope + intercept, PS3.3 C.11.1), several files at a time.
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <glm/trigonometric.hpp>
#include <map>

#include "colon/study/picture_decoder.h"
#include "colon/study/study_facts.h"
#include "colon/study/study_folder.h"
#include "colon/study/study_parts.h"
#include "engine/base/file.h"
#include "engine/base/parallel.h"

namespace stereonav {
namespace {
namespace fs = std::filesystem;

constexpr int kLeastHu = -1024;  // lowest value of CT; lower numbers only mark what was not scanned

struct PixelCounts {
    std::atomic<std::size_t> padding = 0;
    std::atomic<bool> fits = true;  // all values are whole and fit into 16 bits
};

// One slice in HU. Padding, and all that is too low for CT, becomes kLeastHu.
template <typename T>
void takeHu(const DicomSlice& slice, const double* stored, T* target, PixelCounts& counts) {
    const std::size_t count = static_cast<std::size_t>(slice.columns) * slice.rows;
    const bool ct = slice.modality == "CT";
    std::size_t padded = 0;
    bool fits = true;
    for (std::size_t n = 0; n < count; ++n) {
        double value = valueOf(slice, stored[n]);
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
}

// Slices by the file that they are in, no more at once than keep several threads busy.
std::vector<std::vector<const DicomSlice*>> byFile(const DicomSeries& series) {
    constexpr std::size_t kMostAtOnce = 16;
    std::map<fs::path, std::size_t> known;
    std::vector<std::vector<const DicomSlice*>> groups;
    for (const DicomSlice& slice : series.slices) {
        const auto [at, isNew] = known.try_emplace(slice.file, groups.size());
        if (isNew || groups[at->second].size() == kMostAtOnce) {
            at->second = groups.size();
            groups.emplace_back();
        }
        groups[at->second].push_back(&slice);
    }
    return groups;
}

// All slices; stops early where T is whole numbers and some value is not. use(k): slice k has come; called
// from many threads.
template <typename T>
void takeSlices(const DicomSeries& series, RawStudy& raw, PixelCounts& counts, Progress& progress,
                const std::function<void(int k)>& use) {
    const std::size_t slices = series.slices.size(), perSlice = raw.frame.count() / slices;
    const auto groups = byFile(series);
    ProgressSteps steps(progress, slices, fmt::format("reading {} slices", slices));
    PictureDecoder decoder;
    raw.bytes = LazyArray<unsigned char>(raw.frame.count() * sizeof(T));
    parallelFor(static_cast<int>(groups.size()), [&](int n) {
        if (progress.cancelled()) throw Cancelled();
        if (std::is_integral_v<T> && !counts.fits) return;
        decodeSlices(groups[n], decoder, [&](const DicomSlice& slice, const double* stored) {
            const auto k = static_cast<std::size_t>(&slice - series.slices.data());
            takeHu(slice, stored, reinterpret_cast<T*>(raw.bytes.data()) + perSlice * k, counts);
            use(static_cast<int>(k));
            steps.done();
        });
    });
}

// Voxels of padding. In 16 bits where that loses nothing, else again as fractions. Slices are looked at as
// they come, while they are near.
std::size_t decodeAll(const DicomSeries& series, RawStudy& raw, const StudyOptions& options,
                      SliceLooks& looks, Progress& progress) {
    PixelCounts whole, fractions;
    raw.type = SampleType::Int16;
    std::vector<SliceLook> slices(series.slices.size());
    std::atomic<bool> many = false;
    Progress first(progress, 0, 0.8), again(progress, 0.8, 1);
    takeSlices<std::int16_t>(series, raw, whole, first, [&](int k) {
        SliceLook& look = slices[static_cast<std::size_t>(k)];
        look = lookAtSlice(raw, k, many, options.airBelow);
        if (look.facts.many) many = true;
    });
    if (whole.fits) {
        for (SliceLook& look : slices) addLook(std::move(look), looks);
        return whole.padding;
    }
    const glm::ivec3 size = raw.frame.size;
    checkSize(series.slices.front().file.parent_path().string(),
              {static_cast<std::uint64_t>(size.x), static_cast<std::uint64_t>(size.y),
               static_cast<std::uint64_t>(size.z)},
              sizeof(float) * static_cast<double>(
                                  raw.frame.count()));  // beside the whole numbers, which are given back then
    raw.bytes = {};
    raw.type = SampleType::Float32;
    takeSlices<float>(series, raw, fractions, again, [](int) {});
    return fractions.padding;
}

std::string joined(std::initializer_list<std::string> parts) {
    std::string text;
    for (const std::string& part : parts)
        if (!part.empty()) text += (text.empty() ? "" : ", ") + part;
    return text;
}

// Slices and other files found in a folder, before they are sorted into series.
struct Scanned {
    std::vector<DicomSlice> slices;
    std::vector<std::string> strangers;  // names of files that are not DICOM
    std::size_t files = 0;
};

Scanned scanFiles(const std::vector<fs::path>& files) {
    std::vector<std::vector<DicomSlice>> found(files.size());
    std::vector<char> dicom(files.size(), 0);
    parallelFor(static_cast<int>(files.size()), [&](int n) {
        bool isDicom = false;
        found[n] = readSlices(files[n], isDicom);
        dicom[n] = isDicom;
    });
    Scanned all;
    all.files = files.size();
    for (std::size_t n = 0; n < files.size(); ++n) {
        if (!dicom[n]) all.strangers.push_back(files[n].filename().string());
        for (DicomSlice& slice : found[n]) all.slices.push_back(std::move(slice));
    }
    return all;
}

// Looks in the folder itself or, where it is the root of a disc and has no slices, in all folders below it.
Scanned scanPlace(const fs::path& folder) {
    Scanned scanned = scanFiles(filesIn(folder));
    if (scanned.slices.empty() && isRootOfDisc(folder)) scanned = scanFiles(filesBelow(folder));
    return scanned;
}

// Leaves out localizers and the like where anything else is there. Returns a note about it, "" for none.
std::string leaveAside(std::vector<DicomSlice>& slices) {
    std::map<std::string, int> counts;
    for (const DicomSlice& slice : slices)
        if (!slice.aside.empty()) ++counts[slice.aside];
    const auto isAside = [](const DicomSlice& slice) { return !slice.aside.empty(); };
    if (counts.empty() || std::all_of(slices.begin(), slices.end(), isAside)) return "";
    std::erase_if(slices, isAside);
    std::string text;
    for (const auto& [what, count] : counts)
        text += fmt::format("{}{} {}{}", text.empty() ? "" : ", ", count, what,
                            count > 1 && what != "picture in colour" ? "s" : "");
    return "left aside: " + text;
}

// " (not DICOM: a, b and 3 more)"
std::string strangersText(const std::vector<std::string>& names) {
    constexpr std::size_t kNamed = 3;
    if (names.empty()) return "";
    std::string text = " (not DICOM: ";
    for (std::size_t n = 0; n < std::min(names.size(), kNamed); ++n) text += (n ? ", " : "") + names[n];
    if (names.size() > kNamed) text += fmt::format(" and {} more", names.size() - kNamed);
    return text + ")";
}

}  // namespace

double valueOf(const DicomSlice& slice, double stored) {
    if (!slice.table) return stored * slice.slope + slice.intercept;
    const auto last = static_cast<std::int64_t>(slice.table->size()) - 1;
    const std::int64_t at =
        std::clamp<std::int64_t>(static_cast<std::int64_t>(stored) - slice.tableFirst, 0, last);
    return (*slice.table)[static_cast<std::size_t>(at)];
}

std::vector<DicomSeries> scanFolder(const fs::path& given) {
    const fs::path place = folderOfStudy(given);
    Scanned scanned = scanPlace(place);
    const std::string aside = leaveAside(scanned.slices);
    std::map<std::string, DicomSeries> byUid;
    for (DicomSlice& slice : scanned.slices) {
        DicomSeries& series = byUid[slice.uid];
        series.info = {slice.uid, slice.description, series.info.slices + 1};
        series.slices.push_back(std::move(slice));
    }
    std::error_code code;
    if (byUid.empty() && !fs::is_directory(place, code))
        throw Error(
            place.string(), "", "expected a DICOM image, found another file",
            "give a folder of DICOM slices, or a volume file (.nrrd, .nhdr, .nii, .nii.gz, .mha, .mhd)");
    if (byUid.empty()) {
        const std::string advice = studyFoldersAdvice(place);
        throw Error(place.string(), "",
                    fmt::format("expected DICOM images, found none among {} files", scanned.files),
                    advice.empty() ? "give the folder that holds the slices themselves" : advice);
    }
    std::vector<DicomSeries> all;
    for (auto& [uid, series] : byUid) {
        if (!aside.empty()) series.notes.push_back(aside);
        series.strangers = strangersText(scanned.strangers);
        all.push_back(std::move(series));
    }
    return all;
}

DicomSeries chooseSeries(const fs::path& place, const std::string& wanted) {
    std::vector<DicomSeries> all = scanFolder(place);
    if (wanted.empty() && all.size() == 1) return std::move(all[0]);
    std::string list;
    for (std::size_t n = 0; n < all.size(); ++n) {
        const SeriesInfo& info = all[n].info;
        if (!wanted.empty() && (wanted == info.uid || wanted == std::to_string(n + 1)))
            return std::move(all[n]);
        list += fmt::format("{}{}: {} slices \"{}\"", n ? ", " : "", n + 1, info.slices, info.description);
    }
    if (wanted.empty())
        throw Error(place.string(), "", fmt::format("holds {} series ({})", all.size(), list),
                    "choose one with --series N; info --series-pictures DIR shows them");
    throw Error(place.string(), "", fmt::format("has no series \"{}\", only {}", wanted, list),
                "choose one of these by its number or UID");
}

VolumeFile readDicom(const fs::path& place, const StudyOptions& options, Progress& progress) {
    progress.report(0, "looking through " + place.filename().string());
    DicomSeries series = chooseSeries(place, options.series);
    const SlicePlaces places = placeSlices(place, series.slices, options.resample, series.strangers);
    checkFrame(place.string(), places.frame);
    const DicomSlice& first = series.slices.front();
    const glm::ivec3 size = places.frame.size;
    const std::vector<std::uint64_t> voxels = {static_cast<std::uint64_t>(size.x),
                                               static_cast<std::uint64_t>(size.y),
                                               static_cast<std::uint64_t>(size.z)};
    checkSize(place.string(), voxels, bytesHeld(voxels, sizeof(std::int16_t), options));
    Progress reading(progress, 0.1, 0.9);
    VolumeFile result;
    result.format = "DICOM";
    result.description = joined({first.modality, first.description, first.kernel});
    result.notes = series.notes;
    if (!first.placedBy.empty()) result.notes.push_back("frames placed by " + first.placedBy);
    if (first.table) result.notes.push_back("values by the file's table (modality LUT)");
    result.raw.frame = places.frame;
    SliceLooks looks;
    if (const std::size_t padded = decodeAll(series, result.raw, options, looks, reading); padded > 0)
        result.notes.push_back(
            fmt::format("{} voxels of padding or below {} HU were set to {} HU", padded, kLeastHu, kLeastHu));
    const std::string doing = fmt::format("reading {} slices", size.z);
    if (places.upright) {
        result.looks = std::move(looks);
        progress.report(1, doing);
        return result;
    }
    result.raw = resampleSlices(result.raw, places, place.string());
    result.notes.push_back(
        fmt::format("resampled onto an even upright grid of {:.3f} mm steps: the largest gap was {:.2f} mm, "
                    "the tilt {:.2f} degrees",
                    places.frame.spacing.z * 1e3, places.largestGap * 1e3, glm::degrees(places.tilt)));
    progress.report(1, doing);
    return result;
}

}  // namespace stereonav
