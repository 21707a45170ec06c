// Folders of the program's own. What it keeps there tells of patients, so they are the user's alone: rights
// of others are taken away, and folders of others are refused.
#pragma once

#include <filesystem>
#include <string>

namespace stereonav {

// Returns the folder "stereonav" in the folder that `variable` names ("XDG_CACHE_HOME"), or in `besideHome`
// in the user's home. A value that does not begin at the root does not count (XDG base directory
// specification). "": there is no home.
std::filesystem::path ownFolder(const char* variable, const char* besideHome);

// Returns the place of cacheFolder(), whatever lies there: to compare with. Without a home it is in the
// folder for temporary files, and named by the user's number.
std::filesystem::path cachePlace();

// Takes the rights of others on the folder away. Throws Error where it is another user's, or a link that
// another user made, or the rights stay. What is no folder passes: who goes on with it hears of that.
// advice: how to name another folder.
void checkOwnFolder(const std::filesystem::path& folder, const std::string& advice);

// Makes the folder with what is missing above it, then checks it as checkOwnFolder() does. Throws Error where
// either fails.
void makeOwnFolder(const std::filesystem::path& folder, const std::string& advice);

constexpr const char* kMoveCache = "name another place for the cache with XDG_CACHE_HOME";

}  // namespace stereonav
