// No warp: every pixel is cast. What the others are measured against.
#include "engine/stereo/warp_method.h"

namespace stereonav {

const WarpMethod kMethodFull{.translucent = true};

}  // namespace stereonav
