// Opens a study, whatever its format: reader, then grey values or a mask; and its key for the cache.
#include "colon/study/study.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <set>
#include <utility>

#include "colon/study/study_folder.h"
#include "colon/study/study_header.h"
#include "colon/study/study_labels.h"
#include "colon/study/study_mapped.h"
#include "colon/study/study_text.h"
#include "engine/base/file.h"
#include "engine/base/hash.h"
#include "engine/base/parallel.h"

namespace stereonav {
namespace {
namespace fs = std::filesystem;

const char* nameOf(SampleType type) {
    constexpr const char* kNames[] = {"uint8", "int8",   "uint16", "int16",   "uint32",
                                      "int32", "uint64", "int64",  "float32", "float64"};
    return kNames[static_cast<int>(type)];
}

// Counts up when the reader gives other voxels or frames for the same bytes.
constexpr std::int64_t kReaderVersion = 3;
constexpr std::size_t kHashBlock = 4 << 20;

bool isVolumeName(const fs::path& path) {
    const std::string name = loweredText(path.filename().string());
    for (const char* end : {".nrrd", ".nhdr", ".nii", ".nii.gz", ".mha", ".mhd"})
        if (name.ends_with(end)) return true;
    return isNiftiPair(path);  // .hdr and .img are names of other things as well
}

// Hashes blocks on all threads; the value depends on the bytes alone.
std::uint64_t hashOfFile(const fs::path& file) {
    const MappedFile mapped(file);
    std::vector<std::uint64_t> blocks((mapped.size() + kHashBlock - 1) / kHashBlock);
    parallelFor(static_cast<int>(blocks.size()), [&](int n) {
        const std::size_t start = kHashBlock * n, count = std::min(kHashBlock, mapped.size() - start);
        blocks[n] = Hash().add(mapped.data() + start, count).value();
        mapped.release(start, count);
    });
    Hash hash;
    hash.add(static_cast<std::int64_t>(mapped.size()));
    hash.add(blocks.data(), blocks.size() * sizeof(std::uint64_t));
    return hash.value();
}

std::uint64_t keyOfFiles(const std::vector<fs::path>& files, const StudyOptions& options) {
    std::vector<std::uint64_t> hashes(files.size());
    parallelFor(static_cast<int>(files.size()), [&](int n) { hashes[n] = hashOfFile(files[n]); });
    Hash hash;
    hash.add(kReaderVersion).add(hashes.data(), hashes.size() * sizeof(std::uint64_t));
    hash.add(static_cast<std::int64_t>(options.resample));
    hash.add(static_cast<std::int64_t>(options.label.has_value()));
    // Names begin behind what is hashed for numbers.
    const auto number = options.label ? labelNumber(*options.label) : std::optional<std::int64_t>(0);
    hash.add(number.value_or(0));
    if (!number) hash.add(*options.label);
    return hash.value();
}

// The header itself and the files that it names, in their order.
std::vector<fs::path> filesOfVolume(const fs::path& file) {
    const VolumeHeader header = readVolumeHeader(file);
    std::vector<fs::path> files = header.headers;
    std::set<fs::path> known(files.begin(), files.end());
    for (const fs::path& data : header.place.files)
        if (known.insert(data).second) files.push_back(data);
    return files;
}

std::vector<fs::path> filesOfFolder(const fs::path& folder, const StudyOptions& options) {
    DicomSeries series = chooseSeries(folder, options.series);
    placeSlices(folder, series.slices, options.resample, series.strangers);
    std::vector<fs::path> files;
    std::set<fs::path> known;  // frames share a file
    for (const DicomSlice& slice : series.slices)
        if (known.insert(slice.file).second) files.push_back(slice.file);
    return files;
}

// The name of a detached header beside a file of samples, "" where there is none.
std::string ownerOf(const fs::path& path) {
    constexpr int kMostHeaders = 32;
    int headers = 0;
    std::error_code code;
    if (!fs::is_regular_file(path, code)) return "";
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    for (const auto& entry : fs::directory_iterator(folder, code)) {
        if (isHiddenFile(entry.path())) continue;
        const std::string extension = loweredText(entry.path().extension().string());
        if (extension != ".nhdr" && extension != ".mhd") continue;
        if (++headers > kMostHeaders) return "";
        try {
            for (const fs::path& data : readVolumeHeader(entry.path()).place.files)
                if (data.filename() == path.filename() && fs::equivalent(data, path, code))
                    return entry.path().filename().string();
        } catch (const Error&) {
            continue;  // it says nothing of this file
        }
    }
    return "";
}

// Returns true for a folder and a file of slices; throws Error for what is neither that nor a volume file.
bool isDicom(const fs::path& path) {
    std::error_code code;
    if (!fs::exists(path, code)) throw Error(path.string(), "", "does not exist", "check the name");
    if (fs::is_directory(path, code)) return true;
    if (isVolumeName(path)) return false;
    if (isDicomFile(path)) return true;
    const std::string owner = ownerOf(path);
    if (!owner.empty())
        throw Error(path.string(), "", "holds samples only, " + owner + " is their header", "give that file");
    throw Error(path.string(), "", "expected a volume",
                "give a .nrrd, .nhdr, .nii, .nii.gz, .mha or .mhd file, or a folder of DICOM slices");
}

// Returns what isDicom(path) does; also throws Error for a series where there are none to choose from.
bool isDicom(const fs::path& path, const StudyOptions& options) {
    const bool dicom = isDicom(path);
    if (!dicom && !options.series.empty())
        throw Error("--series", "",
                    "needs a folder of DICOM slices, \"" + path.filename().string() + "\" holds one volume",
                    "leave it out");
    return dicom;
}

}  // namespace

StudyGlance glanceAtStudy(const fs::path& path, Progress& progress) {
    if (isDicom(path)) return glanceAtSlices(path, progress);
    progress.report(0, "looking at the header");
    const VolumeHeader header = readVolumeHeader(path);
    checkSampleFiles(path, header);
    StudyGlance glance{header.format, header.description, nameOf(header.type), header.size, {}, 1, 1};
    for (int axis = 0; axis < 3; ++axis) glance.spacing_mm.push_back(glm::length(header.steps[axis]));
    progress.report(1, "looking at the header");
    return glance;
}

bool looksLikeStudy(const fs::path& path) {
    std::error_code code;
    if (!fs::is_directory(path, code))
        return isVolumeName(path) || isDicomFile(path) || !ownerOf(path).empty();
    // Beside files of other kinds a name without an extension may be anything: README, LICENSE.
    std::vector<fs::path> bare;
    bool others = false;
    for (const auto& entry : fs::directory_iterator(path, code)) {
        if (!entry.is_regular_file(code) || isHiddenFile(entry.path())) continue;
        const bool slice = isSliceName(entry.path()), named = entry.path().has_extension();
        if (slice && named) return true;
        if (slice) bare.push_back(entry.path());
        others |= !slice;
    }
    return others ? std::any_of(bare.begin(), bare.end(), isDicomFile) : !bare.empty();
}

std::uint64_t studyKey(const fs::path& path, const StudyOptions& options) {
    return keyOfFiles(isDicom(path, options) ? filesOfFolder(path, options) : filesOfVolume(path), options);
}

Study readStudy(const fs::path& path, const StudyOptions& options, Progress& progress) {
    const bool dicom = isDicom(path, options);
    Study study;
    Progress reading(progress, 0, 0.8);
    VolumeFile file = dicom ? readDicom(path, options, reading) : readVolumeFile(path, options, reading);
    progress.report(0.8, "checking the values");
    study.format = file.format;
    study.description = file.description;
    study.notes = std::move(file.notes);
    study.directed = file.directed;
    takeValues(std::move(file.raw), std::move(file.looks), file.labels, path.string(), options, study);
    progress.report(0.95, "computing the key");
    study.key = options.key ? *options.key : studyKey(path, options);
    progress.report(1, "read " + path.filename().string());
    return study;
}

}  // namespace stereonav
