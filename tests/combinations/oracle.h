// What an eye sees, worked out in double precision ray by ray or slice by slice, with nothing shared with
// kernels but the data, and never packed.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/scene/scene_loading.h"
#include "tests/combinations/judging.h"

namespace stereonav::test {

struct OraclePicture {
    int width = 0, height = 0;
    std::vector<glm::dvec3> light;  // linear RGB, the background in it; row by row
    const glm::dvec3& at(int x, int y) const { return light[static_cast<std::size_t>(y) * width + x]; }
};

// Casts by plain casters; none for terrains, media and light that is traced. view: one of the scene's eyes.
std::optional<OraclePicture> castByOracle(const Scene& scene, const EyeView& view);

// Sweeps by the plain sweep, a picture for each eye; none where rays are cast. Eyes are swept together.
std::vector<OraclePicture> sweptByOracle(const Scene& scene, const std::vector<EyeView>& eyes);

// Returns the picture in the form of an eye's. Colours that are no numbers are named in `problem`.
EyeImage packed(const OraclePicture& oracle, std::string& problem);

}  // namespace stereonav::test
