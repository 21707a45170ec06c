// Places for new files. What exists already is never written over: where the wanted place is taken, the new
// file's name gets a number.
#pragma once

#include <filesystem>

namespace stereonav {

// Returns the wanted place where nothing is there, else the first free one with a number before its
// extension: flight_0002.mp4 beside flight.mp4. A pipe or a device stays what it is: it is written into.
std::filesystem::path freePlace(const std::filesystem::path& wanted);

// A free place for what another process writes later: an empty file, or an empty folder, lies there until
// then, so that nobody else takes the place. What is still empty at the end is taken away.
class HeldPlace {
public:
    enum class Kind { File, Folder };
    // Where nothing can be made there (the folder is missing) nothing is held: the writer says what is wrong.
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
