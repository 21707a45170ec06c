// What a FrameMaker may be beside: one that makes frames slice by slice, as media are. Where the slices lie
// is arbitrary: frames that differ in it alone are as right as each other, and their mean is better than any.
#pragma once

namespace stereonav {

// Places and number of the slices of the next frames.
class SlicedFrames {
public:
    virtual ~SlicedFrames() = default;
    // Share of a slab by which the slices of the next frames lie elsewhere: 0 is how they are made alone;
    // from there on to below 1.
    virtual void setTurn(double turn) = 0;
    // Sets the factor on the number of slices of the next frames, whose root is the one on the light's texels
    // a side: 1 is what the scene asks for.
    virtual void setEffort(double share) = 0;
};

}  // namespace stereonav
