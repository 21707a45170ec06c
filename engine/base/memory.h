// How much memory a command may take, so that one that needs more is refused before it takes any.
#pragma once

#include <filesystem>
#include <string>

namespace stereonav {

// Returns the bytes that can be taken without pushing others out of memory: the least of what the system has
// available, what the process's control groups leave, and what is left of the limits by limitMemory() and the
// environment variable STEREONAV_MEMORY. Infinity where none of these is known.
// root: folder that holds proc and sys; tests give another one.
double availableMemory(const std::filesystem::path& root = "/");

// Sets a limit on all bytes that this process takes, which availableMemory() and checkMemory() heed from now
// on; 0: no limit.
void limitMemory(double bytes);

// Returns availableMemory(), called before `bytes` are taken. For tests it appends a line to the file whose
// number is in the environment variable STEREONAV_MEMORY_ASKED, such as 9 with 9>>FILE: the bytes that the
// process has taken, and `bytes`. The variable holds no name, so that no file is made or opened.
double availableMemoryFor(double bytes);

// Throws Error, which says how much is needed and how much there is, where `bytes` are more than available.
// what: the file or option that needs them, or ""; advice: what would need less.
void checkMemory(const std::string& what, double bytes, const std::string& advice);

// Returns bytes for messages: "1.5 GB", "12 MB".
std::string memoryText(double bytes);

}  // namespace stereonav
