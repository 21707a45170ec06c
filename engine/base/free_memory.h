// Memory that was freed.
#pragma once

namespace stereonav {

// Gives it back to the system. The C library keeps most of it else, for each thread its own, for what is
// asked for next.
void giveBackFreeMemory();

}  // namespace stereonav
