// The report's charts of normals: those stored at corners of cells against the gradient at each place, and
// surfaces of media shaded at coarser places.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "app/report/run.h"
#include "app/report/subjects.h"
#include "app/report/trial.h"
#include "app/report/whole_medium.h"
#include "engine/base/parallel.h"
#include "engine/medium/model/built_in_media.h"
#include "engine/medium/sweep/medium_scene.h"
#include "engine/medium/sweep/medium_sweep.h"
#include "engine/volume/plain_volume_caster.h"

namespace stereonav {
namespace {

using NormalAt = std::function<glm::dvec3(const glm::dvec3& voxel)>;

glm::dvec3 unit(const glm::dvec3& gradient) {
    const double length = glm::length(gradient);
    return length > 0 ? -gradient / length : glm::dvec3(0, 0, 1);
}

// Returns places where rays along i, j and k meet the surface.
std::vector<glm::dvec3> placesOf(ReportRun& run, const GreyVolume& volume) {
    std::vector<glm::dvec3> places;
    for (const glm::ivec3& cell :
         surfaceVoxels(volume, kBlockSurface, static_cast<std::size_t>(run.pick(2000, 20000))))
        for (int axis = 0; axis < 3; ++axis) {
            glm::dvec3 low = glm::dvec3(cell) + 0.37, high = low;
            low[axis] = cell[axis], high[axis] = cell[axis] + 1.0;
            const double a = plainValue(volume, low) - kBlockSurface,
                         b = plainValue(volume, high) - kBlockSurface;
            if (a * b >= 0) continue;  // trilinear values are linear along an axis
            low[axis] += a / (a - b);
            places.push_back(low);
        }
    return places;
}

// Returns the gradient of the trilinear function, by differences over half a voxel to both sides.
glm::dvec3 trilinearGradient(const GreyVolume& volume, const glm::dvec3& voxel) {
    glm::dvec3 gradient;
    for (int axis = 0; axis < 3; ++axis) {
        glm::dvec3 step(0.0);
        step[axis] = 0.5;
        gradient[axis] = plainValue(volume, voxel + step) - plainValue(volume, voxel - step);
    }
    return volume.frame.axes * (gradient / volume.frame.spacing);
}

}  // namespace

WayChart normalsChart(ReportRun& run) {
    const GreyVolume volume = blockWithHoles();
    const std::vector<glm::dvec3> places = placesOf(run, volume);
    std::vector<glm::dvec3> truth(places.size());
    for (std::size_t n = 0; n < places.size(); ++n) truth[n] = unit(smoothGradient(volume, places[n]));
    // Normals at the cells' corners, packed as the kernels store them.
    Progress quiet;
    const auto surface = static_cast<float>(kBlockSurface);
    const SurfaceCells cells = findSurfaceCells(volume, {surface, surface, surface, nullptr}, quiet);
    const auto ofCorners = [&](const glm::dvec3& voxel, bool nearest) {
        const glm::ivec3 cell = glm::ivec3(voxel);
        const std::optional<CellRecord> record = cells.record(cell);
        if (!record) return glm::dvec3(0, 0, 1);
        const glm::dvec3 f = voxel - glm::dvec3(cell);
        if (nearest) {
            const int corner = (f.x >= 0.5) + 2 * (f.y >= 0.5) + 4 * (f.z >= 0.5);
            return glm::normalize(unpackCornerNormal(record->normals[corner]));
        }
        glm::dvec3 sum(0.0);
        for (int n = 0; n < 8; ++n)
            sum += (n & 1 ? f.x : 1 - f.x) * (n & 2 ? f.y : 1 - f.y) * (n & 4 ? f.z : 1 - f.z) *
                   unpackCornerNormal(record->normals[n]);
        return glm::normalize(sum);
    };
    WayChart chart;
    chart.id = "casting/normals";
    chart.title = "Normals at corners";
    chart.setting = fmt::format("{} places", places.size());
    chart.text =
        "Normals where rays meet a made block with three holes, in plain code on one thread: the smoothed "
        "gradient (Wyman et al. 2006, section 4) at the place itself, over 64 voxels, against normals that "
        "are kept at the corners of cells, and the trilinear function's own gradient.";
    chart.timeLabel = "ns a normal";
    chart.timeUnit = "ns";
    chart.errorLabel = "RMS error, degrees";
    chart.errorUnit = "degrees";
    const auto add = [&](const char* name, const char* detail, bool isDefault, const NormalAt& normalAt) {
        std::vector<double> ns;
        std::vector<glm::dvec3> normals(places.size());
        for (int repeat = 0; repeat < run.pick(3, 7); ++repeat) {
            run.tell("normals");
            const Stopwatch watch;
            for (std::size_t n = 0; n < places.size(); ++n) normals[n] = normalAt(places[n]);
            ns.push_back(1e6 * watch.elapsed_ms() /
                         static_cast<double>(std::max<std::size_t>(places.size(), 1)));
        }
        WayPoint point;
        double squares = 0;
        for (std::size_t n = 0; n < places.size(); ++n) {
            // The chord is accurate for small angles, unlike the cosine.
            const double chord = std::min(glm::length(normals[n] - truth[n]), 2.0);
            const double degrees = glm::degrees(2 * std::asin(0.5 * chord));
            squares += degrees * degrees;
            point.worstError = std::max(point.worstError, degrees);
        }
        point.way = {name, spreadOf(ns),
                     std::sqrt(squares / static_cast<double>(std::max<std::size_t>(places.size(), 1))),
                     isDefault};
        point.detail = detail;
        chart.points.push_back(std::move(point));
    };
    add("corners", "of a cell's eight corners, trilinear between them", true,
        [&](const glm::dvec3& voxel) { return ofCorners(voxel, false); });
    add("nearest corner", "not mixed", false,
        [&](const glm::dvec3& voxel) { return ofCorners(voxel, true); });
    add("at the place", "the smoothed gradient itself", false,
        [&](const glm::dvec3& voxel) { return unit(smoothGradient(volume, voxel)); });
    add("trilinear gradient", "not smoothed", false,
        [&](const glm::dvec3& voxel) { return unit(trilinearGradient(volume, voxel)); });
    return chart;
}

WayChart shadingWidthChart(ReportRun& run) {
    const auto field = makeWaxField();
    const Medium medium(field, allSurface(findMediumTransfer("wax")));
    const int size = run.pick(64, 256);
    const WholeMedium whole = wholeMedium(medium, size);
    const EyeView view = makeEyeView(whole.pose, whole.lens);
    MediumLook look;
    look.light.direction = whole.light;
    MediumSweep sweep(medium);
    const auto shaded = [&](double width, MediumPicture& picture) {
        run.tell("shading width");
        SweepSetting setting;
        setting.shadingWidth = width;
        const Stopwatch watch;
        sweep.render(look, setting, {&view, 1}, view.head, 0, {&picture, 1});
        return watch.elapsed_ms();
    };
    MediumPicture picture;
    shaded(0, picture);
    const Plane<PackedColor> truth = shown(picture.light);
    WayChart chart;
    chart.id = "medium/wax/shading width";
    chart.title = "Shading width";
    chart.setting = run.settingOf(size, size);
    chart.text =
        "The block of wax with its surfaces, shaded at places up to so many voxels apart and between them "
        "(--shading-width), against shading at each sample (0).";
    chart.timeLabel = "ms a picture";
    const std::vector<double> widths =
        run.brief() ? std::vector<double>{0, 1, 4} : std::vector<double>{0, 0.25, 0.5, 1, 2, 4, 8};
    std::vector<std::vector<double>> ms(widths.size());
    std::vector<double> errors(widths.size());
    for (int repeat = 0; repeat < run.pick(3, 9); ++repeat)
        for (std::size_t n = 0; n < widths.size(); ++n) {
            ms[n].push_back(shaded(widths[n], picture));
            if (repeat == 0) errors[n] = rmsOf(truth, shown(picture.light));
        }
    for (std::size_t n = 0; n < widths.size(); ++n)
        chart.points.push_back(
            {{fmt::format("{:g}", widths[n]), spreadOf(ms[n]), errors[n],
              widths[n] == SweepSetting{}.shadingWidth},
             widths[n] == 0 ? "at each sample" : fmt::format("up to {:g} voxels apart", widths[n]),
             errors[n]});
    return chart;
}

}  // namespace stereonav
