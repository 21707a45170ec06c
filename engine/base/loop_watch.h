// A look at parallel loops while they run, so that a long one without reports of its own still shows life.
#pragma once

#include <functional>

namespace stereonav {

// Called by the program's first thread between pieces of the loops it takes part in; empty: nothing is. Set
// while no loop runs. Must be quick: pieces may take microseconds.
void watchLoops(std::function<void()> look);

}  // namespace stereonav
