// Folders of DICOM slices: which files may be slices, what lies below the root of a disc, and which folders
// below another one hold some. Shared among colon/study/*.cpp only.
#pragma once

#include <filesystem>
#include <vector>

#include "colon/study/study.h"

namespace stereonav {

// Returns whether a file may be a DICOM slice by its name. They are called anything: with .dcm or .ima,
// without an extension, or by a UID, whose last part looks like one.
bool isSliceName(const std::filesystem::path& file);
// Returns whether a file is a slice by its name, or by what it begins with.
bool isDicomFile(const std::filesystem::path& file);

// Returns the folder that is meant: that of a DICOMDIR where one is named, else the place itself.
std::filesystem::path folderOfStudy(const std::filesystem::path& place);
// Returns whether a DICOMDIR lies in the folder, which makes it the root of a disc.
bool isRootOfDisc(const std::filesystem::path& folder);

// Returns the files in a folder, without hidden ones and a DICOMDIR, sorted; the place itself where it is a
// file. Throws Error.
std::vector<std::filesystem::path> filesIn(const std::filesystem::path& place);
// Returns those in its folders too. Throws Error where there are too many.
std::vector<std::filesystem::path> filesBelow(const std::filesystem::path& folder);

}  // namespace stereonav
