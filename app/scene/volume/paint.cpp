#include "app/scene/volume/paint.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/options/paint_words.h"
#include "app/scene/volume/flights.h"
#include "colon/instruments/coverage.h"
#include "colon/instruments/shared_wall.h"
#include "colon/instruments/wall_painter.h"
#include "engine/base/error.h"

namespace stereonav {
namespace {

constexpr double kIntoLumen = 1.5;  // smallest spacings from the wall at which fluid is looked for
constexpr double kDry = -200;       // HU: larger values in the lumen are fluid

// Returns 1 for each vertex that the flight did not show, 0 for others.
std::vector<float> unseenOf(const VolumeWorld& world, const ColonInterior& inside, const JoinedWall& wall,
                            const std::string& which, double verticalFov, Progress& progress) {
    const ColonScene& colon = world.colon();
    const auto freeDistance = [&](const glm::dvec3& place, double upTo) {
        return colon.freeDistanceAt(place, upTo);
    };
    const bool both = which == kPaintBothWays;
    const ColonFlights flights = colonFlights(colon, both ? "" : which, kFlightStep, freeDistance, inside);
    const LineOfSight sight(colon.volume.field, colon.volume.cells, colon.lumen.isovalue);
    CoverageSetting setting;
    setting.verticalFov = verticalFov;
    Coverage coverage(wall.mesh, wall.neighbours, sight, setting);
    Progress there(progress, 0, both ? 0.5 : 1), back(progress, 0.5, 1);
    coverage.look(flights.there, there);
    if (both) coverage.look(flights.back, back);
    return unseenMarks(coverage.seen());
}

// Returns 1 for each vertex where the study has more than air just before the wall, in the present lumen.
std::vector<float> fluidOf(const ColonScene& colon, const WallMesh& wall) {
    if (colon.study.empty())
        throw Error("--fluid tinted", "", "a mask tells nothing of fluid",
                    "name the study that it was made from, or leave it out");
    const VolumeFrame &before = colon.study.frame, &now = colon.volume.field.frame;
    const double step = kIntoLumen * std::min({now.spacing.x, now.spacing.y, now.spacing.z});
    std::vector<float> marks(wall.places.size(), 0.0f);
    for (std::size_t v = 0; v < marks.size(); ++v) {
        const glm::dvec3 place = glm::dvec3(wall.places[v]) + step * glm::dvec3(wall.normals[v]);
        const glm::ivec3 lumen(glm::round(now.voxelFromWorld(place))),
            study(glm::round(before.voxelFromWorld(place)));
        if (!now.contains(lumen) || !before.contains(study) || colon.lumen.lumen.at(lumen) == 0) continue;
        const double value = colon.study.at(study) * colon.study.scale + colon.study.offset;
        marks[v] = value > kDry ? 1.0f : 0.0f;
    }
    return marks;
}

double percentOf(const WallMesh& wall, const std::vector<float>& marks) {
    double marked = 0, all = 0;
    for (std::size_t v = 0; v < marks.size(); ++v) {
        all += wall.areas[v];
        marked += marks[v] * wall.areas[v];
    }
    return all > 0 ? 100 * marked / all : 0;
}

}  // namespace

bool paintNeedsStudy(const SceneOptions& options) {
    return options.volume.fluid == FluidChoice::Tinted;
}

std::vector<std::shared_ptr<const EyePainter>> wallPainters(VolumeWorld& world, const SceneOptions& options,
                                                            double verticalFov, Progress& progress) {
    const bool fluid = options.volume.fluid == FluidChoice::Tinted;
    if (options.paint.empty() && !fluid) return {};
    ColonScene& colon = world.colon();
    const ColonInterior* const inside = world.side().interior();
    if (!inside)
        throw Error(fluid ? "--fluid" : "--paint", "", "expected a colon, whose wall is painted",
                    "leave it out");
    Progress joining(progress, 0, 0.3), looking(progress, 0.3, 1);
    const std::shared_ptr<const JoinedWall> joined = world.wall().get(joining);
    const WallMesh& wall = joined->mesh;
    std::vector<std::shared_ptr<const EyePainter>> painters;
    if (fluid) {
        const std::vector<float> marks = fluidOf(colon, wall);
        colon.notes.push_back(
            fmt::format("{:.1f} % of the wall was under tagged fluid: it is tinted green, and is to be "
                        "checked in the slices",
                        percentOf(wall, marks)));
        painters.push_back(
            wallPainter(wall, joined->neighbours, colon.volume.field.frame, marks, kFluidTint));
    }
    if (!options.paint.empty()) {
        const std::vector<float> marks =
            unseenOf(world, *inside, *joined, paintAskedOf(options.paint).rest, verticalFov, looking);
        colon.notes.push_back(
            fmt::format("{:.1f} % of the wall is not seen: it is tinted blue", percentOf(wall, marks)));
        painters.push_back(
            wallPainter(wall, joined->neighbours, colon.volume.field.frame, marks, kUnseenTint));
    }
    progress.report(1, "looking at the wall");
    return painters;
}

}  // namespace stereonav
