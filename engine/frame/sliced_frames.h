// An extension of a FrameMaker that makes frames slice by slice, as for media. The position of the slices is
// arbitrary: frames that differ only in it are equally right, and their mean is better than each.
#pragma once

namespace stereonav {

// Position and number of the slices in the next frames.
class SlicedFrames {
public:
    virtual ~SlicedFrames() = default;
    // Sets the shift of the slices in the next frames, as a share of a slab: 0, as for a single frame, up to
    // below 1.
    virtual void setTurn(double turn) = 0;
    // Sets a factor on the number of slices in the next frames; its root is the factor on the light's texels
    // per side. 1: the scene's own setting.
    virtual void setEffort(double share) = 0;
};

}  // namespace stereonav
