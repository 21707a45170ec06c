// How much memory a command may take, so that one that needs more is refused before it takes any.
#pragma once

#include <filesystem>
#include <string>

namespace stereonav {

// Bytes that can be had without others being pushed out: what the system says is available, and what the
// process's control groups leave of their limits; of the bytes that the environment variable STEREONAV_MEMORY
// gives this process, what it has not taken yet. Infinity where nothing tells.
// root: where proc and sys are; another one for tests.
double availableMemory(const std::filesystem::path& root = "/");

// Lets no more than these bytes be taken in all from now on, for what is asked for here; 0: what the system
// gives.
void limitMemory(double bytes);

// Returns availableMemory(), where `bytes` are about to be taken. For tests: where the environment variable
// STEREONAV_MEMORY_ASKED is the number of a file that is open to be added to (as by 9>>FILE), it gets a line
// for each such question: the bytes that the process has taken, and those asked for. It names no file:
// nothing is made or opened.
double availableMemoryFor(double bytes);

// Throws Error where `bytes` are more than there are: what needs how much, and what there is.
// what: a file, an option, or ""; advice: what would need less.
void checkMemory(const std::string& what, double bytes, const std::string& advice);

// Returns bytes for messages: "1.5 GB", "12 MB".
std::string memoryText(double bytes);

}  // namespace stereonav
