// Findings as words and as files: a table, a document that is read back, a page with pictures, a DICOM
// report.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "colon/instruments/finding.h"
#include "colon/scene/colon_scene.h"
#include "engine/scene/facts.h"

namespace stereonav {

// "flat", "sessile", "pedunculated"
const char* nameOf(PolypShape shape);
// "axial", "coronal", "sagittal" of MeasuredPolyp::sliceAxis
const char* nameOfSlice(int axis);

// One finding for a JSON document; number: from 1.
Facts factsOf(const Finding& finding, std::size_t number);
// "C-RADS C2 by size and count alone", of what a person kept; or that nobody has.
std::string cradsWords(const std::vector<Finding>& findings);
// A line for people.
std::string lineOf(const Finding& finding, std::size_t number);
std::string csvOf(const std::vector<Finding>& findings);

// A place and what was said of it.
struct KeptFinding {
    glm::dvec3 place{0.0};  // world, metres
    std::string comment;
    bool candidate = false;  // nobody has kept it
};
// The findings of a document that writeFindings wrote; none where there is no such file. Throws Error where
// it is another, or has more than kMostFindings.
std::vector<KeptFinding> readFindings(const std::filesystem::path& file);
// The document itself, and what it keeps. file: its name, for the Error where it is another.
std::string findingsDocument(const std::string& study, const std::vector<Finding>& findings);
std::vector<KeptFinding> findingsIn(const std::string& document, const std::filesystem::path& file);
// Whole or not at all, over an earlier one too. Throws Error.
void writeFindings(const std::filesystem::path& file, const std::string& study,
                   const std::vector<Finding>& findings);

// One HTML file with all of its pictures: each finding from two sides, and in a slice of the study, unless
// that is empty. Throws Cancelled.
std::string findingsPage(const ColonScene& colon, const GreyVolume& study,
                         const std::vector<Finding>& findings, Progress& progress);

// The bytes of a DICOM structured report (colon/study/structured_report.h). reading: the study that they are
// of. Reads heads of its files. Throws Error.
std::string findingsReport(const ColonOptions& reading, const std::vector<Finding>& findings);

}  // namespace stereonav
