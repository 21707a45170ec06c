#include "terrain/light/light_rows.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/base/parallel.h"
#include "engine/light/skies/spherical_harmonics.h"

namespace stereonav {
namespace {

constexpr int kLookAt = 64;  // samples between two calls of `each`

std::int16_t quantized(float value) {
    return static_cast<std::int16_t>(std::lround(std::clamp(value, -32767.0f, 32767.0f)));
}

bool known(const Heightfield& ground, const glm::ivec2& sample) {
    return std::isfinite(ground.sample(sample.x, sample.y));
}

}  // namespace

void bakeDirectRow(const GroundHorizon& ground, const LightGrid& grid, int row, int azimuths,
                   const SkyTransfer* sky, const DirectRow& to, const std::function<void()>& each) {
    const auto width = static_cast<std::size_t>(grid.width);
    std::vector<std::uint8_t> own(to.horizon ? 0 : width * azimuths);
    std::uint8_t* const horizon = to.horizon ? to.horizon : own.data();
    const std::size_t plane = to.horizon ? to.planeSize : width;
    bakeHorizonRow(ground, grid, row, azimuths, horizon, plane, each);
    SkyWedges wedges(azimuths);
    float direct[kMaxHarmonics];
    for (int i = 0; i < grid.width; ++i) {
        if (i % kLookAt == 0) each();
        const glm::ivec2 sample(grid.column(i), grid.row(row));
        if (!known(ground.ground(), sample)) continue;
        wedges.set(sampleNormal(ground.ground(), sample.x, sample.y), horizon + i, plane);
        to.openness[i] = static_cast<std::uint8_t>(std::lround(255 * wedges.openness()));
        if (!sky) continue;
        sky->direct(wedges, direct);
        for (int k = 0; k < sky->count(); ++k)
            to.transfer[static_cast<std::ptrdiff_t>(i) * sky->count() + k] =
                quantized(direct[k] / static_cast<float>(transferUnit(k)));
    }
}

void bakeBounceRow(const GroundRays& rays, const LightGrid& grid, int row, int azimuths, std::uint64_t number,
                   const SentLight& sent, const GatherSetting& setting, const BounceRow& to,
                   const std::function<void()>& each) {
    SkyWedges wedges(azimuths);
    float bounced[kMaxHarmonics];
    for (int i = 0; i < grid.width; ++i) {
        if (i % kLookAt == 0) each();
        const glm::ivec2 sample(grid.column(i), grid.row(row));
        if (!known(rays.ground(), sample)) continue;
        wedges.set(sampleNormal(rays.ground(), sample.x, sample.y), to.horizon + i, to.planeSize);
        gatherBounce(rays, sample, number + static_cast<std::uint64_t>(i), wedges, sent, setting, bounced);
        const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(i) * setting.count;
        for (int k = 0; k < setting.count; ++k)
            to.total[at + k] = quantized(static_cast<float>(to.direct[at + k]) + bounced[k]);
    }
}

void packTransfer(const TransferField& direct, const TransferField& total, TerrainLight& light) {
    const int count = lightHarmonics(light.settings.order);
    const std::size_t width = static_cast<std::size_t>(light.grid.width), all = light.grid.count();
    light.full.resize(total.size());
    light.bounced.resize(total.size());
    parallelFor(light.grid.height, [&](int j) {
        for (std::size_t s = j * width; s < (j + 1) * width; ++s)
            for (int k = 0; k < count; ++k) {
                const std::size_t from = s * count + k, to = k * all + s;
                light.full[to] = total[from];
                light.bounced[to] = static_cast<std::int16_t>(
                    std::clamp(int{total[from]} - int{direct[from]}, -32767, 32767));
            }
    });
}

}  // namespace stereonav
