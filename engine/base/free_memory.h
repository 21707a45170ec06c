// Returns freed memory to the system.
#pragma once

namespace stereonav {

// Gives freed memory back to the system. The C library otherwise keeps most of it for later requests,
// separately for each thread.
void giveBackFreeMemory();

}  // namespace stereonav
