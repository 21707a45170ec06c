// The files that this run has opened for reading, by device and inode: writing an output over one of them
// would destroy it. Every opening of a file is noted in app/open_watch.cpp, so that files count too that a
// library opens beside the one it was given.
#pragma once

#include <filesystem>

namespace stereonav {

// Notes a file descriptor that was opened for reading. Only regular files count. From any thread.
void noteFileRead(int file);

// Returns whether the file was noted as read, under any name; links are followed. False where there is no
// file.
bool wasFileRead(const std::filesystem::path& path);

// Removes a file from the list: the program may overwrite a file that it has written itself, even if it was
// read in between.
void forgetFileRead(const std::filesystem::path& path);

}  // namespace stereonav
