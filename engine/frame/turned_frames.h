// What a FrameMaker may be beside: one whose frames hold something arbitrary, as the places of a medium's
// slices. Frames that differ in it alone are as right as each other, and their mean is better than any.
#pragma once

namespace stereonav {

class TurnedFrames {
public:
    virtual ~TurnedFrames() = default;
    // Of the next frames: 0 is how they are made alone; from there on to below 1.
    virtual void setTurn(double turn) = 0;
};

}  // namespace stereonav
