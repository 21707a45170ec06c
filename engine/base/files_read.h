// The files that this run has opened for reading, by device and inode: an output in the place of one of them
// would destroy it. The program's own door to the system notes them (app/open_watch.cpp), so that what a
// library opens beside what it was named counts too.
#pragma once

#include <filesystem>

namespace stereonav {

// Notes a file descriptor that was opened to be read. Counts regular files alone. From any thread.
void noteFileRead(int file);

// Returns whether the file was noted as read, under whatever name: links are followed. Returns false where
// there is no file.
bool wasFileRead(const std::filesystem::path& path);

// Takes the file from the list: what the program itself has written may be written again, though it was
// looked at in between.
void forgetFileRead(const std::filesystem::path& path);

}  // namespace stereonav
