#include "engine/scene/surface_paint.h"

#include "engine/base/stopwatch.h"

namespace stereonav {

double paintEye(const Scene& scene, const EyeView& view, EyeImage& image) {
    const auto* const paint = scene.offered<SurfacePaint>();
    if (!paint || paint->empty() || image.color.empty()) return 0;
    const Stopwatch watch;
    paint->paint(view, image);
    return watch.elapsed_ms();
}

void paintEyes(const Scene& scene, const StereoViews& views, EyePair& frame) {
    const double left = paintEye(scene, views.left, frame.left),
                 right = paintEye(scene, views.right, frame.right);
    frame.timings.left_ms += left;
    frame.timings.right_ms += right;
    frame.timings.both_ms += left + right;
}

}  // namespace stereonav
