#include "app/scene/volume/studio.h"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <memory>

#include "engine/base/memory.h"
#include "engine/light/occlusion/sky_sweep.h"

namespace stereonav {
namespace {

// Light on white, linear RGB. Cool from above, warm from below and from the key light, all near grey, so that
// colours of a transfer function stay what they are. Most that a face in the open sends is 1.05 of its
// colour.
constexpr glm::vec3 kSky{0.22f, 0.24f, 0.28f}, kGround{0.105f, 0.096f, 0.086f}, kKey{0.83f, 0.79f, 0.71f};
constexpr float kLamp = 0.2f, kLampDeep = 0.15f;
// From the viewer's first place: to the right, up, back to the viewer.
constexpr glm::dvec3 kKeyFrom{-0.8, 0.62, 0.3}, kUp{0, 1, 0.35};
// Part of the object's size within which it hides the sky from itself.
constexpr double kReach = 0.6;

// Returns whether no option says what lights the volume.
bool lightIsChosen(const SceneOptions& options, const ColonScene& scene) {
    const bool said = options.light.given() || options.volume.ambient_mm ||
                      options.volume.shading != Shading::Lamp || options.given.has("shading");
    return options.chosenLook && !said && !scene.isColon();
}

bool showsTheSame(const VolumeScene& a, const VolumeScene& b) {
    return a.cells.isovalue == b.cells.isovalue && a.look.transfer == b.look.transfer &&
           a.look.modulation == b.look.modulation;
}

}  // namespace

void applyStudio(const SceneOptions& options, const ColonScene* before, ColonScene& scene,
                 Progress& progress) {
    StudioLook& look = scene.volume.look.studio;
    if (!lightIsChosen(options, scene)) {
        look = {};
        return;
    }
    if (before && before->volume.look.studio.seen && showsTheSame(before->volume, scene.volume)) {
        look = before->volume.look.studio;
        return;
    }
    const double bytes = skySweepWorking(scene.volume.field.frame);
    if (availableMemoryFor(bytes) < bytes) {
        look = {};
        if (!before)
            scene.notes.push_back("lit by the lamp alone: light from a sky takes " + memoryText(bytes) +
                                  " more memory than there is");
        return;
    }
    const glm::dmat3 head(glm::mat3_cast(scene.startPose.orientation));
    look.sky = kSky;
    look.ground = kGround;
    look.key = kKey;
    look.lamp = kLamp;
    look.lampDeep = kLampDeep;
    look.up = glm::normalize(head * kUp);
    look.keyFrom = glm::normalize(head * kKeyFrom);
    SkySweepSetting setting;
    setting.keyFrom = look.keyFrom;
    setting.reach = kReach * scene.extent;
    look.seen = std::make_shared<const SkyGrid>(sweepSky(scene.volume, setting, progress));
}

}  // namespace stereonav
