// What the module stereonav_gdcm shows the program.
#include "colon/study_module.h"
#include "engine/base/module.h"

namespace stereonav {
namespace {

constexpr StudyFunctions kFunctions = {decodePicture};

}  // namespace

const ModuleEntry stereonavModule = moduleEntry(kFunctions);

}  // namespace stereonav
