// A folder's content to choose from, for opening and saving files.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/view/file_looks.h"

namespace stereonav {

class FileBrowser {
public:
    enum class For { Open, OpenOther, SaveScene, OpenPath, Pick, Name };  // Pick: any file; Name: one to make

    // name: the one that stands there at first; "": the usual one.
    void open(For what, const std::string& name = "");
    void close() { mOpen = false; }
    bool isOpen() const { return mOpen; }
    // Returns the file that was chosen in this layout, if any.
    std::optional<std::filesystem::path> draw(FileLooks& looks);
    For purpose() const { return mFor; }
    // Sets the folder that the next look begins in; "": the working folder.
    void startIn(const std::filesystem::path& folder) { mFolder = folder; }
    const std::filesystem::path& folder() const { return mFolder; }

private:
    struct Entry {
        std::string name;
        bool folder = false, readable = false;  // readable: has the name of a type that the program knows
        std::uintmax_t bytes = 0;
    };
    void goTo(const std::filesystem::path& folder);
    void choose(const std::filesystem::path& path);
    bool saves() const { return mFor == For::SaveScene || mFor == For::Name; }
    const char* title() const;
    void drawEntries();
    void drawLook(FileLooks& looks);

    bool mOpen = false, mFresh = false, mAll = false;
    For mFor = For::Open;
    std::filesystem::path mFolder;
    std::optional<std::filesystem::path> mChosen;
    std::vector<Entry> mEntries;
    std::string mProblem, mName, mFilter;
};

// Returns whether the program reads files with this extension.
bool looksReadable(const std::filesystem::path& file);
bool looksLikePath(const std::filesystem::path& file);  // whether it may be a flight

}  // namespace stereonav
