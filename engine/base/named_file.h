// Files that are named in other files: the samples of a header, the buffers and pictures of a mesh.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace stereonav {

// Returns the file that `file` refers to as `name`, if it lies in the folder of `file` or below; empty if it
// lies elsewhere: a user who opens a file from somebody else does not expect it to read other files. Only the
// path is tested: a link in the folder is followed, since only somebody with the right to write there can
// have made it.
std::optional<std::filesystem::path> fileNamedBy(const std::filesystem::path& file, const std::string& name);

}  // namespace stereonav
