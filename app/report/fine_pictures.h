// Pictures of many rays per pixel, the references of charts: made by all processes of the run.
#pragma once

#include <vector>

#include "app/report/run.h"

namespace stereonav {

struct FineView {
    EyeView view;
    double time = 0;  // seconds, for moving parts of the scene
};

// Returns the pictures as the scene's frames show them, with factor x factor rays in each pixel. scene: of
// run.scenes().
std::vector<Plane<PackedColor>> finePictures(ReportRun& run, const ReportScene& scene,
                                             const std::vector<FineView>& views, int factor);
// Returns pictures of ground in its finest samples and colours, independent of the size of a pixel.
std::vector<Plane<PackedColor>> finestGround(ReportRun& run, const ReportScene& scene,
                                             const std::vector<FineView>& views, int factor);

}  // namespace stereonav
