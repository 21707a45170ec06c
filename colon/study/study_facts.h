// Statistics of a study's values: their range, how many differ, whether they are labels; and where they are
// those of air. Told slice by slice, also while slices are still read and unpacked. Shared among
// colon/study/*.cpp only.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "colon/study/study_parts.h"

namespace stereonav {

// Returns the facts of all samples. slices: those of the first slices, as far as they are known already.
ValueFacts factsOf(const RawStudy& raw, const std::vector<ValueFacts>& slices);

// Returns whether values are kept as these samples are, so that air may be looked for among them.
bool showsAir(const RawStudy& raw);
// Returns the runs of samples below `limit`, HU. slices: those of the first slices, as factsOf()'s.
VoxelRuns airOf(const RawStudy& raw, double limit, std::vector<SliceRuns> slices);

struct SliceLook {
    ValueFacts facts;
    std::optional<SliceRuns> air;  // nothing where it is not asked for
};
// Looks at slice k. many: it is known already that too many values differ to be labels, which ones they are
// does not matter then. airBelow: HU; nothing unless showsAir().
SliceLook lookAtSlice(const RawStudy& raw, int k, bool many, const std::optional<double>& airBelow);
void addLook(SliceLook look, SliceLooks& looks);  // appends the next slice

// Looks at slices on a thread of its own as their samples come, in order. Small studies, and programs of one
// thread, start none.
class FactsBeside {
public:
    // raw must outlive the object and keep its samples where they are. airBelow: lookAtSlice()'s.
    explicit FactsBeside(const RawStudy& raw, const std::optional<double>& airBelow = {});
    ~FactsBeside();
    // Tells it that the first `bytes` bytes of the samples have come; they do not change any more. Called by
    // the reading thread.
    void come(std::uint64_t bytes);
    // Returns what is known of the first slices. Those that came and were not looked at yet are left to all
    // threads.
    SliceLooks take();

private:
    struct State;
    std::unique_ptr<State> mState;  // null: no thread
};

}  // namespace stereonav
