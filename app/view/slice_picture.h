// A slice through a study as a picture made by the CPU: grey values through a window, the lumen's outline,
// marks. Orientation as in radiology: axial from below (the patient's left on the right, front on top),
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

// Layout of a slice in a picture: fitted, centred, with square millimetres. The voxel axis nearest to the
// patient's axis is cut, so that a slice is one of voxels.
class SliceLayout {
public:
    // width, height: pixels, at least 1. The frame has at least one voxel along each axis.
    SliceLayout(const VolumeFrame& frame, SliceAxis axis, int width, int height);

    int sliceCount() const { return mFrame.size[mNormal]; }
    int sliceAt(const glm::dvec3& world) const;  // nearest slice of the study
    // Returns the voxel, with fractions, at a place in the picture; its coordinate along the cut axis is
    // `slice`.
    glm::dvec3 voxelAt(double x, double y, int slice) const;
    // Returns the place of a voxel in the picture in pixels with fractions.
    glm::dvec2 pixelOf(const glm::dvec3& voxel) const;
    // Returns the world point under a pixel; empty outside the study.
    std::optional<glm::dvec3> worldAt(double x, double y, int slice) const;
    // Returns the place of the slice's middle along the patient's axis in millimetres.
    double placeOf(int slice) const;
    // Returns this layout enlarged by `factor` (at least 1) around a world place, which stays in the
    // picture's middle as far as the study allows.
    SliceLayout zoomed(double factor, const glm::dvec3& world) const;
    // Returns the place moved perpendicularly onto a slice.
    glm::dvec3 onSlice(const glm::dvec3& world, int slice) const;
    // Return voxel axes: those along the picture's axes, and the one that is cut.
    int across() const { return mAcross; }
    int down() const { return mDown; }
    int normal() const { return mNormal; }

private:
    VolumeFrame mFrame;
    int mPatientAxis;               // axis of the world: 0 x, 1 y, 2 z
    int mAcross, mDown, mNormal;    // voxel axes of the picture
    double mAcrossSign, mDownSign;  // 1: voxel numbers grow to the right, downwards
    double mScale;                  // pixels per metre
    glm::dvec2 mMiddle;             // middle of the picture
};

struct SliceMark {
    glm::dvec3 world{0.0};
    PackedColor color = 0;
    bool ring = false;  // a ring instead of a cross
};

struct SliceContent {
    const GreyVolume* grey = nullptr;
    double windowWidth = 1500, windowLevel = -200;  // width, > 0, and middle of the grey range
    const MaskVolume* lumen = nullptr;              // lumen to outline, in any frame; null: none
    std::vector<SliceMark> marks{};                 // bright within half a slice, dim farther away
    // Pieces to tint, in grey's frame; null: none.
    const SlicePieces* pieces = nullptr;
    std::vector<PackedColor> tints{};  // colour of each piece; 0: not tinted
};

Plane<PackedColor> drawSlice(const SliceContent& content, const SliceLayout& layout, int slice, int width,
                             int height);

}  // namespace stereonav
