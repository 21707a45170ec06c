// Which pieces of air in a CT are the colon: told from the air around the patient, lungs and other bowel gas
// by place, size and shape.
#pragma once

#include <string>
#include <vector>

#include "colon/segmentation/lumen_pieces.h"
#include "colon/segmentation/segmentation.h"

namespace stereonav {

enum class AirKind : std::uint8_t { Outside, Lung, Small, Other, Colon };

struct AirPieces {
    Pieces pieces;
    std::vector<AirKind> kinds;  // of each piece
    std::vector<std::string> notes;
};

// What is not the colon's, by kind: "2 pieces of lung, 1 small piece".
std::string leftOut(const AirPieces& air);

// HU of a voxel, and back to stored numbers.
double huAt(const GreyVolume& study, const glm::ivec3& voxel);
double storedOf(const GreyVolume& study, double hu);

// Voxel axis (0, 1, 2) that is nearest to a world axis.
int voxelAxisOf(const VolumeFrame& frame, int worldAxis);

// Throws Error when there is no air or nothing but air; Cancelled. With seeds no piece is Colon yet.
// known: voxels below setting.air; nothing: they are looked for.
AirPieces findAir(const GreyVolume& study, const SegmentationSetting& setting, std::optional<VoxelRuns> known,
                  Progress& progress);

}  // namespace stereonav
