// Files that other files name: the samples of a header, the buffers and pictures of a mesh.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace stereonav {

// Returns the file that `file` calls `name`, where it lies in the folder of `file` or in one below, whatever
// the way that it is named in. Returns none elsewhere: who opens a file that somebody sent does not expect
// that it reads others of theirs. Names alone count: a link in the folder is followed, since somebody who may
// write there made it.
std::optional<std::filesystem::path> fileNamedBy(const std::filesystem::path& file, const std::string& name);

}  // namespace stereonav
