// See the header.
#include "engine/light/paths/path_scene.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <numbers>

#include "engine/math/constants.h"

namespace stereonav {
namespace {

int stepsToFind(int entries) {
    return std::bit_width(static_cast<unsigned>(entries));
}

// Turns chances into running sums from 0 to exactly 1; without any chance all entries are as likely.
void appendSums(const std::vector<double>& chances, std::vector<float>& sums) {
    double total = 0;
    for (const double c : chances) total += c;
    double sum = 0;
    sums.push_back(0);
    for (std::size_t n = 0; n < chances.size(); ++n) {
        sum += chances[n];
        const double even = static_cast<double>(n + 1) / static_cast<double>(chances.size());
        sums.push_back(static_cast<float>(total > 0 ? sum / total : even));
    }
    sums.back() = 1;
}

}  // namespace

const PathKernels& pathKernels(SimdTarget target) {
    return kernelsOf(target, plain::kPathKernels, avx2::kPathKernels, avx512::kPathKernels);
}

double pathUnit(const VolumeFrame& frame) {
    return std::min({frame.spacing.x, frame.spacing.y, frame.spacing.z});
}

PathVolume pathVolume(const GreyVolume& volume) {
    PathVolume v;
    v.values = volume.values.data();
    for (int k = 0; k < 3; ++k) {
        v.size[k] = volume.frame.size[k];
        v.step[k] = static_cast<float>(pathUnit(volume.frame) / volume.frame.spacing[k]);
        for (int n = 0; n < 3; ++n) v.axes[3 * k + n] = static_cast<float>(volume.frame.axes[k][n]);
    }
    return v;
}

void splitPlace(const VolumeFrame& frame, const glm::dvec3& voxel, std::int32_t* cell, float* local) {
    for (int k = 0; k < 3; ++k) {
        cell[k] = static_cast<std::int32_t>(std::clamp(std::floor(voxel[k]), 0.0, frame.size[k] - 2.0));
        local[k] = static_cast<float>(std::clamp(voxel[k] - cell[k], 0.0, 1.0));
    }
}

PathLightTables::PathLightTables(const VolumeFrame& frame, const LightSetup& setup,
                                 const TexelSampling& sampling) {
    for (int k = 0; k < 3; ++k) {
        mLights.sky[k] = setup.sky[k];
        mLights.albedo[k] = setup.albedo[k];
    }
    mLights.bounces = setup.bounces;
    mLights.reach = static_cast<float>(setup.reach / pathUnit(frame));
    mLights.lowDiscrepancy = sampling.lowDiscrepancy && !sampling.naive;
    mLights.cosine = sampling.cosine && !sampling.naive;
    mLights.dim = sampling.roulette && !sampling.naive ? kDim : 0.0f;
    const bool shines = setup.probe && !setup.probe->black();
    mLights.nextEvent = sampling.nextEvent && !sampling.naive && shines;
    if (shines) tabulate(*setup.probe);
    addPoints(frame, setup.lights);
    mLights.oneByChance = choosesLights(setup, sampling);
}

void PathLightTables::tabulate(const LightProbe& probe) {
    const int width = probe.width(), height = probe.height();
    std::vector<double> rows, columns(static_cast<std::size_t>(width));
    for (int j = 0; j < height; ++j) {
        const double upper = std::cos(kPi * j / height), lower = std::cos(kPi * (j + 1) / height);
        const double polar = kPi * (j + 0.5) / height;
        double row = 0;
        for (int i = 0; i < width; ++i) {
            const double azimuth = 2 * kPi * ((i + 0.5) / width - 0.5);
            const LightProbe::Seen seen = probe.seen(glm::vec3(
                std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar)));
            const glm::vec3& c = seen.radiance;
            mPixels.insert(mPixels.end(), {c.x, c.y, c.z, seen.density});
            columns[i] = seen.density;
            row += columns[i] * (upper - lower);
        }
        rows.push_back(row);
        appendSums(columns, mColumns);
        mEdges.push_back(static_cast<float>(upper));
    }
    mEdges.push_back(-1.0f);
    appendSums(rows, mRows);
    mLights.probe = {mPixels.data(), mRows.data(), mColumns.data(),     mEdges.data(),
                     width,          height,       stepsToFind(height), stepsToFind(width)};
}

void PathLightTables::addPoints(const VolumeFrame& frame, const std::vector<PointLight>& points) {
    const double unit = pathUnit(frame);
    for (const PointLight& light : points) {
        if (!(lightWeight(light) > 0)) continue;
        const glm::dvec3 voxel = frame.voxelFromWorld(light.position);
        PathPoint point;
        point.weight = static_cast<float>(lightWeight(light) / (kPi * unit * unit));
        for (int k = 0; k < 3; ++k) {
            point.voxel[k] = static_cast<float>(voxel[k]);
            point.intensity[k] = static_cast<float>(light.intensity[k] / (kPi * unit * unit));
            point.color[k] = point.intensity[k] / point.weight;
        }
        point.radius = static_cast<float>(light.radius / unit);
        mPoints.push_back(point);
    }
    mLights.points = mPoints.data();
    mLights.pointCount = static_cast<std::int32_t>(mPoints.size());
}

}  // namespace stereonav
