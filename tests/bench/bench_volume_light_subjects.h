// What the benchmark of volume light looks at: the built-in cloud and wax, and the head of the real data
// where there is any. Surfaces are taken out of the transfer functions, since the path tracer knows none.
#pragma once

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <glm/geometric.hpp>
#include <memory>
#include <string>
#include <vector>

#include "colon/study/study.h"
#include "engine/camera/stereo_rig.h"
#include "engine/medium/model/built_in_media.h"
#include "engine/medium/model/medium.h"
#include "engine/medium/model/medium_look.h"

namespace stereonav::bench {

struct MediumSubject {
    std::string name;
    std::shared_ptr<const GreyVolume> field;
    MediumTransfer transfer;
    Perturbation perturbation;
    MediumLook look;  // lit from the viewer's side
    double time = 0;

    Medium medium() const { return Medium(field, transfer, perturbation); }
};

// The same points with surface 0 and no rule that adds it; `change` may do more.
inline MediumTransfer withoutSurface(const MediumTransfer& transfer,
                                     const std::function<void(MediumMaterial&)>& change = {}) {
    std::vector<MediumPoint> points = transfer.points();
    for (MediumPoint& p : points) {
        p.material.surface = 0;
        if (change) change(p.material);
    }
    return MediumTransfer(points, transfer.referenceLength(), "without surface");
}

// Wax's colour comes from its transport colour alone: its file says that it absorbs nothing. The albedo that
// would give that transport by diffusion, tau_i = tau sqrt(3 (1 - a)), is what the truth is made with.
inline void absorbAsTransported(MediumMaterial& material) {
    const double depth = -std::log1p(-std::min(material.opacity, MediumTransfer::kDensest));
    for (int c = 0; c < 3 && depth > 0; ++c) {
        const double factor = std::min(-std::log(static_cast<double>(material.transport[c])) / depth, 1.0);
        material.color[c] = static_cast<float>(1 - factor * factor / 3);
    }
}

inline std::filesystem::path mediumData() {
    const char* set = std::getenv("STEREONAV_TEST_DATA");
    if (set) return set;
    for (const char* place : {"../shared/data", "../../shared/data", "../../../../shared/data"})
        if (std::filesystem::exists(place)) return place;
    return {};
}

constexpr double kHeading = 0.6, kPitch = -0.3;
inline Pose poseBefore(const Medium& medium) {
    const glm::dvec3 size = medium.bounds().high - medium.bounds().low;
    const Pose there = poseFromAngles(medium.bounds().center(), kHeading, kPitch, 0);
    return poseFromAngles(there.position - 1.6 * glm::length(size) * there.forward(), kHeading, kPitch, 0);
}

inline Lens lensFor(const Medium& medium, int size) {
    Lens lens;
    lens.width = lens.height = size;
    lens.verticalFov = 0.5;
    lens.nearDepth = 1e-3 * glm::length(medium.bounds().high - medium.bounds().low);
    return lens;
}

inline EyeView viewOf(const Medium& medium, int size) {
    return makeEyeView(poseBefore(medium), lensFor(medium, size));
}

inline StereoViews stereoViewsOf(const Medium& medium, int size) {
    StereoSetting setting;
    setting.zeroParallax = 1.6 * glm::length(medium.bounds().high - medium.bounds().low);
    setting.separation = setting.zeroParallax / 30;
    return makeStereoViews(poseBefore(medium), lensFor(medium, size), setting);
}

// The light's way: over the viewer's shoulder, across, or towards the viewer from behind the subject.
struct NamedWay {
    std::string name;
    glm::dvec3 direction;
};
inline std::vector<NamedWay> lightWays() {
    const Pose p = poseFromAngles(glm::dvec3(0.0), kHeading, kPitch, 0);
    return {{"behind the viewer", glm::normalize(p.forward() + 0.5 * p.right() - 0.6 * p.up())},
            {"from behind it", glm::normalize(-p.forward() + 0.3 * p.right() - 0.6 * p.up())}};
}

// Weak, so that less is clipped of what white media send back: a half space up to H(1)^2 / 2 = 4.2 times it.
inline MediumLook lookFrom(const glm::dvec3& direction) {
    MediumLook look;
    look.light.radiance = glm::vec3(0.4f);
    look.light.direction = direction;
    return look;
}

inline MediumSubject cloudSubject() {
    MediumSubject s{"cloud",
                    makeCloudField(),
                    withoutSurface(findMediumTransfer("cloud")),
                    cloudPerturbation(),
                    lookFrom(lightWays()[0].direction),
                    0};
    return s;
}

inline MediumSubject waxSubject() {
    return {"wax",
            makeWaxField(),
            withoutSurface(findMediumTransfer("wax"), absorbAsTransported),
            {},
            lookFrom(lightWays()[0].direction),
            0};
}

// Returns an empty list where there are no real data. Surfaces stay where they are asked for: they cost
// gradients.
inline std::vector<MediumSubject> headSubject(bool surfaces) {
    const auto file = mediumData() / "ct" / "headsq" / "quarter.nhdr";
    if (!std::filesystem::exists(file)) return {};
    Progress progress;
    Study study = readStudy(file, {}, progress);
    const MediumTransfer transfer = findMediumTransfer("head");
    return {{"headsq",
             std::make_shared<GreyVolume>(std::move(study.grey)),
             surfaces ? transfer : withoutSurface(transfer),
             {},
             lookFrom(lightWays()[0].direction),
             0}};
}

inline std::vector<MediumSubject> mediumSubjects() {
    std::vector<MediumSubject> subjects{cloudSubject(), waxSubject()};
    for (MediumSubject& head : headSubject(false)) subjects.push_back(std::move(head));
    return subjects;
}

}  // namespace stereonav::bench
