// Places for new files. What exists already is never written over: where the wanted place is taken, the new
// file's name gets a number.
#pragma once

#include <filesystem>

namespace stereonav {

// Returns the wanted path where nothing exists there, else the first free one with a number before its
// extension: flight_0002.mp4 beside flight.mp4. The path of a pipe or a device is returned as it is: it is
// written into.
std::filesystem::path freePlace(const std::filesystem::path& wanted);

// Holds a free path for a file that another process will write: an empty file or folder lies there until
// then, so that nobody else takes the path. If it is still empty at the end it is removed.
class HeldPlace {
public:
    enum class Kind { File, Folder };
    // Holds nothing where nothing can be made at the path, as when the folder is missing: the writer reports
    // the problem.
    HeldPlace(const std::filesystem::path& wanted, Kind kind);
    ~HeldPlace();
    HeldPlace(const HeldPlace&) = delete;
    HeldPlace& operator=(const HeldPlace&) = delete;

    const std::filesystem::path& path() const { return mPath; }

private:
    std::filesystem::path mPath;
    Kind mKind;
    bool mHolds = false;
};

}  // namespace stereonav
