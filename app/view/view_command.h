// `stereonav view`, which the program without a command runs too.
#pragma once

#include "app/options/picture_options.h"

namespace stereonav {

int runView(const ViewOptions& options);

}  // namespace stereonav
