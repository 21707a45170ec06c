#include "colon/study/study_source.h"

#include <set>

#include "colon/study/study_dicom_file.h"
#include "colon/study/study_parts.h"
#include "engine/base/parallel.h"

namespace stereonav {
namespace {
namespace fs = std::filesystem;

struct SourceOfFile {
    StudySource source;  // without pictures
    std::pair<std::string, std::string> picture;
};

SourceOfFile sourceOfFile(const fs::path& path) {
    const DicomFile file(path);
    const DicomItem& set = file.set();
    SourceOfFile one;
    StudySource& s = one.source;
    s.characters = set.text(0x00080005);
    s.patientName = set.text(0x00100010);
    s.patientId = set.text(0x00100020);
    s.birthDate = set.text(0x00100030);
    s.sex = set.text(0x00100040);
    s.study = set.text(0x0020000d);
    s.studyDate = set.text(0x00080020);
    s.studyTime = set.text(0x00080030);
    s.studyId = set.text(0x00200010);
    s.accession = set.text(0x00080050);
    s.referring = set.text(0x00080090);
    s.studyDescription = set.text(0x00081030);
    s.series = set.text(0x0020000e);
    s.frame = set.text(0x00200052);
    one.picture = {set.text(0x00080016), set.text(0x00080018)};
    return one;
}

// The slices' files in the order of their places, each once: frames share one.
std::vector<fs::path> filesOfSeries(const fs::path& path, const StudyOptions& options) {
    DicomSeries series = chooseSeries(path, options.series);
    placeSlices(path, series.slices, options.resample, series.strangers);
    std::vector<fs::path> files;
    std::set<fs::path> known;
    for (const DicomSlice& slice : series.slices)
        if (known.insert(slice.file).second) files.push_back(slice.file);
    return files;
}

}  // namespace

std::optional<StudySource> sourceOf(const fs::path& path, const StudyOptions& options) {
    std::error_code code;
    if (!fs::is_directory(path, code) && !DicomFile(path).isDicom()) return std::nullopt;
    const std::vector<fs::path> files = filesOfSeries(path, options);
    std::vector<SourceOfFile> each(files.size());
    parallelFor(static_cast<int>(files.size()), [&](int n) { each[n] = sourceOfFile(files[n]); });
    StudySource all = each.front().source;
    for (const SourceOfFile& one : each) {
        if (one.source.frame != all.frame) all.frame.clear();
        if (!one.picture.first.empty() && !one.picture.second.empty()) all.pictures.push_back(one.picture);
    }
    return all;
}

}  // namespace stereonav
