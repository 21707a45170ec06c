// The default's warp, holes left black: what filling is worth.
#include "engine/stereo/warp_method.h"

namespace stereonav {

const WarpMethod kMethodNoFill{.warpRow = warpRowLinear, .after = AfterWarp::Leave, .between = true};

}  // namespace stereonav
