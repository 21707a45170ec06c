// A look at parallel loops while they run, so that a long one without reports of its own still shows life,
// and how far it is.
#pragma once

#include <functional>

namespace stereonav {

// share: of the outermost loop that the program's first thread has started, what is done, 0 to 1.
using LoopLook = std::function<void(double share)>;

// Called by the program's first thread between pieces of the loops it takes part in; empty: nothing is. Set
// while no loop runs. Must be quick: pieces may take microseconds.
void watchLoops(LoopLook look);

// A plain loop on the program's first thread whose steps start parallel ones: while it lives, its share is
// told instead of theirs. On other threads it does nothing.
class LoopSteps {
public:
    explicit LoopSteps(int count);  // steps
    ~LoopSteps();
    LoopSteps(const LoopSteps&) = delete;
    LoopSteps& operator=(const LoopSteps&) = delete;

    void next();  // one more is done

private:
    bool mOutermost;
};

}  // namespace stereonav
