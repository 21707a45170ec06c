// Fields for names of files, each with a button that looks for the file.
#pragma once

#include <optional>
#include <string>

namespace stereonav {

// A file to look for: for an option, or for a field that outlives the look.
struct FileWish {
    std::string key;               // option that it is for; "": `field`
    std::string* field = nullptr;  // where the name goes
    bool saves = false;            // whether the file is to be made
};

// Draws a field for the name of a file that is to be made, as wide as the item width or the space that is
// left. id: unique in the panel. field: see FileWish.
void fileField(const char* id, const char* hint, std::string& field, float width = 0);
// Draws the button that looks for a file for an option, in the same row.
void browseForOption(const char* key);
// Returns the width of such a button with the gap before it, in units of the interface.
float browseWidth();

// Returns what was asked for since the last call.
std::optional<FileWish> takeFileWish();

}  // namespace stereonav
