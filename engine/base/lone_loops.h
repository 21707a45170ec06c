// Loops of a thread that computes in the background.
#pragma once

namespace stereonav {

// Loops that this thread starts from now on (parallelFor) run on this thread only, so that they take no more
// than one core, and the loops of other threads keep their threads. Can not be undone. Results are the same.
void loopOnThisThreadAlone();

}  // namespace stereonav
