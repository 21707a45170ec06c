// Painters of a scene's surfaces, for pictures that are shown or written. Comparisons and reports are made
// without paint, which would be the same for every way of making a frame.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "engine/render/eye_painter.h"
#include "engine/scene/scene.h"

namespace stereonav {

// A capability (capabilities.h). Changed by the thread that makes frames, or before it starts.
class SurfacePaint {
public:
    // Sets the painters, which are applied in this order.
    void set(std::vector<std::shared_ptr<const EyePainter>> painters) { mPainters = std::move(painters); }
    void add(std::shared_ptr<const EyePainter> painter) { mPainters.push_back(std::move(painter)); }
    const std::vector<std::shared_ptr<const EyePainter>>& painters() const { return mPainters; }
    // Sets a painter that is applied after all others, during flight; null: none.
    void setOver(std::shared_ptr<const EyePainter> painter) { mOver = std::move(painter); }
    bool empty() const { return mPainters.empty() && !mOver; }
    void paint(const EyeView& view, EyeImage& image) const {
        for (const auto& painter : mPainters) painter->paint(view, image);
        if (mOver) mOver->paint(view, image);
    }

private:
    std::vector<std::shared_ptr<const EyePainter>> mPainters;
    std::shared_ptr<const EyePainter> mOver;
};

// Paints an eye's picture as the scene's capabilities require. Returns the time in ms; 0 where there is no
// paint.
double paintEye(const Scene& scene, const EyeView& view, EyeImage& image);

// Paints both eyes; the time is added to that of the frame.
void paintEyes(const Scene& scene, const StereoViews& views, EyePair& frame);

}  // namespace stereonav
