// Heights of a tiled ground at its finest samples, one place at a time: for who stands on it or reads it off.
#pragma once

#include <glm/vec2.hpp>
#include <list>
#include <memory>
#include <mutex>
#include <optional>

#include "terrain/ground/ground_levels.h"

namespace stereonav {

// Keeps the parts that were asked for last. From any thread.
class FineHeights {
public:
    explicit FineHeights(std::shared_ptr<const GroundLevels> levels) : mLevels(std::move(levels)) {}

    // Returns metres; clamped to the border, NaN in holes, as Heightfield::heightAt(). Throws Error where a
    // tile can not be read.
    double heightAt(const glm::dvec2& world) const;
    // Returns samples around a place, which lies at least one from their edge but at the ground's own; null
    // in a hole. Throws as heightAt().
    std::shared_ptr<const Heightfield> around(const glm::dvec2& world) const;

private:
    struct Part {
        glm::ivec2 number{0};
        std::shared_ptr<const Heightfield> ground;  // null: a hole
    };

    std::shared_ptr<const GroundLevels> mLevels;
    mutable std::mutex mMutex;
    mutable std::list<Part> mParts;  // the newest first
};

}  // namespace stereonav
