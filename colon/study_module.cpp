// The readers of study_parts.h that need GDCM, handed on to their module.
#include "colon/study_module.h"

#include "engine/base/module.h"

namespace stereonav {
namespace {

const StudyFunctions& gdcmReaders() {
    static const auto& functions = moduleFunctions<StudyFunctions>("gdcm", "to read DICOM files");
    return functions;
}

}  // namespace

std::vector<DicomSeries> scanFolder(const std::filesystem::path& folder) {
    return gdcmReaders().scanFolder(folder);
}

DicomSeries chooseSeries(const std::filesystem::path& folder, const std::string& wanted) {
    return gdcmReaders().chooseSeries(folder, wanted);
}

VolumeFile readDicom(const std::filesystem::path& folder, const StudyOptions& options, Progress& progress) {
    return gdcmReaders().readDicom(folder, options, progress);
}

}  // namespace stereonav
