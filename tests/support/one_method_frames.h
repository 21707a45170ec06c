// A maker of frames with one method, whose right eye is its left: a test says what the left one shows.
#pragma once

#include <array>

#include "engine/frame/frame_maker.h"

namespace stereonav::test {

class OneMethodFrames : public FrameMaker {
public:
    std::span<const std::string_view> methods() const override { return kMethods; }
    std::string_view defaultMethod() const override { return kMethods[0]; }
    std::string_view exactMethod() const override { return kMethods[0]; }
    std::string_view whatMethodsMake() const override { return "both eyes"; }
    void make(const StereoViews& views, double time, const FrameWay&, EyePair& frame) override {
        makeOne(views.left, time, frame);
        frame.right = frame.left;
    }

private:
    static constexpr std::array<std::string_view, 1> kMethods{"alone"};
};

}  // namespace stereonav::test
