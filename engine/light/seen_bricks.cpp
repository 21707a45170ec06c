// Counts pixels by brick. A texel to either side of a pixel's cell belongs to what its neighbours look up.
#include "engine/light/seen_bricks.h"

#include <algorithm>
#include <glm/common.hpp>
#include <utility>

namespace stereonav {

std::vector<std::uint32_t> bricksSeen(const EyeView& view, const EyeImage& image,
                                      const IlluminationVolume& light, int every) {
    const glm::ivec3 last = light.frame.size - 1, bricks = light.layout.bricks;
    std::vector<int> pixels(static_cast<std::size_t>(bricks.x) * bricks.y * bricks.z);
    const auto count = [&](const glm::dvec3& texel) {
        const glm::ivec3 cell(glm::floor(texel));
        const glm::ivec3 low = glm::clamp(cell - 1, glm::ivec3(0), last) / 8;
        const glm::ivec3 high = glm::clamp(cell + 2, glm::ivec3(0), last) / 8;
        for (int k = low.z; k <= high.z; ++k)
            for (int j = low.y; j <= high.y; ++j)
                for (int i = low.x; i <= high.x; ++i)
                    ++pixels[(static_cast<std::size_t>(k) * bricks.y + j) * bricks.x + i];
    };
    for (int y = every / 2; y < image.height(); y += every)
        for (int x = every / 2; x < image.width(); x += every) {
            const double depth = image.viewDepth.at(x, y);
            if (depth > 0 && depth < kMissDepth)
                count(light.frame.voxelFromWorld(view.eye + depth * view.rayDirection(x + 0.5, y + 0.5)));
        }
    std::vector<std::pair<int, std::uint32_t>> sorted;
    for (std::size_t n = 0; n < pixels.size(); ++n)
        if (pixels[n] > 0) sorted.emplace_back(-pixels[n], static_cast<std::uint32_t>(n));
    std::sort(sorted.begin(), sorted.end());
    std::vector<std::uint32_t> numbers;
    for (const auto& [seen, number] : sorted) numbers.push_back(number);
    return numbers;
}

}  // namespace stereonav
