// A scene of one's own in stereo: a ball over a floor. The right eye is warped from the left one and compared
// with a full cast. Prints the PSNR, the share of pixels cast again; exit status 1 below 30 dB.
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>

#include "engine/camera/stereo_rig.h"
#include "engine/image/packed_color.h"
#include "engine/render/eye_renderer.h"
#include "engine/stereo/right_eye.h"

using namespace stereonav;

class Ball final : public EyeRenderer {
public:
    int tileCount(const EyeView& view) const override { return view.height; }
    void renderTile(const EyeView& view, int tile, EyeImage& image) const override {
        for (int x = 0; x < view.width; ++x) cast(view, x, tile, image);
    }
    void renderPixels(const EyeView& view, PixelRect, std::span<const PixelIndex> pixels,
                      EyeImage& image) const override {
        for (const PixelIndex p : pixels) cast(view, p.x, p.y, image);
    }
    // Nothing of the scene is nearer than 2 m.
    bool mayHitBeyondEdge(const EyeView&, PixelRect rect, double column,
                          double parallaxScale) const override {
        return column <= rect.x1 || parallaxScale / (column - rect.x1) > 2;
    }

private:
    // The ray's parameter is the view depth.
    void cast(const EyeView& view, int x, int y, EyeImage& image) const {
        const glm::dvec3 d = view.rayDirection(x + 0.5, y + 0.5), o = view.eye - glm::dvec3(0, 0, -6);
        const double a = glm::dot(d, d), b = glm::dot(o, d), root = b * b - a * (glm::dot(o, o) - 1);
        const double ball = root >= 0 ? (-b - std::sqrt(root)) / a : -1.0, floor = (-1 - view.eye.y) / d.y;
        const double depth = ball > 0 ? ball : floor > 0 ? floor : static_cast<double>(kMissDepth);
        const glm::dvec3 wave = glm::sin(2.0 * (view.eye + std::fmin(depth, 1e3) * d));
        image.viewDepth.at(x, y) = static_cast<float>(depth);
        image.color.at(x, y) = packColor(glm::vec3(0.5 + 0.3 * (depth < 40 ? wave : glm::dvec3(0.0))));
    }
};

double psnrOf(const EyeImage& truth, const EyeImage& image) {
    const auto& bytes = srgbByteFromPacked();
    double sum = 0;
    for (int y = 0; y < truth.height(); ++y)
        for (int x = 0; x < truth.width(); ++x)
            for (int channel = 0; channel < 30; channel += 10) {
                const int wanted = bytes[truth.color.at(x, y) >> channel & 1023u];
                sum += std::pow(wanted - bytes[image.color.at(x, y) >> channel & 1023u], 2);
            }
    return 10 * std::log10(255.0 * 255.0 * 3 * truth.width() * truth.height() / sum);
}

int main() {
    const Ball scene;
    const StereoViews views = makeStereoViews(Pose{}, {.width = 320, .height = 240}, {0.065, 6.0});
    EyeImage left, right, truth;
    left.resize(views.left.width, views.left.height);
    renderEye(scene, views.left, left);
    RightEye warp;
    const RightEyeTimings timings = warp.render(scene, views, left, WarpSetting{}, right);
    truth.resize(views.right.width, views.right.height);
    renderEye(scene, views.right, truth);
    const double psnr = psnrOf(truth, right);
    std::printf("PSNR %.1f dB, %.1f %% of the pixels cast again\n", psnr,
                100.0 * static_cast<double>(timings.holePixels) / (320 * 240));
    return psnr >= 30 && timings.holePixels < 320 * 240 / 4 ? 0 : 1;
}
