#include "engine/camera/stereo_rig.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "engine/base/error.h"

namespace stereonav {
namespace {

constexpr int kMaxImageSide = 32768;

void checkLens(const Lens& lens) {
    if (lens.width < 1 || lens.height < 1 || lens.width > kMaxImageSide || lens.height > kMaxImageSide)
        throw Error(
            "", "image size",
            fmt::format("expected 1 to {} pixels a side, got {}x{}", kMaxImageSide, lens.width, lens.height),
            "give another --size");
    if (!(lens.verticalFov > 0 && lens.verticalFov < std::numbers::pi))
        throw Error("", "field of view",
                    fmt::format("expected more than 0 and less than 180 degrees, got {:g}",
                                lens.verticalFov * 180 / std::numbers::pi),
                    "give another fov_deg");
    if (!(lens.nearDepth > 0 && std::isfinite(lens.nearDepth)))
        throw Error("", "near distance", fmt::format("expected metres above 0, got {:g}", lens.nearDepth),
                    "give another near_m");
}

void checkSetting(const StereoSetting& s) {
    if (!(s.separation >= 0 && std::isfinite(s.separation)))
        throw Error("", "eye separation", fmt::format("expected metres >= 0, got {:g}", s.separation),
                    "give another separation_m");
    if (!(s.zeroParallax > 0 && std::isfinite(s.zeroParallax)))
        throw Error("", "zero-parallax distance",
                    fmt::format("expected metres above 0, got {:g}", s.zeroParallax),
                    "give another zero_parallax_m");
}

}  // namespace

EyeView makeEyeView(const Pose& head, const Lens& lens) {
    checkLens(lens);
    EyeView view;
    view.eye = view.head = head.position;
    view.right = head.right();
    view.up = head.up();
    view.forward = head.forward();
    view.width = lens.width;
    view.height = lens.height;
    view.nearDepth = lens.nearDepth;
    view.fall = lens.fall;
    const double halfHeight = std::tan(lens.verticalFov / 2);
    const double halfWidth = halfHeight * lens.width * lens.pixelAspect / lens.height;
    view.xMin = -halfWidth;
    view.xMax = halfWidth;
    view.yMin = -halfHeight;
    view.yMax = halfHeight;
    return view;
}

StereoViews makeStereoViews(const Pose& head, const Lens& lens, const StereoSetting& setting) {
    checkSetting(setting);
    StereoViews views;
    const EyeView centre = makeEyeView(head, lens);
    const double half = setting.separation / 2;
    const double skew = half / setting.zeroParallax;
    views.left = views.right = centre;
    views.left.eye -= half * centre.right;
    views.left.xMin += skew;
    views.left.xMax += skew;
    views.right.eye += half * centre.right;
    views.right.xMin -= skew;
    views.right.xMax -= skew;
    views.parallaxScale = setting.separation / centre.pixelWidth();
    views.shiftAtInfinity = views.parallaxScale / setting.zeroParallax;
    return views;
}

}  // namespace stereonav
