// The reader that needs GDCM, handed on to its module.
#include "colon/study_module.h"

#include "engine/base/module.h"

namespace stereonav {

DecodedPixels decodePicture(const PackedPicture& picture) {
    static const auto& functions = moduleFunctions<StudyFunctions>("gdcm", "to unpack DICOM pictures");
    return functions.decodePicture(picture);
}

}  // namespace stereonav
