// Frames for sessions that draw none: methods to step through.
#pragma once

#include <array>

#include "engine/frame/frame_maker.h"

namespace stereonav {

class FakeFrames final : public FrameMaker {
public:
    std::span<const std::string_view> methods() const override { return kMethods; }
    std::string_view defaultMethod() const override { return kMethods[0]; }
    std::string_view exactMethod() const override { return kMethods[0]; }
    std::string_view whatMethodsMake() const override { return "right eye"; }
    void make(const StereoViews&, double, const FrameWay&, EyePair&) override {}
    void makeOne(const EyeView&, double, EyePair&) override {}

private:
    static constexpr std::array<std::string_view, 3> kMethods{"linear", "selective", "depthsplat"};
};

}  // namespace stereonav
