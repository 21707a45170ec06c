// The readers of study_parts.h that need ITK or GDCM, handed on to their module.
#include "colon/study_module.h"

#include "engine/base/module.h"

namespace stereonav {
namespace {

const StudyFunctions& itk() {
    static const auto& functions = moduleFunctions<StudyFunctions>("itk", "to read CT studies");
    return functions;
}

}  // namespace

VolumeFile readVolumeFile(const std::filesystem::path& file, const StudyOptions& options,
                          Progress& progress) {
    return itk().readVolumeFile(file, options, progress);
}

std::vector<DicomSeries> scanFolder(const std::filesystem::path& folder) {
    return itk().scanFolder(folder);
}

DicomSeries chooseSeries(const std::filesystem::path& folder, const std::string& wanted) {
    return itk().chooseSeries(folder, wanted);
}

VolumeFile readDicom(const std::filesystem::path& folder, const StudyOptions& options, Progress& progress) {
    return itk().readDicom(folder, options, progress);
}

}  // namespace stereonav
