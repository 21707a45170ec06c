// `stereonav play`, which the program without a command runs too.
#pragma once

#include "app/options/picture_options.h"

namespace stereonav {

int runPlay(const PlayOptions& options);

}  // namespace stereonav
