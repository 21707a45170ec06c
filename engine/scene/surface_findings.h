// What a scene measures where a person clicks on its surface, for the window's list of findings.
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
    std::string note;                 // of this one alone; "": none
    double diameter = 0;              // metres
    std::vector<std::string> lines;   // what else is told of it, short
    std::vector<glm::dvec3> outline;  // world places on the surface, to be drawn as points
    std::vector<glm::dvec3> across;   // the same of its longest diameter, from end to end
    glm::dvec3 middle{0.0};           // world, metres
    std::optional<Pose> view;         // of eyes that see it, where nothing is in the way
    std::shared_ptr<const Own> own;   // never null of one that the scene made
};
using FindingRefs = std::vector<const SurfaceFinding*>;

// A capability (capabilities.h). All of it may be called from any thread.
class SurfaceFindings {
public:
    virtual ~SurfaceFindings() = default;

    // One that is not measured yet; quick.
    virtual SurfaceFinding at(const glm::dvec3& place, const std::string& comment) const = 0;
    // The same, measured. study: whose values are told, null: without. The first call makes what it takes,
    // which takes seconds. Throws Error, Cancelled.
    virtual SurfaceFinding measured(const SurfaceFinding& finding,
                                    const std::shared_ptr<const SliceStudy>& study,
                                    Progress& progress) const = 0;
    // Places that may be findings, for a person to look at; measured, the likeliest first.
    virtual std::vector<SurfaceFinding> candidates(const std::shared_ptr<const SliceStudy>& study,
                                                   Progress& progress) const = 0;

    // A note for each of a list, in which two may be of one thing; "": none.
    virtual std::vector<std::string> notesOn(const FindingRefs& list) const = 0;
    virtual std::string summaryOf(const FindingRefs& list) const = 0;  // one line
    virtual std::string notice() const = 0;                            // one line that goes with all of it
    // The document that keeps a list, and the list of one, not measured. name: of its file, for the Error.
    virtual std::string documentOf(const FindingRefs& list) const = 0;
    virtual std::vector<SurfaceFinding> listOf(const std::string& document,
                                               const std::filesystem::path& name) const = 0;
    // One HTML page of a list. Throws Error, Cancelled.
    virtual std::string pageOf(const FindingRefs& list, const std::shared_ptr<const SliceStudy>& study,
                               Progress& progress) const = 0;
    // Why there can be no DICOM structured report of a list; "": there can. Quick.
    virtual std::string whyNoReport() const = 0;
    // The bytes of that report's file. Throws Error.
    virtual std::string reportOf(const FindingRefs& list) const = 0;
};

}  // namespace stereonav
