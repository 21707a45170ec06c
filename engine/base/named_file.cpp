#include "engine/base/named_file.h"

namespace stereonav {

std::optional<std::filesystem::path> fileNamedBy(const std::filesystem::path& file, const std::string& name) {
    const std::filesystem::path folder = std::filesystem::absolute(file).parent_path().lexically_normal();
    // The system would read a name up to its first zero.
    const std::filesystem::path place = (folder / name.substr(0, name.find('\0'))).lexically_normal();
    const std::filesystem::path within = place.lexically_relative(folder);
    if (within.empty() || within == "." || *within.begin() == "..") return std::nullopt;
    return file.parent_path() / within;
}

}  // namespace stereonav
