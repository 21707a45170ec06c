// Polyps of a colon as findings of the window's list.
#pragma once

#include <memory>
#include <mutex>

#include "colon/instruments/finding.h"
#include "colon/scene/colon_scene.h"
#include "engine/scene/surface_findings.h"

namespace stereonav {

// Holds nothing until something is measured.
class ColonFindings final : public SurfaceFindings {
public:
    // A colon, its wall, and what it was read by, which must outlive it.
    ColonFindings(const ColonScene& colon, const SharedWall& wall, const ColonOptions& reading)
        : mColon(colon), mWall(wall), mReading(reading) {}

    SurfaceFinding at(const glm::dvec3& place, const std::string& comment) const override;
    SurfaceFinding measured(const SurfaceFinding& finding, const std::shared_ptr<const SliceStudy>& study,
                            Progress& progress) const override;
    std::vector<SurfaceFinding> candidates(const std::shared_ptr<const SliceStudy>& study,
                                           Progress& progress) const override;
    std::vector<std::string> notesOn(const FindingRefs& list) const override;
    std::string summaryOf(const FindingRefs& list) const override;
    std::string notice() const override;
    std::string documentOf(const FindingRefs& list) const override;
    std::vector<SurfaceFinding> listOf(const std::string& document,
                                       const std::filesystem::path& name) const override;
    std::string pageOf(const FindingRefs& list, const std::shared_ptr<const SliceStudy>& study,
                       Progress& progress) const override;
    std::string whyNoReport() const override;
    std::string reportOf(const FindingRefs& list) const override;

private:
    FindingTool& tool(const std::shared_ptr<const SliceStudy>& study, Progress& progress) const;
    SurfaceFinding shown(Finding finding) const;

    const ColonScene& mColon;
    const SharedWall& mWall;
    const ColonOptions& mReading;
    mutable std::mutex mMutex;  // of what follows, which is made by the first measuring
    mutable std::unique_ptr<FindingTool> mTool;
    mutable std::shared_ptr<const SliceStudy> mStudy;  // that mTool tells values of
};

}  // namespace stereonav
