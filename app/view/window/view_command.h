// `stereonav view`, which also runs without a command.
#pragma once

#include "app/options/view_options.h"

namespace stereonav {

int runView(const ViewOptions& options);

}  // namespace stereonav
