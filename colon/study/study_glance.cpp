// Identifies a folder of DICOM slices by some of its files.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "colon/study/study_folder.h"
#include "colon/study/study_parts.h"
#include "engine/base/error.h"
#include "engine/base/file.h"

namespace stereonav {
namespace {
namespace fs = std::filesystem;

constexpr std::size_t kMostFiles = 100'000;  // files that are counted
constexpr std::size_t kMostLooks = 16;       // files that are opened

// Files below the root of a disc that may be slices, by their names.
std::vector<fs::path> filesAt(const fs::path& place, Progress& progress) {
    progress.report(0, "listing");
    std::error_code code;
    if (!fs::is_directory(place, code)) return {place};
    if (isRootOfDisc(place)) {
        std::vector<fs::path> below = filesBelow(place);
        std::erase_if(below, [](const fs::path& file) { return !isSliceName(file); });
        return below;
    }
    std::vector<fs::path> files;
    for (fs::directory_iterator entry(place, code), end; entry != end && files.size() < kMostFiles && !code;
         entry.increment(code)) {
        if (files.size() % 1000 == 0) progress.report(0, "listing");
        std::error_code ignored;
        if (entry->is_regular_file(ignored) && !isHiddenFile(entry->path())) files.push_back(entry->path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

void take(StudyGlance& glance, const DicomSlice& slice) {
    glance.description = slice.modality;
    if (!slice.description.empty())
        glance.description += (glance.description.empty() ? "" : ", ") + slice.description;
    glance.size = {static_cast<std::uint64_t>(slice.columns), static_cast<std::uint64_t>(slice.rows)};
    if (slice.frames > 1) glance.size.push_back(static_cast<std::uint64_t>(slice.frames));
    if (slice.hasSpacing) glance.spacing_mm = {slice.spacing.x, slice.spacing.y};
}

}  // namespace

StudyGlance glanceAtSlices(const fs::path& given, Progress& progress) {
    const fs::path place = folderOfStudy(given);
    const std::vector<fs::path> files = filesAt(place, progress);
    StudyGlance glance;
    glance.format = "DICOM";
    glance.files = files.size();
    std::set<std::string> series;
    std::string problem;
    const std::size_t looks = std::min(files.size(), kMostLooks);
    for (std::size_t n = 0; n < looks; ++n) {
        progress.report(static_cast<double>(n) / static_cast<double>(looks), "looking at the slices");
        try {
            bool isDicom = false;
            for (const DicomSlice& slice : readSlices(files[n * files.size() / looks], isDicom)) {
                if (!slice.aside.empty()) continue;
                if (series.empty()) take(glance, slice);
                series.insert(slice.uid);
                break;  // frames are of one series
            }
        } catch (const Error& error) {
            if (problem.empty()) problem = error.what();
        }
    }
    progress.report(1, "looking at the slices");
    glance.series = series.size();
    if (!series.empty()) return glance;
    if (!problem.empty()) throw Error("", "", problem, "");
    throw Error(place.string(), "", fmt::format("expected DICOM images, found none in {} files of it", looks),
                "name the folder that holds the slices themselves");
}

}  // namespace stereonav
