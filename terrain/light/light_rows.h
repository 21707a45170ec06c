// A row of baked samples: what reaches each of the sky's light, and what the ground around it sends on.
#pragma once

#include <cstdint>
#include <functional>

#include "terrain/light/terrain_transfer.h"

namespace stereonav {

// Where horizons and direct transfer of a row go.
struct DirectRow {
    std::uint8_t* openness;           // a sample each, 255: all; left as it is in holes, as transfer is
    std::uint8_t* horizon = nullptr;  // plane a at horizon[a * planeSize]; null: not kept
    std::size_t planeSize = 0;
    std::int16_t* transfer = nullptr;  // sky->count() values a sample, in steps of transferUnit()
};

// Bakes openness, horizons and direct transfer of a row. sky: null for openness alone. each: called every few
// samples, as a row may take seconds; may throw.
void bakeDirectRow(const GroundHorizon& ground, const LightGrid& grid, int row, int azimuths,
                   const SkyTransfer* sky, const DirectRow& to, const std::function<void()>& each);

// Horizons and direct transfer that a row has, and where all of its transfer goes, another bounce included.
struct BounceRow {
    const std::uint8_t* horizon;
    std::size_t planeSize;
    const std::int16_t* direct;  // setting.count values a sample
    std::int16_t* total;         // the same; left as it is in holes
};

// Bakes a bounce of a row. number: the first sample's, that of the next is one more (gatherBounce()). each:
// as bakeDirectRow()'s.
void bakeBounceRow(const GroundRays& rays, const LightGrid& grid, int row, int azimuths, std::uint64_t number,
                   const SentLight& sent, const GatherSetting& setting, const BounceRow& to,
                   const std::function<void()>& each);

// Sets light.full and light.bounced, in planes, from transfer with and without bounces.
void packTransfer(const TransferField& direct, const TransferField& total, TerrainLight& light);

}  // namespace stereonav
