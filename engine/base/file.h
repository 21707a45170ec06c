// Files that are never half-written: the content is written beside its final path and renamed into it. The
// program writes all its files through here.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "engine/base/stop.h"

namespace stereonav {

// Throws Error where the path is a folder, or a pipe or device, from which data may never come. A missing
// file passes: its reader reports that.
void checkFileToRead(const std::filesystem::path& path);
// Returns the kind of a path in words for messages: "a folder", "a pipe"...
std::string kindOfFile(const std::filesystem::path& path);

// Returns whether the file's name begins with a dot. Readers of folders do not take such files for data: they
// belong to other programs, such as macOS's ._NAME beside NAME.
bool isHiddenFile(const std::filesystem::path& path);

// Returns the whole content, byte for byte. Throws Error that names the path where it can not be read, is no
// file, or is larger than the available memory.
std::string readTextFile(const std::filesystem::path& path);

// Returns whether the path is "-", or one of the system's names for standard output, such as /dev/stdout.
bool isStandardOutput(const std::filesystem::path& path);

// Throws Error where no file can be made at this path; it names the path, and the folder or other obstacle.
// Tests by making a file, and removes it.
void checkPlaceForFile(const std::filesystem::path& path);

// Throws Error where the path is a file that this run has read (files_read.h) and would destroy.
void checkIsNoInput(const std::filesystem::path& place);

// Existing files that a new file may replace: NothingRead: none that this run has read. Anything: for the
// program's own files, which a run reads and then continues, such as those in cacheFolder().
enum class Over { NothingRead, Anything };
// When a file is put in its place: after it has reached the disk, or after the system has it. The second is
// for many files: waiting for the disk would take longer than making them, and after a power cut they are all
// made again.
enum class Flush { ToDisk, ToSystem };
// Users who may read a new file. UserAlone is for files that the program keeps (own_folder.h), such as those
// in cacheFolder(): a link in their place is replaced, and former permissions are not kept.
enum class Readers { AsUsual, UserAlone };

// A file that is written under another name with the same extension, temporary(), until finish() moves it to
// its place. The temporary exists from the start, empty, under an unpredictable name, and only this user may
// read it until the end. How it gets to its place depends on what the place is:
// - a file, or nothing yet in an existing folder: the temporary lies beside it and is renamed into it,
//   with the permissions of the file that it replaces;
// - a link: the same for the link's target;
// - a pipe, a device or standard output: the bytes are written into it at the end.
// A missing folder is an error, except cacheFolder(), which is made; so is a file that this run has read.
class PendingFile {
public:
    // Throws Error, as checkPlaceForFile() does.
    explicit PendingFile(const std::filesystem::path& place, Over over = Over::NothingRead,
                         Readers readers = Readers::AsUsual);
    ~PendingFile();  // removes what was not finished
    PendingFile(const PendingFile&) = delete;
    PendingFile& operator=(const PendingFile&) = delete;

    const std::filesystem::path& temporary() const { return mTemporary; }
    // Throws Error where the temporary is gone, or can not be moved to its place.
    void finish(Flush flush = Flush::ToDisk);

private:
    void checkNotRead() const;
    void intoPlace();              // copies into a pipe, a device or standard output
    unsigned modeInPlace() const;  // permissions of the file in the place

    std::filesystem::path mPlace, mTarget, mTemporary;
    std::filesystem::path mOwnFolder;  // folder of the temporary of a pipe or device; else ""
    Over mOver;
    Readers mReaders;
    std::optional<UnfinishedFile> mUnfinished, mUnfinishedFolder;
};

// Calls write(temporary) with the temporary of a PendingFile, then finishes it. On any exception the place
// stays as it was. Throws Error where it can not be written, or `write` wrote nothing.
void writeFileAtomically(const std::filesystem::path& path,
                         const std::function<void(const std::filesystem::path&)>& write,
                         Over over = Over::NothingRead);

// Writes content as writeFileAtomically() does, and throws as it does.
void writeTextFile(const std::filesystem::path& path, const std::string& content, Flush flush = Flush::ToDisk,
                   Over over = Over::NothingRead);

// Returns the folder for computed data that are kept between runs: $XDG_CACHE_HOME/stereonav or
// ~/.cache/stereonav, readable only for the user. Throws Error where the folder belongs to another user
// (own_folder.h).
std::filesystem::path cacheFolder();

}  // namespace stereonav
