#include "terrain/ground/ground_rings.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>
#include <optional>
#include <utility>

namespace stereonav {
namespace {

constexpr int kBlock = GroundLevels::kBlock;

// A span of the ground's own samples, both ends within.
struct Span {
    glm::ivec2 low{0}, high{0};
    void add(const Span& other) {
        low = glm::min(low, other.low);
        high = glm::max(high, other.high);
    }
    bool operator==(const Span&) const = default;
};

class Planner {
public:
    Planner(const GroundLevels& levels, const RingWish& wish) : mLevels(levels), mWish(wish) {
        const glm::dvec3 other = wish.other.value_or(wish.eye),
                         low = glm::min(wish.eye, other) + glm::min(wish.way, glm::dvec3(0.0)),
                         high = glm::max(wish.eye, other) + glm::max(wish.way, glm::dvec3(0.0));
        mEye = levels.gridFromWorld(glm::dvec2(low));
        mWay = glm::dvec2(high - low) / levels.spacing(0);
        mOver = std::max({0.0, low.z - levels.maxHeight(), wish.sinks ? 0.0 : levels.minHeight() - high.z});
    }

    // Blocks of that level that must be finer; none where all may be of it.
    std::optional<Span> tooCoarse(int level) const {
        std::optional<Span> all;
        glm::ivec2 low, end;
        if (!blocksWithin(level, low, end)) return all;
        for (int j = low.y; j < end.y; ++j)
            for (int i = low.x; i < end.x; ++i) {
                const Span block = spanOf(level, i, j);
                if (mLevels.errorBound(level, i, j) <= mWish.share * mWish.pixelAngle * distanceTo(block))
                    continue;
                all ? all->add(block) : void(all = block);
            }
        return all;
    }

    Span below() const {
        const glm::dvec2 most(mLevels.size(0) - 2);
        const glm::ivec2 a(glm::clamp(glm::floor(mEye), glm::dvec2(0), most)),
            b(glm::clamp(glm::floor(mEye + mWay), glm::dvec2(0), most));
        return {glm::min(a, b), glm::max(a, b) + 1};
    }

private:
    // Finds the blocks, low to end - 1, so near that the level's largest bound is too much for them. Returns
    // false where there are none.
    bool blocksWithin(int level, glm::ivec2& low, glm::ivec2& end) const {
        const double reach = mLevels.errorBound(level) / (mWish.share * mWish.pixelAngle);
        if (!(reach > mOver)) return false;
        const glm::dvec2 block = double(kBlock) * mLevels.spacing(level),
                         eye = mEye * mLevels.spacing(0) / block, way = mWay * mLevels.spacing(0) / block,
                         aside = reach / block + 1.0, blocks(mLevels.blocks(level));
        const glm::dvec2 first = glm::min(eye, eye + way) - aside, last = glm::max(eye, eye + way) + aside;
        low = glm::ivec2(glm::clamp(glm::floor(first), glm::dvec2(0), blocks));
        end = glm::ivec2(glm::clamp(glm::ceil(last), glm::dvec2(0), blocks));
        return low.x < end.x && low.y < end.y;
    }
    Span spanOf(int level, int i, int j) const {
        const glm::ivec2 low = kBlock * glm::ivec2(i, j), last = mLevels.size(level) - 1;
        return {low * (1 << level), glm::min(low + kBlock, last) * (1 << level)};
    }
    // Metres at least, to anything of the ground within it, from the box around the way.
    double distanceTo(const Span& block) const {
        const glm::dvec2 end = mEye + mWay;
        const glm::dvec2 aside = glm::max(glm::dvec2(block.low) - glm::max(mEye, end),
                                          glm::min(mEye, end) - glm::dvec2(block.high));
        const glm::dvec2 metres = glm::max(aside, glm::dvec2(0)) * mLevels.spacing(0);
        return std::hypot(metres.x, metres.y, mOver);
    }

