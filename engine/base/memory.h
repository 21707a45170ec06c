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

// Throws Error where `bytes` are more than there are: what needs how much, and what there is.
// what: a file, an option, or ""; advice: what would need less.
void checkMemory(const std::string& what, double bytes, const std::string& advice);

// "1.5 GB", "12 MB"
std::string memoryText(double bytes);

}  // namespace stereonav
