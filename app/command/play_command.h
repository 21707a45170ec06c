// `stereonav play`, which also runs without a command.
#pragma once

#include "app/options/picture_options.h"

namespace stereonav {

int runPlay(const PlayOptions& options);

}  // namespace stereonav
