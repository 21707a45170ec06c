// The inside of a colon: a closed wall, and a line along it.
#pragma once

#include "app/scene/volume/side.h"
#include "engine/scene/capabilities.h"

namespace stereonav {

class ColonInterior final : public VolumeSide, public LineThrough {
public:
    // The colon must outlive this object.
    explicit ColonInterior(const ColonScene& colon);

    const Centreline& centreline() const { return mColon.centreline; }
    std::size_t segments() const { return mColon.lumen.segments.size(); }  // pieces of the lumen

    void expectOutside(const char* option, const std::string& problem,
                       const std::string& advice) const override;
    std::optional<double> movableIsovalue() const override { return std::nullopt; }

    const MaskVolume* region() const override { return &mColon.lumen.lumen; }
    std::uint64_t content(Progress& progress) const override;

    bool letsLightIn() const override { return false; }
    void checkLight(const BakeOptions& options, BakeKind kind) const override;
    void checkLazyLight(bool transfer, bool sky) const override;
    void addLine(const std::optional<double>& spacing, const char* option, LightSetup& setup) const override;
    void addUsualLight(const char* option, LightSetup& setup, std::vector<std::string>& notes) const override;
    double usualReach(std::vector<std::string>& notes) const override;

    double largestSeparation() const override;
    bool narrows() const override { return true; }
    double crossingSeconds() const override;
    void check(const RecordedPath& path, const std::string& file) const override;

    const ColonInterior* interior() const override { return this; }
    PlaceOnLine placeOnLine(const glm::dvec3& world) const override;
    // Returns the centreline as seen by a person who faces the patient: the patient's left is on the right.
    const LineOnMap& lineOnMap() const { return mLine; }

private:
    double meanRadius() const;  // mean radius of the lumen in metres

    const ColonScene& mColon;
    LineOnMap mLine;
};

}  // namespace stereonav
