// Files that are never half-written: the content goes beside its place and is renamed into it. All that the
// program writes goes through here.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace stereonav {

// Throws Error naming the path when it can not be read.
std::string readTextFile(const std::filesystem::path& path);

// "-", or a name that the system has for it, as /dev/stdout.
bool isStandardOutput(const std::filesystem::path& path);

// Throws Error naming the path, the folder that is missing or can not be written, or what else is in the way.
// Tries for real whether a file can be made, leaves nothing.
void checkPlaceForFile(const std::filesystem::path& path);

// A file that is made under another name of the same extension, temporary(), until finish() puts it into its
// place. What the place is:
// - a file, or nothing yet in a folder that is there: the temporary lies beside it and is renamed into it,
// with
//   the permissions of the one it replaces;
// - a link: the same for what it points to;
// - a pipe, a device or standard output: the bytes are written into it at the end.
// A missing folder is an error, but for cacheFolder(), which is made.
class PendingFile {
public:
    // Throws Error, as checkPlaceForFile() does.
    explicit PendingFile(const std::filesystem::path& place);
    ~PendingFile();  // removes what was not finished
    PendingFile(const PendingFile&) = delete;
    PendingFile& operator=(const PendingFile&) = delete;

    const std::filesystem::path& temporary() const { return mTemporary; }
    // Throws Error where there is no temporary, or it does not get into its place.
    void finish();

private:
    std::filesystem::path mPlace, mTarget, mTemporary;
    std::filesystem::path mOwnFolder;  // of the temporary of a stream; "" where it lies beside its place
};

// Calls write(temporary) with the temporary of a PendingFile, then finishes it. On any exception the place is
// as it was. Throws Error when it can not be written.
void writeFileAtomically(const std::filesystem::path& path,
                         const std::function<void(const std::filesystem::path&)>& write);

void writeTextFile(const std::filesystem::path& path, const std::string& content);

// Where computed things are kept between runs: $XDG_CACHE_HOME/stereonav or ~/.cache/stereonav.
std::filesystem::path cacheFolder();

}  // namespace stereonav
