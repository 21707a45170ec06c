#include "app/output_place.h"

#include <unistd.h>

#include <cstdio>

#include "engine/base/error.h"
#include "engine/image/image_file.h"

namespace stereonav {
namespace fs = std::filesystem;
namespace {

// The folder itself, or the nearest one above it that exists.
fs::path nearestExisting(fs::path folder) {
    std::error_code code;
    while (!folder.empty() && !fs::exists(folder, code)) {
        if (folder == folder.parent_path()) break;
        folder = folder.parent_path();
    }
    return folder.empty() ? fs::path(".") : folder;
}

bool canMakeFileIn(const fs::path& folder) {
    std::error_code code;
    if (!fs::is_directory(folder, code)) return false;
    const fs::path probe = folder / (".stereonav." + std::to_string(getpid()) + ".part");
    std::FILE* file = std::fopen(probe.c_str(), "wb");
    if (!file) return false;
    std::fclose(file);
    fs::remove(probe, code);
    return true;
}

}  // namespace

void checkOutputFolder(const std::string& option, const fs::path& folder) {
    const fs::path existing = nearestExisting(folder);
    if (!canMakeFileIn(existing))
        throw Error(
            option, "",
            "\"" + folder.string() + "\" can not be written, because of \"" + existing.string() + "\"",
            "name a folder that can be written");
}

void checkOutputFile(const std::string& option, const fs::path& file) {
    std::error_code code;
    if (!file.has_filename() || fs::is_directory(file, code))
        throw Error(option, "", "expected a file, got the folder \"" + file.string() + "\"",
                    "add a file name");
    checkOutputFolder(option, file.has_parent_path() ? file.parent_path() : fs::path("."));
}

void checkOutputPicture(const std::string& option, const fs::path& file) {
    if (!file.has_extension() || !canWritePicture(file.extension().string()))
        throw Error(option, "", "\"" + file.string() + "\" has no extension of a picture that can be written",
                    "use .png or .jpg");
    checkOutputFile(option, file);
}

}  // namespace stereonav
