// The limit that limitMemory() (memory.h) sets, shared by the program and its modules.
#pragma once

#include <atomic>

namespace stereonav {

// Returns the limit in bytes; 0: none.
std::atomic<double>& memoryLimit();
// Lets a module, which has this code a second time (module.h), follow the program's limit.
void shareMemoryLimit(std::atomic<double>& program);

}  // namespace stereonav
