// Pictures of many rays a pixel, which charts hold theirs against: made by all processes of the run.
#pragma once

#include <vector>

#include "app/report/run.h"

namespace stereonav {

struct FineView {
    EyeView view;
    double time = 0;  // seconds, of what moves by itself
};

// As the scene's frames show them, with factor x factor rays in each pixel. scene: of run.scenes().
std::vector<Plane<PackedColor>> finePictures(ReportRun& run, const ReportScene& scene,
                                             const std::vector<FineView>& views, int factor);
// The same of ground in its finest samples and colours, whatever lies in a pixel.
std::vector<Plane<PackedColor>> finestGround(ReportRun& run, const ReportScene& scene,
                                             const std::vector<FineView>& views, int factor);

}  // namespace stereonav
