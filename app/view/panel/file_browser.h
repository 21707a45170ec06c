// A folder's content to choose from: for opening what the program reads, and for saving.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/view/panel/panel_host.h"

namespace stereonav {

class FileBrowser {
public:
    enum class For { Open, OpenOther, SaveScene, OpenPath };

    void open(For what);
    void close() { mOpen = false; }
    bool isOpen() const { return mOpen; }
    void draw(PanelHost& host);
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
    void choose(PanelHost& host, const std::filesystem::path& path);
    void drawEntries(PanelHost& host);
    void drawLook(PanelHost& host);

    bool mOpen = false, mFresh = false, mAll = false;
    For mFor = For::Open;
    std::filesystem::path mFolder;
    std::vector<Entry> mEntries;
    std::string mProblem, mName, mFilter;
};

// Whether the program reads a file of this name, by its ending.
bool looksReadable(const std::filesystem::path& file);
bool looksLikePath(const std::filesystem::path& file);  // of a flight

}  // namespace stereonav
