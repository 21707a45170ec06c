// Progress of parallel loops while they run, so that a long loop without reports of its own still shows that
// it works, and how far it is.
#pragma once

#include <functional>

namespace stereonav {

// share: part that is done of the outermost loop that the program's first thread has started, 0 to 1.
using LoopLook = std::function<void(double share)>;

// Sets a function that the program's first thread calls between pieces of the loops that it takes part in; an
// empty one ends that. To be set while no loop runs. The function must be quick: pieces may take
// microseconds.
void watchLoops(LoopLook look);

// A plain loop on the program's first thread whose steps start parallel loops: while this object lives, its
// share is reported instead of theirs. Does nothing on other threads.
class LoopSteps {
public:
    explicit LoopSteps(int count);  // number of steps
    ~LoopSteps();
    LoopSteps(const LoopSteps&) = delete;
    LoopSteps& operator=(const LoopSteps&) = delete;

    void next();  // one more step is done

private:
    bool mOutermost;
};

}  // namespace stereonav
