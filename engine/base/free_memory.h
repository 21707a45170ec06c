// Memory that was freed.
#pragma once

namespace stereonav {

// Gives freed memory back to the system. The C library otherwise keeps most of it, for each thread its own,
// for what is asked for next.
void giveBackFreeMemory();

}  // namespace stereonav
