// Loops of a thread that works behind others.
#pragma once

namespace stereonav {

// Loops that this thread starts from now on (parallelFor) run on it alone, so that it takes no more than one
// core and the others' loops keep their threads. Never undone. Results are the same.
void loopOnThisThreadAlone();

}  // namespace stereonav
