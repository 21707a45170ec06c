// Polyps of a colon as findings of the window's list.
#pragma once

#include <memory>
#include <mutex>

#include "colon/instruments/finding.h"
#include "colon/scene/colon_scene.h"
#include "engine/scene/surface_findings.h"

namespace stereonav {

// Measures polyps of a colon; reads and makes nothing before the first measurement.
class ColonFindings final : public SurfaceFindings {
public:
    // The colon, its wall, and the options that it was read with must outlive this object.
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
    mutable std::mutex mMutex;  // guards the members below, which the first measurement makes
    mutable std::unique_ptr<FindingTool> mTool;
    mutable std::shared_ptr<const SliceStudy> mStudy;  // study whose values mTool reports
};

}  // namespace stereonav
