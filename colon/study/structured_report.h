// A report of measured findings as a DICOM structured report: Comprehensive 3D SR (PS3.3 A.35.13) with the
// content of template TID 1500, "Imaging Measurement Report" (PS3.16).
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "colon/study/study_source.h"

namespace stereonav {

using MmPlace = std::array<double, 3>;  // to the patient's left, back and head, millimetres

// Figures that are not finite numbers are left out.
struct ReportedFinding {
    std::string label;  // "1"
    std::string uid;    // tracking UID: the same in every report
    bool polyp = true;  // measured as a polyp; else a place where none was found
    MmPlace place_mm{};
    double fromRectum_mm = 0;
    std::optional<double> longest_mm, inSlice_mm, volume_mm3, huMean, huSigma;  // the last two in HU
    std::optional<std::array<MmPlace, 2>> longestEnds_mm;
    std::string segment;  // segment of the colon, as colonSegmentAt() names it; "": not told
    std::string note;     // "": none
};

// All that the report holds.
struct StructuredReport {
    std::optional<StudySource> source;     // none: of a study that is not DICOM, whose patient is unknown
    std::string study;                     // UID, where the source has none
    std::string series, document, device;  // UIDs: the report's own series, its own, the program's
    std::string software;                  // name and version
    std::string date, time;                // when the report was made: "20261125", "134500"
    std::string notice;                    // notice at the top of the report
    int crads = 0;                         // C-RADS class by size and count alone, 1 to 4
    std::vector<ReportedFinding> findings;
};

// Returns the bytes of a DICOM file. Loads DCMTK. Throws Error.
std::string structuredReportFile(const StructuredReport& report);

}  // namespace stereonav
