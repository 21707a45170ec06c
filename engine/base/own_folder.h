// Folders of the program itself. The files in them tell of patients, so only the user may read them:
// permissions for others are removed, and folders of other users are refused.
#pragma once

#include <filesystem>
#include <string>

namespace stereonav {

// Returns the folder "stereonav" in the folder that the environment variable names ("XDG_CACHE_HOME"), or
// else in the folder `besideHome` of the user's home. A relative path in the variable is ignored (XDG base
// directory specification). "" without a home.
std::filesystem::path ownFolder(const char* variable, const char* besideHome);

// Returns the path of cacheFolder() without checking what lies there, for comparisons. Without a home it is
// in the folder for temporary files, and has the user's number in its name.
std::filesystem::path cachePlace();

// Removes the permissions of others from the folder. Throws Error where it belongs to another user, is a link
// that another user made, or keeps those permissions. A path that is no folder passes: later use reports
// that. advice: how to name another folder.
void checkOwnFolder(const std::filesystem::path& folder, const std::string& advice);

// Makes the folder and missing folders above it, then calls checkOwnFolder(). Throws Error where either
// fails.
void makeOwnFolder(const std::filesystem::path& folder, const std::string& advice);

constexpr const char* kMoveCache = "name another place for the cache with XDG_CACHE_HOME";

}  // namespace stereonav
