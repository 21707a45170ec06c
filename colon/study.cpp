// Opens a study, whatever its format: reader, then grey values or a mask; and its key for the cache.
#include "colon/study.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>

#include "colon/study_header.h"
#include "colon/study_text.h"
#include "engine/base/hash.h"
#include "engine/base/parallel.h"

namespace stereonav {
namespace {
namespace fs = std::filesystem;

// Counts up when the reader gives other voxels or frames for the same bytes.
constexpr std::int64_t kReaderVersion = 2;
constexpr std::size_t kHashBlock = 4 << 20;

bool isVolumeName(const fs::path& path) {
    const std::string name = loweredText(path.filename().string());
    for (const char* end : {".nrrd", ".nhdr", ".nii", ".nii.gz", ".mha", ".mhd"})
        if (name.ends_with(end)) return true;
    return isNiftiPair(path);  // .hdr and .img are names of other things as well
}

// DICOM slices are called anything: with .dcm or .ima, without an extension, or by a UID, whose last part
// looks like one.
bool isSliceName(const fs::path& path) {
    const std::string extension = loweredText(path.extension().string());
    if (path.filename().string().front() == '.') return false;
    return extension.empty() || extension == ".dcm" || extension == ".ima" || extension == ".dicom" ||
           extension.find_first_not_of(".0123456789") == std::string::npos;
}

// A file's bytes as memory.
class MappedFile {
public:
    explicit MappedFile(const fs::path& file) {
        const int descriptor = open(file.c_str(), O_RDONLY | O_CLOEXEC);
        struct stat status {};
        if (descriptor >= 0 && fstat(descriptor, &status) == 0 && status.st_size > 0) {
            mBytes = static_cast<std::size_t>(status.st_size);
            mData = mmap(nullptr, mBytes, PROT_READ, MAP_PRIVATE, descriptor, 0);
        }
        if (descriptor >= 0) close(descriptor);
        if (descriptor < 0 || mData == MAP_FAILED)
            throw Error(file.string(), "", "can not be opened", "check the name and its permissions");
    }
    ~MappedFile() {
        if (mData) munmap(mData, mBytes);
    }
    MappedFile(const MappedFile&) = delete;
    MappedFile& operator=(const MappedFile&) = delete;
    const unsigned char* data() const { return static_cast<const unsigned char*>(mData); }
    std::size_t size() const { return mBytes; }

private:
    void* mData = nullptr;
    std::size_t mBytes = 0;
};

// In blocks on all threads; the value depends on the bytes alone.
std::uint64_t hashOfFile(const fs::path& file) {
    const MappedFile mapped(file);
    std::vector<std::uint64_t> blocks((mapped.size() + kHashBlock - 1) / kHashBlock);
    parallelFor(static_cast<int>(blocks.size()), [&](int n) {
        const std::size_t start = kHashBlock * n;
        blocks[n] = Hash().add(mapped.data() + start, std::min(kHashBlock, mapped.size() - start)).value();
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
    return hash.add(static_cast<std::int64_t>(options.label.value_or(0))).value();
}

// The header itself and the files that it names, in their order.
std::vector<fs::path> filesOfVolume(const fs::path& file) {
    const VolumeHeader header = readVolumeHeader(file);
    std::vector<fs::path> files = header.headers;
    for (const fs::path& data : header.place.files)
        if (std::find(files.begin(), files.end(), data) == files.end()) files.push_back(data);
    return files;
}

std::vector<fs::path> filesOfFolder(const fs::path& folder, const StudyOptions& options) {
    DicomSeries series = chooseSeries(folder, options.series);
    placeSlices(folder, series.slices, options.resample);
    std::vector<fs::path> files;
    for (const DicomSlice& slice : series.slices) files.push_back(slice.file);
    return files;
}

// True for a folder; throws Error for what is neither that nor a volume file.
bool isFolder(const fs::path& path) {
    std::error_code code;
    if (!fs::exists(path, code)) throw Error(path.string(), "", "does not exist", "check the name");
    if (fs::is_directory(path, code)) return true;
    if (!isVolumeName(path))
        throw Error(path.string(), "", "expected a volume",
                    "give a .nrrd, .nhdr, .nii, .nii.gz, .mha or .mhd file, or a folder of DICOM slices");
    return false;
}

// True for a folder; also throws Error for a series where there are none to choose from.
bool isFolder(const fs::path& path, const StudyOptions& options) {
    const bool folder = isFolder(path);
    if (!folder && !options.series.empty())
        throw Error(
            "--series", "",
            "expected with a folder of DICOM slices, \"" + path.filename().string() + "\" holds one volume",
            "leave it out");
    return folder;
}

}  // namespace

std::vector<SeriesInfo> listSeries(const fs::path& folder) {
    if (!isFolder(folder))
        throw Error(folder.string(), "", "expected a folder of DICOM slices", "only these hold series");
    std::vector<SeriesInfo> list;
    for (const DicomSeries& series : scanFolder(folder)) list.push_back(series.info);
    return list;
}

bool looksLikeStudy(const fs::path& path) {
    std::error_code code;
    if (!fs::is_directory(path, code)) return isVolumeName(path);
    for (const auto& entry : fs::directory_iterator(path, code))
        if (entry.is_regular_file(code) && isSliceName(entry.path())) return true;
    return false;
}

std::uint64_t studyKey(const fs::path& path, const StudyOptions& options) {
    return keyOfFiles(isFolder(path, options) ? filesOfFolder(path, options) : filesOfVolume(path), options);
}

Study readStudy(const fs::path& path, const StudyOptions& options, Progress& progress) {
    const bool folder = isFolder(path, options);
    Study study;
    VolumeFile file = folder ? readDicom(path, options, progress) : readVolumeFile(path, options, progress);
    progress.report(0.8, "looking at the values");
    study.format = file.format;
    study.description = file.description;
    study.notes = std::move(file.notes);
    takeValues(file.raw, path.string(), options, study);
    progress.report(0.95, "computing the key");
    study.key = studyKey(path, options);
    progress.report(1, "read " + path.filename().string());
    return study;
}

}  // namespace stereonav
