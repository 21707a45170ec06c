// Files that are never half-written: the content goes beside its place and is renamed into it. All that the
// program writes goes through here.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "engine/base/stop.h"

namespace stereonav {

// Throws Error where there is something else than a file: a folder, or a pipe or device, of which nobody
// knows whether anything comes out of it. What is not there passes: the reader says so.
void checkFileToRead(const std::filesystem::path& path);
// Returns what a place is in a word for messages: "a folder", "a pipe"...
std::string kindOfFile(const std::filesystem::path& path);

// Returns whether the file's name begins with a dot. In a folder such files are other programs' own, as
// macOS's ._NAME beside NAME: no reader of folders takes them for data.
bool isHiddenFile(const std::filesystem::path& path);

// Returns the whole content, byte for byte. Throws Error naming the path when it can not be read, is no file,
// or is more than there is memory.
std::string readTextFile(const std::filesystem::path& path);

// Returns whether the path is "-", or a name that the system has for standard output, as /dev/stdout.
bool isStandardOutput(const std::filesystem::path& path);

// Throws Error naming the path, the folder that is missing or can not be written, or what else is in the way.
// Tries for real whether a file can be made, leaves nothing.
void checkPlaceForFile(const std::filesystem::path& path);

// Throws Error where the place is a file that this run has read (files_read.h): it would be lost.
void checkIsNoInput(const std::filesystem::path& place);

// Which existing files a new file may replace. Anything is for files of our own that a run reads and goes on
// with; what lies in cacheFolder() is such.
enum class Over { NothingRead, Anything };
// Whether a file is put in its place when it is on the disk, or when the system has it: where there are many,
// waiting for each takes longer than making it, and all are made again after a power cut.
enum class Flush { ToDisk, ToSystem };
// Who may read a new file. UserAlone is for what the program keeps (own_folder.h): a link in its place is
// replaced, and so are the permissions of before. What lies in cacheFolder() is such.
enum class Readers { AsUsual, UserAlone };

// A file that is made under another name of the same extension, temporary(), until finish() puts it into its
// place. The temporary is there from the start, empty, under a name that nobody can foresee, and until the
// end nobody else may read it. What the place is:
// - a file, or nothing yet in a folder that is there: the temporary lies beside it and is renamed into it,
//   with the permissions of the one it replaces;
// - a link: the same for what it points to;
// - a pipe, a device or standard output: the bytes are written into it at the end.
// A missing folder is an error, but for cacheFolder(), which is made; so is a file that this run has read.
class PendingFile {
public:
    // Throws Error, as checkPlaceForFile() does.
    explicit PendingFile(const std::filesystem::path& place, Over over = Over::NothingRead,
                         Readers readers = Readers::AsUsual);
    ~PendingFile();  // removes what was not finished
    PendingFile(const PendingFile&) = delete;
    PendingFile& operator=(const PendingFile&) = delete;

    const std::filesystem::path& temporary() const { return mTemporary; }
    // Throws Error where the temporary is gone, or it does not get into its place.
    void finish(Flush flush = Flush::ToDisk);

private:
    void checkNotRead() const;
    void intoPlace();              // copies into a stream
    unsigned modeInPlace() const;  // permissions

    std::filesystem::path mPlace, mTarget, mTemporary;
    std::filesystem::path mOwnFolder;  // where a stream's temporary lies; "" where it lies beside its place
    Over mOver;
    Readers mReaders;
    std::optional<UnfinishedFile> mUnfinished, mUnfinishedFolder;
};

// Calls write(temporary) with the temporary of a PendingFile, then finishes it. On any exception the place is
// as it was. Throws Error when it can not be written, or nothing was.
void writeFileAtomically(const std::filesystem::path& path,
                         const std::function<void(const std::filesystem::path&)>& write,
                         Over over = Over::NothingRead);

// Writes content as writeFileAtomically() does, and throws as it does.
void writeTextFile(const std::filesystem::path& path, const std::string& content, Flush flush = Flush::ToDisk,
                   Over over = Over::NothingRead);

// Where computed things are kept between runs: $XDG_CACHE_HOME/stereonav or ~/.cache/stereonav, for the user
// alone. Throws Error where the folder there is another user's (own_folder.h).
std::filesystem::path cacheFolder();

}  // namespace stereonav
