// Measures a scene's surface where the user clicks, for the window's list of findings.
#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/progress.h"
#include "engine/camera/pose.h"
#include "engine/scene/slices.h"

namespace stereonav {

struct SurfaceFinding {
    // Data that the scene keeps for a finding.
    struct Own {
        virtual ~Own() = default;
    };

    glm::dvec3 asked{0.0};  // world, metres: where it was searched
    std::string comment;
    bool measured = false;            // the following members are known
    bool found = false;               // false: there is nothing to measure; `note` says why
    std::string note;                 // note on this finding; "": none
    double diameter = 0;              // metres
    std::vector<std::string> lines;   // further figures, short texts
    std::vector<glm::dvec3> outline;  // places in the world on the surface, drawn as points
    std::vector<glm::dvec3> across;   // places along its longest diameter, from end to end
    glm::dvec3 middle{0.0};           // world, metres
    std::optional<Pose> view;         // a pose from which it is visible
    std::shared_ptr<const Own> own;   // never null for findings made by the scene
};
using FindingRefs = std::vector<const SurfaceFinding*>;

// A capability (capabilities.h). All functions may be called from any thread.
class SurfaceFindings {
public:
    virtual ~SurfaceFindings() = default;

    // Returns a finding that is not measured yet; quick.
    virtual SurfaceFinding at(const glm::dvec3& place, const std::string& comment) const = 0;
    // Returns the finding with measurements. study: source of values, null: without values. The first call
    // prepares the measuring, which takes seconds. Throws Error, Cancelled.
    virtual SurfaceFinding measured(const SurfaceFinding& finding,
                                    const std::shared_ptr<const SliceStudy>& study,
                                    Progress& progress) const = 0;
    // Returns places that may be findings, for the user to look at; measured, the most likely first.
    virtual std::vector<SurfaceFinding> candidates(const std::shared_ptr<const SliceStudy>& study,
                                                   Progress& progress) const = 0;

    // Returns a note for each finding of the list that may show the same object as another; "": none.
    virtual std::vector<std::string> notesOn(const FindingRefs& list) const = 0;
    virtual std::string summaryOf(const FindingRefs& list) const = 0;  // one line
    virtual std::string notice() const = 0;                            // one line that belongs to every list
    // Return the document that stores a list, and the list in a document, not measured. name: of the
    // document's file, for messages.
    virtual std::string documentOf(const FindingRefs& list) const = 0;
    virtual std::vector<SurfaceFinding> listOf(const std::string& document,
                                               const std::filesystem::path& name) const = 0;
    // Returns an HTML page of a list. Throws Error, Cancelled.
    virtual std::string pageOf(const FindingRefs& list, const std::shared_ptr<const SliceStudy>& study,
                               Progress& progress) const = 0;
    // Returns why a list can not become a DICOM structured report; "": it can. Quick.
    virtual std::string whyNoReport() const = 0;
    // Returns the bytes of that report's file. Throws Error.
    virtual std::string reportOf(const FindingRefs& list) const = 0;
};

}  // namespace stereonav
