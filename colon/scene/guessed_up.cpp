#include "colon/scene/guessed_up.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "engine/volume/seen_blocks.h"

namespace stereonav {
namespace {

constexpr int kMostSamples = 64;                     // along each axis
constexpr double kBoneFrom = 250, kBodyFrom = -300;  // HU
constexpr double kBrainFrom = -20, kBrainTo = 120;   // HU
constexpr double kLungFrom = -970, kLungTo = -400;   // HU

// The voxel axis that leads along an axis of the world, and whether it leads the other way.
struct Along {
    int axis = 2;
    bool back = false;
};
Along alongOf(const VolumeFrame& frame, int world) {
    Along along;
    for (int axis = 0; axis < 3; ++axis)
        if (std::abs(frame.axes[axis][world]) > std::abs(frame.axes[along.axis][world])) along.axis = axis;
    along.back = frame.axes[along.axis][world] < 0;
    return along;
}

// Samples of a slice across z, as coarse as they are taken.
class CoarseSlice {
public:
    CoarseSlice(int width, int height)
        : mWidth(width), mHeight(height), mValues(std::size_t(width) * height) {}
    float& at(int i, int j) { return mValues[static_cast<std::size_t>(j) * mWidth + i]; }

    // Counts samples in a range that have samples of a wall, from `wall` on, on all four sides.
    int enclosed(double low, double high, double wall) {
        constexpr int kNone = -1;
        std::vector<int> first(mWidth, mHeight), last(mWidth, kNone);
        for (int j = 0; j < mHeight; ++j)
            for (int i = 0; i < mWidth; ++i)
                if (at(i, j) >= wall) {
                    first[i] = std::min(first[i], j);
                    last[i] = j;
                }
        int count = 0;
        for (int j = 0; j < mHeight; ++j) {
            int from = mWidth, to = kNone;
            for (int i = 0; i < mWidth; ++i)
                if (at(i, j) >= wall) {
                    from = std::min(from, i);
                    to = i;
                }
            for (int i = from + 1; i < to; ++i)
                count += at(i, j) >= low && at(i, j) <= high && j > first[i] && j < last[i];
        }
        return count;
    }
    int from(double wall) const {
        return static_cast<int>(std::ranges::count_if(mValues, [&](float v) { return v >= wall; }));
    }

private:
    int mWidth, mHeight;
    std::vector<float> mValues;  // HU
};

// Sums over slices, with their heights in 0..1.
struct Heights {
    double sum = 0, count = 0;
    void add(double height, double n) {
        sum += height * n;
        count += n;
    }
    double mean() const { return count > 0 ? sum / count : 0.5; }
};

// Where along z, upwards, a body has its head and its lungs.
struct BodyParts {
    Heights body, brain, lungs;
};
BodyParts bodyParts(const GreyVolume& grey, double water) {
    const Along z = alongOf(grey.frame, 2);
    const glm::ivec3 size = grey.frame.size;
    const glm::ivec3 step = (size + kMostSamples - 1) / kMostSamples, samples = (size + step - 1) / step;
    const int a = (z.axis + 1) % 3, b = (z.axis + 2) % 3;
    BodyParts parts;
    CoarseSlice slice(samples[a], samples[b]);
    for (int layer = 0; layer < samples[z.axis]; ++layer) {
        glm::ivec3 voxel(0);
        voxel[z.axis] = layer * step[z.axis];
        for (int j = 0; j < samples[b]; ++j)
            for (int i = 0; i < samples[a]; ++i) {
                voxel[a] = i * step[a];
                voxel[b] = j * step[b];
                slice.at(i, j) = static_cast<float>(grey.at(voxel) * grey.scale + grey.offset - water);
            }
        const double height = (layer + 0.5) / samples[z.axis], up = z.back ? 1 - height : height;
        const double body = slice.from(kBodyFrom);
        const double brain = slice.enclosed(kBrainFrom, kBrainTo, kBoneFrom);
        const double lungs = slice.enclosed(kLungFrom, kLungTo, kBodyFrom);
        parts.body.add(up, body);
        // Around a pelvis there is as much flesh as inside it, around a skull there is little.
        if (brain > 0.5 * body) parts.brain.add(up, brain);
        if (lungs > 0.2 * body) parts.lungs.add(up, lungs);
    }
    return parts;
}

GuessedUp guessOfBody(const GreyVolume& grey, double water) {
    constexpr double kLeastShare = 0.05, kLeastApart = 0.05;
    const BodyParts parts = bodyParts(grey, water);
    const auto guess = [&](const Heights& part, const char* why) -> GuessedUp {
        const double apart = part.mean() - parts.body.mean();
        if (part.count < kLeastShare * parts.body.count || std::abs(apart) < kLeastApart) return {};
        return {UpAxis{2, apart < 0}, why};
    };
    const GuessedUp head = guess(parts.brain, "a skull is there");
    return head.up ? head : guess(parts.lungs, "lungs are there");
}

// How an object would stand with an end of an axis down.
struct Stand {
    double base = 0, top = 0;  // share of its columns that end at the lower end, and at the upper one
    double weight = 0.5;       // height of what is seen, in 0..1
    double score() const { return base - top; }
};
// Returns that for each axis of voxels, standing on its first blocks.
Stand standOn(const SeenBlocks& blocks, int axis) {
    constexpr double kFlat = 0.04;  // share of the height
    const int a = (axis + 1) % 3, b = (axis + 2) % 3, height = blocks.size[axis];
    int lowest = height, highest = -1;
    std::vector<std::array<int, 2>> columns;
    double sum = 0, all = 0;
    for (int j = 0; j < blocks.size[b]; ++j)
        for (int i = 0; i < blocks.size[a]; ++i) {
            std::array<int, 2> ends{height, -1};
            for (int k = 0; k < height; ++k) {
                glm::ivec3 at(0);
                at[axis] = k;
                at[a] = i;
                at[b] = j;
                const double voxels = blocks.at(at);
                if (voxels == 0) continue;
                ends = {std::min(ends[0], k), k};
                sum += voxels * k;
                all += voxels;
            }
            if (ends[1] < 0) continue;
            lowest = std::min(lowest, ends[0]);
            highest = std::max(highest, ends[1]);
            columns.push_back(ends);
        }
    if (columns.empty() || highest == lowest) return {};
    const double flat = kFlat * (highest - lowest);
    Stand stand;
    for (const std::array<int, 2>& ends : columns) {
        stand.base += ends[0] - lowest <= flat;
        stand.top += highest - ends[1] <= flat;
    }
    stand.base /= static_cast<double>(columns.size());
    stand.top /= static_cast<double>(columns.size());
    stand.weight = (sum / all - lowest) / (highest - lowest);
    return stand;
}

GuessedUp guessOfObject(const SeenBlocks& blocks) {
    constexpr double kLeast = 0.3;   // by which another axis has to be better than z
    std::array<double, 6> scores{};  // for up along x, -x, y, -y, z, -z
    for (int world = 0; world < 3; ++world) {
        const Along along = alongOf(blocks.frame, world);
        const Stand stand = standOn(blocks, along.axis);
        const int forth = 2 * world + (along.back ? 1 : 0), back = 2 * world + (along.back ? 0 : 1);
        scores[forth] = stand.weight <= 0.5 ? stand.score() : 0;
        scores[back] = stand.weight >= 0.5 ? -stand.score() : 0;
    }
    const int best = static_cast<int>(std::ranges::max_element(scores) - scores.begin());
    constexpr int kAsItIs = 4;
    if (best == kAsItIs || scores[best] < std::max(scores[kAsItIs], 0.0) + kLeast) return {};
    return {UpAxis{best / 2, best % 2 == 1}, "it has a flat base at the other end"};
}

}  // namespace

GuessedUp guessUp(const GreyVolume& grey, const ValueKinds& kinds, double stored) {
    if (grey.empty()) return {};
    if (kinds.hounsfield || kinds.shifted) return guessOfBody(grey, kinds.shifted ? kWaterOfShifted : 0);
    SeenBlocks blocks = seenBlocks(grey, seenFrom(stored));
    dropCrumbs(blocks);
    return guessOfObject(blocks);
}

}  // namespace stereonav
