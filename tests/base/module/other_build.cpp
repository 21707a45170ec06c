// A module as another build of the program would have left it.
#include "engine/base/module.h"

namespace stereonav {

const ModuleEntry stereonavModule = {"stereonav 0.0.1, compiler 1.0", sizeof(int), nullptr, shareLoopsOf};

}  // namespace stereonav
