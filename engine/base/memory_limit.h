// The limit that limitMemory() (memory.h) sets is one for the program and its modules.
#pragma once

#include <atomic>

namespace stereonav {

// Bytes; 0: none.
std::atomic<double>& memoryLimit();
// A module has this code a second time (module.h): it follows the program's limit.
void shareMemoryLimit(std::atomic<double>& program);

}  // namespace stereonav
