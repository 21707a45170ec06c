// Places for results, checked before the work that fills them starts.
#pragma once

#include <filesystem>
#include <string>

namespace stereonav {

// Each tries for real whether a file can be made there, creates nothing that stays, and throws Error
// naming `option`. Missing folders on the way are fine where they can be made.
void checkOutputFile(const std::string& option, const std::filesystem::path& file);
void checkOutputFolder(const std::string& option, const std::filesystem::path& folder);
// Also that the extension is one of a picture that can be written.
void checkOutputPicture(const std::string& option, const std::filesystem::path& file);

}  // namespace stereonav
