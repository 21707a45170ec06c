// Names of files in documents that are passed on: without the folders of this machine.
#pragma once

#include <filesystem>
#include <string>

namespace stereonav {

// Returns the last part of the path of a file or folder ("study/" too), or a built-in name.
inline std::string handedName(const std::string& path) {
    const std::filesystem::path whole = std::filesystem::path(path).lexically_normal();
    const std::filesystem::path name =
        whole.has_filename() ? whole.filename() : whole.parent_path().filename();
    return name.empty() || name == "." || name == ".." ? path : name.string();
}

}  // namespace stereonav
