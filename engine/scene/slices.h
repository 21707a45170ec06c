// The grey values behind a scene, for pictures of its slices.
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

// Pieces that the lumen may be made of, whether they were taken or not.
struct SlicePieces {
    struct Piece {
        glm::dvec3 place{0.0};  // world: a voxel of it
        std::string text;       // what it is and why it was taken or left; "": nothing is worth a word
        bool sure = true;
    };
    VoxelRuns runs;  // runs of voxels, in the study's grid
    Components parts;
    std::vector<Piece> list;           // one for each component
    std::optional<double> fluidAbove;  // values above it are tagged fluid, which is chosen too; none in masks

    int at(const glm::ivec3& voxel) const { return parts.at(runs, voxel); }  // -1: none
};

struct SliceStudy {
    GreyVolume grey;
    SlicePieces pieces;                             // none where no lumen was looked for
    bool ofMask = false;                            // it says what is lumen, and nothing of values
    double windowWidth = 1500, windowLevel = -200;  // values shown from black to white, and their middle
};

// A capability (capabilities.h): it was made from slices.
class SliceSource {
public:
    virtual ~SliceSource() = default;
    // Reads them again; takes seconds, on any thread. Throws Error, Cancelled.
    virtual std::shared_ptr<const SliceStudy> readSlices(Progress& progress) const = 0;
    // To be outlined in them; null where there is none.
    virtual const MaskVolume* lumen() const = 0;
    // World places that it was found from.
    virtual const std::vector<glm::dvec3>& seeds() const = 0;
    // Returns the user's changes to the pieces that were taken.
    virtual const PieceChoices& pieceChoices() const = 0;
};

}  // namespace stereonav
