// A folder's content to choose from: for opening what the program reads, and for saving.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/view/file_looks.h"

namespace stereonav {

class FileBrowser {
public:
    enum class For { Open, OpenOther, SaveScene, OpenPath };

    void open(For what);
    void close() { mOpen = false; }
    bool isOpen() const { return mOpen; }
    // What was chosen, once; none mostly.
    std::optional<std::filesystem::path> draw(FileLooks& looks);
    For purpose() const { return mFor; }
    // Where the next look begins; "" for the present folder.
    void startIn(const std::filesystem::path& folder) { mFolder = folder; }
    const std::filesystem::path& folder() const { return mFolder; }

private:
    struct Entry {
        std::string name;
        bool folder = false, readable = false;  // readable: by its name, of a type that the program knows
        std::uintmax_t bytes = 0;
    };
    void goTo(const std::filesystem::path& folder);
    void choose(const std::filesystem::path& path);
    void drawEntries();
    void drawLook(FileLooks& looks);

    bool mOpen = false, mFresh = false, mAll = false;
    For mFor = For::Open;
    std::filesystem::path mFolder;
    std::optional<std::filesystem::path> mChosen;
    std::vector<Entry> mEntries;
    std::string mProblem, mName, mFilter;
};

// Whether the program reads a file of this name, by its ending.
bool looksReadable(const std::filesystem::path& file);
bool looksLikePath(const std::filesystem::path& file);  // of a flight

}  // namespace stereonav
