// Undo and redo in their plainest form: a list of all states and a place in it. The program's own stacks are
// compared with it, action by action.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace stereonav::test {

template <typename State>
class PlainSteps {
public:
    explicit PlainSteps(State first) : mStates{std::move(first)} {}

    const State& now() const { return mStates[mAt]; }
    // Takes another way from here: the states ahead are dropped.
    void change(State next) {
        mStates.resize(mAt + 1, mStates.front());
        mStates.push_back(std::move(next));
        ++mAt;
    }
    bool canUndo() const { return mAt > 0; }
    bool canRedo() const { return mAt + 1 < mStates.size(); }
    void undo() { mAt -= canUndo() ? 1 : 0; }
    void redo() { mAt += canRedo() ? 1 : 0; }

private:
    std::vector<State> mStates;
    std::size_t mAt = 0;
};

}  // namespace stereonav::test
