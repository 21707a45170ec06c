// Measures a scene's surface where a person clicks, for the window's list of findings.
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
    // The scene's own form of it.
    struct Own {
        virtual ~Own() = default;
    };

    glm::dvec3 asked{0.0};  // world, metres: where it was looked for
    std::string comment;
    bool measured = false;            // what follows is known
    bool found = false;               // there is something: else `note` says why not
    std::string note;                 // note on this one alone; "": none
    double diameter = 0;              // metres
    std::vector<std::string> lines;   // what else is told of it, short
    std::vector<glm::dvec3> outline;  // world places on the surface, to be drawn as points
    std::vector<glm::dvec3> across;   // places along its longest diameter, from end to end
    glm::dvec3 middle{0.0};           // world, metres
    std::optional<Pose> view;         // pose of eyes that see it, where nothing is in the way
    std::shared_ptr<const Own> own;   // never null of one that the scene made
};
using FindingRefs = std::vector<const SurfaceFinding*>;

// A capability (capabilities.h). All of it may be called from any thread.
class SurfaceFindings {
public:
    virtual ~SurfaceFindings() = default;

    // Returns a finding that is not measured yet; quick.
    virtual SurfaceFinding at(const glm::dvec3& place, const std::string& comment) const = 0;
    // Returns the finding, measured. study: whose values are told, null: without. The first call prepares the
    // measuring, which takes seconds. Throws Error, Cancelled.
    virtual SurfaceFinding measured(const SurfaceFinding& finding,
                                    const std::shared_ptr<const SliceStudy>& study,
                                    Progress& progress) const = 0;
    // Places that may be findings, for a person to look at; measured, the likeliest first.
    virtual std::vector<SurfaceFinding> candidates(const std::shared_ptr<const SliceStudy>& study,
                                                   Progress& progress) const = 0;

    // Returns a note for each finding of the list, where two may be one thing; "": none.
    virtual std::vector<std::string> notesOn(const FindingRefs& list) const = 0;
    virtual std::string summaryOf(const FindingRefs& list) const = 0;  // one line
    virtual std::string notice() const = 0;                            // one line that goes with all of it
    // Return the document that stores a list; and the list that a document stores, not measured. name: of the
    // document's file, for the Error.
    virtual std::string documentOf(const FindingRefs& list) const = 0;
    virtual std::vector<SurfaceFinding> listOf(const std::string& document,
                                               const std::filesystem::path& name) const = 0;
    // Returns an HTML page of a list. Throws Error, Cancelled.
    virtual std::string pageOf(const FindingRefs& list, const std::shared_ptr<const SliceStudy>& study,
                               Progress& progress) const = 0;
    // Returns why there can be no DICOM structured report of a list; "": there can. Quick.
    virtual std::string whyNoReport() const = 0;
    // Returns the bytes of that report's file. Throws Error.
    virtual std::string reportOf(const FindingRefs& list) const = 0;
};

}  // namespace stereonav
