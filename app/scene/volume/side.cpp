// A volume seen from outside: it limits neither light nor eyes nor flight.
#include "app/scene/volume/side.h"

#include <limits>

#include "app/scene/volume/inside.h"
#include "engine/base/error.h"
#include "engine/light/bake/bake_file.h"

namespace stereonav {
namespace {

constexpr double kOutsideSeconds = 10;

class VolumeFromOutside final : public VolumeSide {
public:
    explicit VolumeFromOutside(const ColonScene& volume) : mVolume(volume) {}

    void expectOutside(const char*, const std::string&, const std::string&) const override {}
    std::optional<double> movableIsovalue() const override {
        const GreyVolume& field = mVolume.volume.field;
        return mVolume.volume.cells.isovalue * field.scale + field.offset;
    }

    const MaskVolume* region() const override { return nullptr; }
    std::uint64_t content(Progress&) const override { return contentHash(mVolume.volume.field); }

    bool letsLightIn() const override { return true; }
    void checkLight(const BakeOptions&, BakeKind) const override {}
    void checkLazyLight(bool, bool) const override {}
    void addLine(const std::optional<double>&, const char* option, LightSetup&) const override {
        throw Error(option, "", "expected a colon for lights along the centreline, this volume is none",
                    "give their places as x,y,z");
    }
    void addUsualLight(const char*, LightSetup& setup, std::vector<std::string>& notes) const override {
        setup.sky = glm::vec3(1);
        notes.push_back("lit by a white sky all around");
    }
    double usualReach(std::vector<std::string>&) const override { return 0; }

    double largestSeparation() const override { return std::numeric_limits<double>::infinity(); }
    bool narrows() const override { return false; }
    double crossingSeconds() const override { return kOutsideSeconds; }
    void check(const RecordedPath&, const std::string&) const override {}  // any path goes around the volume

private:
    const ColonScene& mVolume;
};

}  // namespace

std::unique_ptr<const VolumeSide> sideOf(const ColonScene& volume) {
    if (volume.isColon()) return std::make_unique<ColonInterior>(volume);
    return std::make_unique<VolumeFromOutside>(volume);
}

}  // namespace stereonav
