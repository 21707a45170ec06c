// Integrals of a transfer function over values, for rays that gather all that lies between two values.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/volume/integral_data.h"
#include "engine/volume/transfer_function.h"
#include "engine/volume/volume.h"

namespace stereonav {

// The table that `data` points into.
class TransferIntegrals {
public:
    TransferIntegrals() = default;
    // isovalue: of the surface, in stored numbers of `field`. function: not empty.
    TransferIntegrals(const TransferFunction& function, const GreyVolume& field, double isovalue);
    TransferIntegrals(const TransferIntegrals&) = delete;
    TransferIntegrals& operator=(const TransferIntegrals&) = delete;

    const IntegralData& data() const { return mData; }

private:
    std::vector<std::uint32_t> mTable;
    IntegralData mData;
};

}  // namespace stereonav
