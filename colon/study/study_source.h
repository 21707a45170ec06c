// The source that a report on a study has to name: whose study it is, and which pictures it was read from.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "colon/study/study.h"

namespace stereonav {

// The source of a DICOM series, as its first slice has it; "" where that says nothing. Texts are in
// `characters`.
struct StudySource {
    std::string characters;  // specific character set (0008,0005)
    std::string patientName, patientId, birthDate, sex;
    std::string study, studyDate, studyTime, studyId, accession, referring, studyDescription;
    std::string series;  // UIDs, as `study`
    std::string frame;   // UID of the frame of reference; "" where slices are of several, too
    std::vector<std::pair<std::string, std::string>> pictures;  // SOP class and instance, by file
};

// Reads the source from heads of files alone. Returns nothing where the study is not DICOM. Throws Error.
std::optional<StudySource> sourceOf(const std::filesystem::path& path, const StudyOptions& options);

}  // namespace stereonav
