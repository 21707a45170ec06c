// A slice through a study as a picture on the CPU: grey values through a window, the lumen's outline, marks.
// Patient's axes as radiology shows them: axial from below (the patient's left on the right, front on top),
// coronal from the front, sagittal from the left with the front on the left; the head is up.
#pragma once

#include <optional>
#include <vector>

#include "engine/image/packed_color.h"
#include "engine/image/plane.h"
#include "engine/scene/slices.h"
#include "engine/volume/volume.h"

namespace stereonav {

enum class SliceAxis { Axial, Coronal, Sagittal };

// How a slice lies in a picture: fitted into it, centred, with square millimetres. The voxel axis nearest
// to the patient's axis is the one that is cut, so a slice is one of voxels.
class SliceLayout {
public:
    // width, height: pixels, at least 1. The frame has at least one voxel along each axis.
    SliceLayout(const VolumeFrame& frame, SliceAxis axis, int width, int height);

    int sliceCount() const { return mFrame.size[mNormal]; }
    int sliceAt(const glm::dvec3& world) const;  // the nearest one, within the study
    // Continuous voxel of a place in the picture; its coordinate along the cut axis is `slice`.
    glm::dvec3 voxelAt(double x, double y, int slice) const;
    // Where a voxel lies in the picture, continuous pixels.
    glm::dvec2 pixelOf(const glm::dvec3& voxel) const;
    // The world point under a pixel; none beside the study.
    std::optional<glm::dvec3> worldAt(double x, double y, int slice) const;
    // Millimetres of the slice along the patient's axis, in its middle.
    double placeOf(int slice) const;
    double pixelsPerMetre() const { return mScale; }
    // As this one, `factor` (at least 1) times as large about a world place, which stays in the picture's
    // middle as far as the study reaches.
    SliceLayout zoomed(double factor, const glm::dvec3& world) const;
    // The place moved onto a slice, straight.
    glm::dvec3 onSlice(const glm::dvec3& world, int slice) const;
    // Voxel axes: those along the picture's axes, and the one that is cut.
    int across() const { return mAcross; }
    int down() const { return mDown; }
    int normal() const { return mNormal; }

private:
    VolumeFrame mFrame;
    int mPatientAxis;               // 0 x, 1 y, 2 z of the world
    int mAcross, mDown, mNormal;    // voxel axes along the picture's axes
    double mAcrossSign, mDownSign;  // 1: voxel numbers grow rightwards, downwards
    double mScale;                  // pixels a metre
    glm::dvec2 mMiddle;             // of the picture
};

struct SliceMark {
    glm::dvec3 world{0.0};
    PackedColor color = 0;
    bool ring = false;  // a ring instead of a cross
};

struct SliceContent {
    const GreyVolume* grey = nullptr;
    double windowWidth = 1500, windowLevel = -200;  // values from black to white, > 0, and their middle
    const MaskVolume* lumen = nullptr;              // outlined; null: none. Of any frame
    std::vector<SliceMark> marks{};                 // those within half a slice bright, others near by dim
    // Pieces that are tinted; null: none. Of grey's frame
    const SlicePieces* pieces = nullptr;
    std::vector<PackedColor> tints{};  // of each piece; 0: as it is
};

Plane<PackedColor> drawSlice(const SliceContent& content, const SliceLayout& layout, int slice, int width,
                             int height);

}  // namespace stereonav
