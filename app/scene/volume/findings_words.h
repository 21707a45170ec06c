// Findings as text and as files: a table, a document that can be read back, a page with pictures, a DICOM
// report.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "colon/instruments/finding.h"
#include "colon/scene/colon_scene.h"
#include "engine/scene/facts.h"

namespace stereonav {

// Returns "flat", "sessile" or "pedunculated".
const char* nameOf(PolypShape shape);
// Returns "axial", "coronal" or "sagittal" for MeasuredPolyp::sliceAxis.
const char* nameOfSlice(int axis);

// Returns a finding for a JSON document; number: from 1.
Facts factsOf(const Finding& finding, std::size_t number);
// Returns "C-RADS C2 by size and count alone" for the findings that a person kept, or that nobody kept any.
std::string cradsWords(const std::vector<Finding>& findings);
// Returns one line of text for a finding.
std::string lineOf(const Finding& finding, std::size_t number);
std::string csvOf(const std::vector<Finding>& findings);

// A place of the document, with its comment.
struct KeptFinding {
    glm::dvec3 place{0.0};  // world, metres
    std::string comment;
    bool candidate = false;  // true: no person has kept it
};
// Reads a document that writeFindings wrote; returns none where there is no such file. Throws Error for
// another kind of file, and for more than kMostFindings.
std::vector<KeptFinding> readFindings(const std::filesystem::path& file);
// Writes and reads the document as text. file: its name in errors about a document of another kind.
std::string findingsDocument(const std::string& study, const std::vector<Finding>& findings);
std::vector<KeptFinding> findingsIn(const std::string& document, const std::filesystem::path& file);
// Writes the document completely or not at all; replaces an earlier one. Throws Error.
void writeFindings(const std::filesystem::path& file, const std::string& study,
                   const std::vector<Finding>& findings);

// Returns one HTML file with all pictures: each finding from two sides, and in a slice of the study unless
// `study` is empty. Throws Cancelled.
std::string findingsPage(const ColonScene& colon, const GreyVolume& study,
                         const std::vector<Finding>& findings, Progress& progress);

// Returns the bytes of a DICOM structured report (colon/study/structured_report.h). reading: the study of the
// findings; the headers of its files are read. Throws Error.
std::string findingsReport(const ColonOptions& reading, const std::vector<Finding>& findings);

}  // namespace stereonav
