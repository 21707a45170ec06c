// Places for results, checked before the work that fills them starts.
#pragma once

#include <cstdio>
#include <filesystem>
#include <initializer_list>
#include <string>
#include <vector>

namespace stereonav {

struct NamedPlace {
    const char* option;
    std::string place;  // "": not given
};

// Each tries for real whether a file can be made there, creates nothing that stays, and throws Error naming
// `option`.
// "-" is standard output. Folders are not made on the way.
void checkOutputFile(const std::string& option, const std::filesystem::path& file);
// Also that it is a file that a later run can go on from: neither standard output nor a pipe or device.
void checkOutputToReadAgain(const std::string& option, const std::filesystem::path& file);
// Also that the extension is one of a picture that can be written; standard output gets PNG.
void checkOutputPicture(const std::string& option, const std::filesystem::path& file);

// A folder for many files, which may be missing itself where the one that holds it is there.
void checkOutputFolder(const std::string& option, const std::filesystem::path& folder);
// Makes it, but none above it. Throws Error.
void makeOutputFolder(const std::filesystem::path& folder);

// Throws Error where an output is one of the inputs, under whatever name, since it would be destroyed.
void checkNoInput(const NamedPlace& output, const std::vector<NamedPlace>& inputs);

// Throws Error where one of these outputs is a file that has been read since the program began, by whomever
// (engine/base/files_read.h): known once the scene is loaded, and said before the long work starts.
void checkNotRead(std::initializer_list<NamedPlace> outputs);

// Where to print what there is to say beside these outputs: standard output, or standard error where one of
// them goes to standard output. Throws Error where two go to the same place.
std::FILE* messagesBeside(const std::vector<NamedPlace>& outputs);

}  // namespace stereonav
