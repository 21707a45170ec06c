// The context that tests and benches draw in.
#pragma once

#include "engine/display/offscreen_context.h"

namespace stereonav {

using EglContext = OffscreenContext;

}  // namespace stereonav
