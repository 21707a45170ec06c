// What a file is called in documents that are handed on: where it lies on this machine is nobody's business.
#pragma once

#include <filesystem>
#include <string>

namespace stereonav {

// The name alone, of a file, of a folder ("study/" too), or of what is built in.
inline std::string handedName(const std::string& path) {
    const std::filesystem::path whole = std::filesystem::path(path).lexically_normal();
    const std::filesystem::path name =
        whole.has_filename() ? whole.filename() : whole.parent_path().filename();
    return name.empty() || name == "." || name == ".." ? path : name.string();
}

}  // namespace stereonav
