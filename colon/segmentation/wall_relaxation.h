// Takes the stairs out of a ready mask's wall: its crossings move along their lines until outlines in all
// planes of voxel centres bend evenly.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "colon/segmentation/wall_crossings.h"
#include "engine/base/progress.h"

namespace stereonav {

struct WallRelaxation {
    int rounds = 30;       // times that every crossing moves; >= 0
    double share = 0.15;   // part of the mean bends renewed in a round; less averages more crossings; (0, 1]
    double margin = 0.04;  // share of their line that crossings keep from both voxel centres; (0, 0.5)
};

// Moves `wall.at` and returns the wall's normals there: unit vectors along the grid's axes, outwards.
// Outlines keep their mean bend over some crossings, so curved walls stay where they are; then the wall moves
// as a whole, by a small part of a voxel, until lines along the three axes have as much inside as they had.
// spacing: of voxels, in any unit. On all threads; their number changes nothing. Throws Cancelled.
std::vector<glm::vec3> relaxWall(WallCrossings& wall, const CrossingLinks& links, const glm::dvec3& spacing,
                                 const WallRelaxation& setting, Progress& progress);

}  // namespace stereonav
