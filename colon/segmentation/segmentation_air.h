// Which pieces of air in a CT are the colon: told from the air around the patient, lungs and other bowel gas
// by density, place, size and shape.
#pragma once

#include <string>
#include <vector>

#include "colon/segmentation/lumen_pieces.h"
#include "colon/segmentation/segmentation.h"

namespace stereonav {

// Classes of pieces of air. Other: gas that is not the colon's, or not surely.
enum class AirKind : std::uint8_t { Outside, Lung, Small, Other, Colon };

// Why a piece is of its kind, in words that follow "3.6 ml of gas around 1,2,3 mm: "; "" where its size or
// place says enough.
struct AirReason {
    std::string text;
    bool sure = true;
};

// All pieces of air, and what was made of each.
struct AirPieces {
    Pieces pieces;
    std::vector<AirKind> kinds;  // kind of each piece
    std::vector<AirReason> reasons;
};

// Returns what is not the colon's, by kind: "2 pieces of lung, 1 small piece".
std::string leftOut(const AirPieces& air);

// Returns the HU of a voxel; and the stored number of a value in HU.
double huAt(const GreyVolume& study, const glm::ivec3& voxel);
double storedOf(const GreyVolume& study, double hu);

// Returns the voxel axis (0, 1, 2) that is nearest to a world axis.
int voxelAxisOf(const VolumeFrame& frame, int worldAxis);

// Finds the pieces of air. known: voxels below setting.air; nothing: they are looked for. With seeds no piece
// is Colon yet. Throws Error when there is no air or nothing but air; Cancelled.
AirPieces findAir(const GreyVolume& study, const SegmentationSetting& setting, std::optional<VoxelRuns> known,
                  Progress& progress);

// Changes kinds by the setting's seeds and choices. Throws Error where one lies in tissue.
void takeGiven(const GreyVolume& study, const SegmentationSetting& setting, AirPieces& air);

// Returns a note on each piece that is worth a word: whether it was taken, where it lies and why; what is not
// sure first.
std::vector<std::string> pieceNotes(const GreyVolume& study, const AirPieces& air);

}  // namespace stereonav
