// The grey values that a scene was made from, for pictures of its slices.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/progress.h"
#include "engine/volume/components.h"
#include "engine/volume/piece_choices.h"
#include "engine/volume/volume.h"

namespace stereonav {

// Pieces that the lumen can be made of, whether they were taken or not.
struct SlicePieces {
    struct Piece {
        glm::dvec3 place{0.0};  // world: one of its voxels
        std::string text;       // description, and why it was taken or left out; "": not worth a word
        bool sure = true;
    };
    VoxelRuns runs;  // runs of voxels, in the study's grid
    Components parts;
    std::vector<Piece> list;  // one for each component
    // Value above which voxels are tagged fluid, which can be chosen too; empty for masks.
    std::optional<double> fluidAbove;

    int at(const glm::ivec3& voxel) const { return parts.at(runs, voxel); }  // -1: none
};

struct SliceStudy {
    GreyVolume grey;
    SlicePieces pieces;   // empty where no lumen was searched
    bool ofMask = false;  // a mask, which has no grey values
    // Width and middle of the range that is shown from black to white.
    double windowWidth = 1500, windowLevel = -200;
};

// A capability (capabilities.h) of scenes that were made from slices.
class SliceSource {
public:
    virtual ~SliceSource() = default;
    // Reads the slices again; takes seconds, on any thread. Throws Error, Cancelled.
    virtual std::shared_ptr<const SliceStudy> readSlices(Progress& progress) const = 0;
    // Returns the lumen to outline in them; null where there is none.
    virtual const MaskVolume* lumen() const = 0;
    // Returns the places in the world from which the lumen was found.
    virtual const std::vector<glm::dvec3>& seeds() const = 0;
    // Returns the user's changes to the pieces that were taken.
    virtual const PieceChoices& pieceChoices() const = 0;
};

}  // namespace stereonav
