// Checks of output places, made before the work starts whose result goes there.
#pragma once

#include <cstdio>
#include <filesystem>
#include <initializer_list>
#include <string>
#include <vector>

namespace stereonav {

struct NamedPlace {
    const char* option;
    std::string place;  // path as given; "": not given
};

// Checks by trying that the file can be made; nothing stays behind. Throws Error that names `option`. "-" is
// standard output. Missing folders are not made.
void checkOutputFile(const std::string& option, const std::filesystem::path& file);
// Checks also that a later run can go on from the file: it is neither standard output nor a pipe or device.
void checkOutputToReadAgain(const std::string& option, const std::filesystem::path& file);
// Checks also that the extension is one of a picture that can be written; standard output gets PNG.
void checkOutputPicture(const std::string& option, const std::filesystem::path& file);

// Checks a folder for many files; the folder itself may be missing, but not its parent.
void checkOutputFolder(const std::string& option, const std::filesystem::path& folder);
// Makes the folder, but no parent folders. Throws Error.
void makeOutputFolder(const std::filesystem::path& folder);

// Throws Error where the output is the same file as an input, under any name: the input would be destroyed.
void checkNoInput(const NamedPlace& output, const std::vector<NamedPlace>& inputs);

// Throws Error where one of these outputs is a file that the program has read since it began
// (engine/base/files_read.h). To be called once the scene is loaded, before the long work starts.
void checkNotRead(std::initializer_list<NamedPlace> outputs);

// Returns the stream for messages beside these outputs: standard output, or standard error where an output
// goes to standard output. Throws Error where two outputs go to the same place.
std::FILE* messagesBeside(const std::vector<NamedPlace>& outputs);

}  // namespace stereonav
