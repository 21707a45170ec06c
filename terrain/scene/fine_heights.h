// Heights of a tiled ground from its finest samples, one place at a time, for instruments and for walking on
// it.
#pragma once

#include <glm/vec2.hpp>
#include <list>
#include <memory>
#include <mutex>
#include <optional>

#include "terrain/ground/ground_levels.h"

namespace stereonav {

// Keeps the parts that were used last. From any thread.
class FineHeights {
public:
    explicit FineHeights(std::shared_ptr<const GroundLevels> levels) : mLevels(std::move(levels)) {}

    // Returns the height in metres, like Heightfield::heightAt(): clamped to the border, NaN in holes. Throws
    // Error where a tile can not be read.
    double heightAt(const glm::dvec2& world) const;
    // Returns samples around a place, at least one on each side of it except at the ground's border; null in
    // a hole. Throws as heightAt().
    std::shared_ptr<const Heightfield> around(const glm::dvec2& world) const;

private:
    struct Part {
        glm::ivec2 number{0};
        std::shared_ptr<const Heightfield> ground;  // null: a hole
    };

    std::shared_ptr<const GroundLevels> mLevels;
    mutable std::mutex mMutex;
    mutable std::list<Part> mParts;  // most recently used first
};

}  // namespace stereonav
