// The interface of the module stereonav_metrics to the program.
#include "engine/base/module.h"
#include "engine/metrics/metrics_module.h"

namespace stereonav {
namespace {

constexpr MetricsFunctions kFunctions = {differenceOf, psnrOf, edgeMask, differenceTimes, chartPicture};

}  // namespace

const ModuleEntry stereonavModule = moduleEntry(kFunctions);

}  // namespace stereonav
