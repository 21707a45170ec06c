#include "colon/study/study_folder.h"

#include <fmt/format.h>

#include <algorithm>

#include "colon/study/study_text.h"
#include "engine/base/error.h"
#include "engine/base/file.h"
#include "engine/base/regular_file.h"

namespace stereonav {
namespace {
namespace fs = std::filesystem;

constexpr std::size_t kMostFilesBelow = 100'000;
constexpr int kDeepestFolder = 16;
// Looked at for folders that hold slices: that is advice, and takes no long time.
constexpr int kMostEntriesLookedAt = 20'000, kMostSlicesLookedAt = 8;

bool isDirectoryFile(const fs::path& path) {
    std::error_code code;
    return loweredText(path.filename().string()) == "dicomdir" && fs::is_regular_file(path, code);
}

bool isHeld(const fs::directory_entry& entry) {
    std::error_code code;
    return entry.is_regular_file(code) && !isHiddenFile(entry.path()) && !isDirectoryFile(entry.path());
}

// Calls use(entry, iterator) for each entry below that is not hidden, until it returns false.
template <typename Use>
void walkBelow(const fs::path& folder, const Use& use) {
    std::error_code code;
    fs::recursive_directory_iterator entry(folder, fs::directory_options::skip_permission_denied, code);
    for (; !code && entry != fs::recursive_directory_iterator(); entry.increment(code)) {
        if (isHiddenFile(entry->path()) || entry.depth() >= kDeepestFolder) entry.disable_recursion_pending();
        if (!isHiddenFile(entry->path()) && !use(*entry)) return;
    }
}

// Folders below that hold slices, relative to it and sorted, as far as they are looked for.
std::vector<std::string> foldersOfSlices(const fs::path& folder) {
    std::vector<std::string> found;
    fs::path present;
    int entries = 0, slices = 0;
    walkBelow(folder, [&](const fs::directory_entry& entry) {
        const fs::path parent = entry.path().parent_path();
        if (parent != present) present = parent, slices = 0;
        if (slices < kMostSlicesLookedAt && isHeld(entry) && isSliceName(entry.path())) {
            ++slices;
            const std::string name = parent.lexically_relative(folder).string();
            if (isDicomFile(entry.path()) && std::find(found.begin(), found.end(), name) == found.end())
                found.push_back(name);
        }
        return ++entries < kMostEntriesLookedAt;
    });
    std::sort(found.begin(), found.end());
    return found;
}

}  // namespace

bool isSliceName(const fs::path& path) {
    const std::string extension = loweredText(path.extension().string());
    if (isHiddenFile(path)) return false;
    return extension.empty() || extension == ".dcm" || extension == ".ima" || extension == ".dicom" ||
           extension.find_first_not_of(".0123456789") == std::string::npos;
}

bool isDicomFile(const fs::path& path) {
    const std::string extension = loweredText(path.extension().string());
    std::error_code code;
    if (!fs::is_regular_file(path, code)) return false;
    if (extension == ".dcm" || extension == ".ima" || extension == ".dicom") return true;
    try {
        const std::string head = firstBytes(path, 132);
        return head.size() == 132 && head.ends_with("DICM");
    } catch (const Error&) {  // it can not be opened
        return false;
    }
}

fs::path folderOfStudy(const fs::path& place) {
    if (!isDirectoryFile(place)) return place;
    return place.has_parent_path() ? place.parent_path() : fs::path(".");
}

bool isRootOfDisc(const fs::path& folder) {
    std::error_code code;
    for (const auto& entry : fs::directory_iterator(folder, code))
        if (isDirectoryFile(entry.path())) return true;
    return false;
}

std::vector<fs::path> filesIn(const fs::path& place) {
    std::error_code code;
    if (!fs::is_directory(place, code)) return {place};
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(place, code))
        if (isHeld(entry)) files.push_back(entry.path());
    if (code) throw Error(place.string(), "", "can not be opened", "check the name and its permissions");
    std::sort(files.begin(), files.end());
    return files;
}

std::vector<fs::path> filesBelow(const fs::path& folder) {
    std::vector<fs::path> files;
    walkBelow(folder, [&](const fs::directory_entry& entry) {
        if (isHeld(entry)) files.push_back(entry.path());
        if (files.size() > kMostFilesBelow)
            throw Error(folder.string(), "", fmt::format("holds more than {} files", kMostFilesBelow),
                        "give the folder of one study");
        return true;
    });
    std::sort(files.begin(), files.end());
    return files;
}

std::string studyFoldersAdvice(const fs::path& folder) {
    constexpr std::size_t kNamed = 3;
    const std::vector<std::string> found = foldersOfSlices(folder);
    if (found.empty()) return "";
    if (found.size() == 1)
        return fmt::format("its folder {} holds DICOM slices: give that one", shortText(found[0]));
    std::string list;
    for (std::size_t n = 0; n < std::min(found.size(), kNamed); ++n)
        list += (n == 0 ? "" : n + 1 == found.size() ? " and " : ", ") + shortText(found[n]);
    if (found.size() > kNamed) list += fmt::format(" and {} more", found.size() - kNamed);
    return fmt::format("its folders {} hold DICOM slices: give one of them", list);
}

}  // namespace stereonav
