// A medium and its look in the form that the kernels read. Keeps data that do not change from frame to frame.
#pragma once

#include <vector>

#include "engine/medium/model/medium.h"
#include "engine/medium/model/medium_look.h"
#include "engine/medium/sweep/sweep_geometry.h"
#include "engine/medium/sweep/sweep_kernel_types.h"

namespace stereonav {

class SweepData {
public:
    // Throws Error where a grid has more voxels than a 32-bit number can count.
    explicit SweepData(const Medium& medium);

    // Returns everything that kernels read, except the light's buffers.
    SweepScene sceneFor(const MediumLook& look, const SweepSetting& setting, const SweepGeometry& geometry,
                        double time);
    std::size_t heldBytes() const;

private:
    struct Table {
        std::vector<float> members[12];  // rows of MediumTable's entries
        std::vector<std::uint32_t> surfacePairs, sharePairs;
        SweepTable data;
    };
    static void takeTable(const MediumTable& table, double scale, double offset, Table& to);
    static void takePairs(Table& table);
    void takeLayer(const HeightLayer& layer);
    void setGrid(SweepGrid& grid, const glm::dvec3& anchor) const;
    void setLayers(const glm::dvec3& anchor);
    void setNoise(SweepNoise& noise, const glm::dvec3& anchor, double time) const;
    void setLook(SweepLook& to, const MediumLook& look, const glm::dvec3& anchor);

    const Medium& mMedium;
    double mBase = 0;  // world z that stored heights are relative to
    Table mGridTable;
    bool mNarrow = false;  // differences of values fit 16 bits
    std::vector<Table> mLayerTables;
    std::vector<std::vector<float>> mHeights;  // metres above mBase, by layer
    std::vector<SweepLayer> mLayers;
    std::vector<float> mPhase[3];  // PhaseFunction's entries, by colour
};

SweepEye sweepEye(const RayFan& fan, const SweepGeometry& geometry);

}  // namespace stereonav
