// What the values of a study are like: their range, how many differ, whether they are labels. Told slice by
// slice, also while slices are still read and unpacked. Shared among colon/study/*.cpp only.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "colon/study/study_parts.h"

namespace stereonav {

// Of all samples. slices: those of the first slices, as far as they are known already.
ValueFacts factsOf(const RawStudy& raw, std::vector<ValueFacts> slices);

// Looks at slices on a thread of its own as their samples come, in order. Small studies, and programs of one
// thread, start none.
class FactsBeside {
public:
    // raw must outlive it and keep its samples where they are.
    explicit FactsBeside(const RawStudy& raw);
    ~FactsBeside();
    // So many bytes of samples have come; they do not change any more. Of the reading thread.
    void come(std::uint64_t bytes);
    // What is known of the first slices, once all that came has been looked at.
    std::vector<ValueFacts> take();

private:
    struct State;
    std::unique_ptr<State> mState;  // null: no thread
};

}  // namespace stereonav
