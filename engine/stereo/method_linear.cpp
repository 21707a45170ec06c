// Inverse resampling between neighbouring survivors, two taps.
#include "engine/stereo/warp_method.h"

namespace stereonav {

const WarpMethod kMethodLinear{.warpRow = warpRowLinear, .between = true, .translucent = true};

}  // namespace stereonav
