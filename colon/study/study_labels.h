// Labels that a mask's header names, in one layer or several that overlap (3D Slicer's .seg.nrrd), and which
// of them is meant. Shared among colon/study/*.cpp only.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "colon/study/study.h"

namespace stereonav {

struct RawStudy;

// A label of the header.
struct NamedLabel {
    std::string name, id;
    std::uint64_t layer = 0;
    std::int64_t value = 1;  // the label's number in the voxels of that layer
};

// Several numbers a voxel, one a layer.
struct LabelLayers {
    std::uint64_t count = 1;
    std::uint64_t run = 1;  // samples of a layer that lie side by side before those of the next
};

// The labels of a mask, and the one that is meant.
struct MaskLabels {
    std::vector<NamedLabel> named;
    LabelLayers layers;
    std::optional<NamedLabel> chosen;  // none: the values tell
};

// Returns the number that --label gives, none where it gives a name.
std::optional<std::int64_t> labelNumber(const std::string& label);

// Returns whether keys of a header are about labels.
bool namesLabels(const HeaderFields& fields);
// Returns what a header's keys "Segment0_Name" and the like say, in the order of their numbers. A key that
// says nothing of a layer: the first one, or, where none does, its own. Throws Error over numbers that are
// none.
std::vector<NamedLabel> namedLabelsOf(const std::string& file, const HeaderFields& fields,
                                      std::uint64_t layers);

// Returns `1 "ribs", 2 "colon"`.
std::string labelListText(const std::vector<NamedLabel>& labels);

// Sets `chosen` where the header is enough to tell. Throws Error where a label is not there, or is one of
// several and none was asked for that only the header can tell apart.
void chooseLabel(const std::string& file, const StudyOptions& options, MaskLabels& labels);

// Keeps the samples of one layer alone.
void keepLayer(const LabelLayers& layers, std::uint64_t layer, RawStudy& raw);

}  // namespace stereonav