    const GroundLevels& mLevels;
    const RingWish& mWish;
    glm::dvec2 mEye, mWay;  // grid of the ground: a corner of the box around all eyes, and its size
    double mOver = 0;       // metres from the eyes' heights to the nearest of the ground's
};

// Returns a box around the span, in steps of several blocks: a box stays the same for a while as the eye
// moves.
RingBox boxAround(const GroundLevels& levels, int level, const Span& span) {
    constexpr int kStep = 4 * kBlock;
    const int cell = kStep << level;
    const glm::ivec2 last = levels.size(level) - 1;
    const glm::ivec2 low = span.low / cell * kStep;
    const glm::ivec2 high = glm::min((span.high + cell - 1) / cell * kStep, last);
    return {level, low, high - low + 1};
}

RingBox wholeOf(const GroundLevels& levels, int level) {
    return {level, glm::ivec2(0), levels.size(level)};
}

Span spanOf(const RingBox& box) {
    return {box.low * (1 << box.level), (box.low + box.size - 1) * (1 << box.level)};
}

}  // namespace

std::vector<RingBox> planRings(const GroundLevels& levels, const RingWish& asked) {
    const int last = levels.count() - 1;
    if (!(asked.share > 0 && asked.pixelAngle > 0)) return {wholeOf(levels, 0)};
    RingWish wish = asked;
    const auto overGround = [&](const glm::dvec3& way) {
        return levels.contains(glm::dvec2(wish.eye + way)) &&
               levels.contains(glm::dvec2(wish.other.value_or(wish.eye) + way));
    };
    if (!overGround(wish.way)) wish.way = glm::dvec3(0.0);
    const Planner planner(levels, wish);
    if (!overGround(glm::dvec3(0.0))) {
        for (int level = last; level > 0; --level)
            if (!planner.tooCoarse(level)) return {wholeOf(levels, level)};
        return {wholeOf(levels, 0)};
    }
    std::vector<RingBox> boxes;
    for (int level = 0; level < last; ++level) {
        std::optional<Span> span = planner.tooCoarse(level + 1);
        if (!span && boxes.empty()) continue;  // nothing needs this level
        if (span) span->add(planner.below());
        if (!boxes.empty()) span ? span->add(spanOf(boxes.back())) : void(span = spanOf(boxes.back()));
        const RingBox box = boxAround(levels, level, *span);
        if (box == wholeOf(levels, level)) {
            boxes.push_back(box);
            return boxes;
        }
        const bool wider =
            boxes.empty() || span->low != spanOf(boxes.back()).low || span->high != spanOf(boxes.back()).high;
        if (wider) boxes.push_back(box);
    }
    boxes.push_back(wholeOf(levels, last));
    return boxes;
}

bool coverRings(const std::vector<RingBox>& boxes, const std::vector<RingBox>& needed) {
    return std::all_of(needed.begin(), needed.end(), [&](const RingBox& wanted) {
        const Span span = spanOf(wanted);
        return std::any_of(boxes.begin(), boxes.end(), [&](const RingBox& box) {
            const Span has = spanOf(box);
            return box.level <= wanted.level && glm::all(glm::lessThanEqual(has.low, span.low)) &&
                   glm::all(glm::greaterThanEqual(has.high, span.high));
        });
    });
}

std::vector<RingBox> ringsAround(const GroundLevels& levels, const std::vector<RingBox>& boxes,
                                 const glm::dvec3& eye) {
    const glm::dvec2 at = levels.gridFromWorld(glm::dvec2(eye));
    std::vector<RingBox> around;
    for (const RingBox& box : boxes) {
        const Span span = spanOf(box);
        const bool within = glm::all(glm::lessThanEqual(glm::dvec2(span.low), at)) &&
                            glm::all(glm::lessThanEqual(at, glm::dvec2(span.high)));
        if (within || &box == &boxes.back()) around.push_back(box);
    }
    return around;
}

std::shared_ptr<const GroundRings> makeRings(const GroundLevels& levels, const std::vector<RingBox>& boxes,
                                             const GroundRings* before) {
    auto made = std::make_shared<GroundRings>();
    for (const RingBox& box : boxes) {
        std::shared_ptr<const GroundRing> ring;
        if (before)
            for (const auto& kept : before->rings)
                if (kept->box == box) ring = kept;
        if (!ring) {
            std::optional<Heightfield> part = levels.part(box.level, box.low, box.size);
            if (!part) continue;  // a hole, which the levels above have too
            auto fresh = std::make_shared<GroundRing>();
            fresh->box = box;
            fresh->ground = std::move(*part);
            fresh->maxima = HeightPyramid(fresh->ground);
            ring = std::move(fresh);
        }
        made->steepest = std::max(made->steepest, ring->ground.maxSlope());
        made->errorBound = std::max(made->errorBound, levels.errorBound(box.level));
        made->rings.push_back(std::move(ring));
    }
    return made;
}

}  // namespace stereonav
