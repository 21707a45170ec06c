#include "colon/instruments/panorama.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "engine/base/error.h"
#include "engine/base/memory.h"
#include "engine/base/parallel.h"
#include "engine/volume/plain_volume_caster.h"

namespace stereonav {
namespace {

constexpr double kWholeTurn = 2 * std::numbers::pi;
constexpr double kFarthest = 0.2;           // metres that a ray goes
constexpr double kNearLine = 0.09;          // metres of a place from eyes that may see it
constexpr int kRays = 16, kFrameStep = 20;  // rays that the mean radius is taken from; frames between these
constexpr int kLongMark = 10;               // pixels
constexpr int kWidest = 32768;
constexpr int kOneTask = 512;  // vertices

double meanRadius(const UnfoldingLine& line, const LineOfSight& sight) {
    double sum = 0;
    int count = 0;
    for (std::size_t n = 0; n < line.frames().size(); n += kFrameStep) {
        const UnfoldingLine::Frame& frame = line.frames()[n];
        for (int ray = 0; ray < kRays; ++ray) {
            const double turn = kWholeTurn * ray / kRays;
            const double reach = sight.reach(
                frame.place, std::cos(turn) * frame.across + std::sin(turn) * frame.over, kFarthest);
            if (reach > 0 && reach < kFarthest) sum += reach, ++count;
        }
    }
    return count > 0 ? sum / count : 0;
}

double signOf(Panorama::End from) {
    return from == Panorama::End::Rectum ? 1 : -1;
}

}  // namespace

Panorama::Panorama(const GreyVolume& field, const Centreline& line, const LineOfSight& sight, double pixel,
                   Progress& progress)
    : mField(field), mSight(sight), mLine(line, sight), mPixel(pixel) {
    progress.report(0, "drawing the panorama");
    mRadius = meanRadius(mLine, sight);
    const double wide = mLine.length() / pixel + 1, high = kWholeTurn * mRadius / pixel;
    if (!(mRadius > 0))
        throw Error("panorama", "", "expected a line with wall around it", "choose another study");
    if (!(wide < kWidest && high < kWidest))
        throw Error("panorama", "", "the picture would be wider or higher than 32768 pixels",
                    "use larger pixels");
    mWidth = static_cast<int>(wide);
    mHeight = std::max(static_cast<int>(std::lround(high)), 1);
    checkMemory("panorama", 4.0 * mWidth * (2.0 * mHeight + kGap), "use larger pixels");
    progress.report(1, "drawing the panorama");
}

// Returns the eye's place, metres along the line: before what it looks at by the distance at which a wall of
// the mean radius lies in its column.
double Panorama::eyeAt(End from, int x) const {
    return x * mPixel - signOf(from) * mRadius;
}

std::optional<Panorama::Ray> Panorama::rayOf(int x, int y) const {
    if (x < 0 || x >= mWidth || y < 0 || y >= rows() || (y >= mHeight && y < mHeight + kGap))
        return std::nullopt;
    const End end = y < mHeight ? End::Rectum : End::Caecum;
    const double along = eyeAt(end, x);
    if (along < 0 || along > mLine.length()) return std::nullopt;
    const int row = end == End::Rectum ? y : y - mHeight - kGap;
    const double turn = kWholeTurn * (row + 0.5) / mHeight;
    Ray ray{mLine.at(along), {}};
    const glm::dvec3 aside = std::cos(turn) * ray.from.across + std::sin(turn) * ray.from.over;
    ray.way = glm::normalize(aside + signOf(end) * ray.from.tangent);
    return ray;
}

Plane<PackedColor> Panorama::picture(const VolumeLook& look, Progress& progress, const Seen& seen) const {
    Plane<PackedColor> picture(mWidth, rows());
    const PackedColor white = packColor(glm::vec3(1)), black = packColor(glm::vec3(0));
    ProgressSteps columns(progress, mWidth, "drawing the panorama");
    parallelFor(mWidth, [&](int x) {
        if (progress.cancelled()) throw Cancelled();
        for (int y = 0; y < picture.height(); ++y) {
            picture.at(x, y) = white;
            const auto ray = rayOf(x, y);
            if (!ray) continue;
            const glm::dvec3& eye = ray->from.place;
            const glm::dvec3 place = eye + mSight.reach(eye, ray->way, kFarthest) * ray->way,
                             voxel = mField.frame.voxelFromWorld(place);
            const glm::dvec3 inside = glm::clamp(voxel, glm::dvec3(0), glm::dvec3(mField.frame.size - 1));
            picture.at(x, y) = packColor(glm::vec3(
                shadePlain(look, place, plainNormal(mField, inside), eye, eye, glm::dvec3(look.surface))));
            if (seen) seen(x, y, {place, eye});
        }
        const int marks = static_cast<int>(std::floor(x * mPixel / 0.01 + 1e-9));
        const bool isMark = x == 0 || marks != static_cast<int>(std::floor((x - 1) * mPixel / 0.01 + 1e-9));
        const int tall = !isMark ? 1 : marks % 10 == 0 ? kLongMark : kLongMark / 2;
        for (int y = 0; y < tall; ++y) picture.at(x, mHeight + 2 + y) = black;
        columns.done();
    });
    return picture;
}

// The ring of a frame passes through a place that is as far aside of the line as ahead of the frame: where
// the difference of both changes its sign from one frame to the next.
std::optional<double> Panorama::eyeThatSees(End from, const glm::dvec3& place) const {
    const std::vector<UnfoldingLine::Frame>& frames = mLine.frames();
    double before = 0;
    bool known = false;
    for (std::size_t n = 0; n < frames.size(); ++n) {
        const double along = mLine.alongOf(n);
        const glm::dvec3 to = place - frames[n].place;
        if (along < 0 || along > mLine.length() || !(glm::dot(to, to) < kNearLine * kNearLine)) {
            known = false;
            continue;
        }
        const double ahead = glm::dot(to, frames[n].tangent);
        const double aside = std::sqrt(std::max(glm::dot(to, to) - ahead * ahead, 0.0));
        const double off = signOf(from) * ahead - aside;
        if (known && (off >= 0) != (before >= 0)) {
            const double t = before / (before - off);  // their signs differ
            const glm::dvec3 eye = frames[n - 1].place + t * (frames[n].place - frames[n - 1].place);
            if (mSight.clear(eye, place)) return along - (1 - t) * UnfoldingLine::kStep;
        }
        before = off, known = true;
    }
    return std::nullopt;
}

std::array<std::optional<glm::dvec2>, 2> Panorama::pixelsOf(const glm::dvec3& place) const {
    std::array<std::optional<glm::dvec2>, 2> pixels;
    for (const End end : {End::Rectum, End::Caecum}) {
        const auto along = eyeThatSees(end, place);
        if (!along) continue;
        const UnfoldingLine::Frame frame = mLine.at(*along);
        const glm::dvec3 to = place - frame.place;
        const double turn = std::atan2(glm::dot(to, frame.over), glm::dot(to, frame.across));
        const double row = mHeight * (turn < 0 ? turn + kWholeTurn : turn) / kWholeTurn;
        // A column's eye is that of its left border.
        const glm::dvec2 at((*along + signOf(end) * mRadius) / mPixel + 0.5,
                            row + (end == End::Rectum ? 0 : mHeight + kGap));
        if (at.x >= 0 && at.x < mWidth) pixels[static_cast<std::size_t>(end)] = at;
    }
    return pixels;
}

Panorama::Shares Panorama::shares(const WallMesh& wall, Progress& progress) const {
    const int count = static_cast<int>(wall.places.size()), tasks = (count + kOneTask - 1) / kOneTask;
    std::vector<std::uint8_t> seen(wall.places.size(), 0);
    const double lifted = 0.5 * mSight.smallestSpacing();  // lines of sight end before the wall
    ProgressSteps parts(progress, tasks, "looking at the wall from both ends");
    parallelFor(tasks, [&](int task) {
        if (progress.cancelled()) throw Cancelled();
        for (int v = task * kOneTask; v < std::min((task + 1) * kOneTask, count); ++v) {
            const glm::dvec3 place = glm::dvec3(wall.places[v]) + lifted * glm::dvec3(wall.normals[v]);
            seen[v] = static_cast<std::uint8_t>((shows(End::Rectum, place) ? 1 : 0) |
                                                (shows(End::Caecum, place) ? 2 : 0));
        }
        parts.done();
    });
    Shares shares;
    double all = 0;
    for (std::size_t v = 0; v < seen.size(); ++v) {
        const double area = wall.areas[v];
        all += area;
        if (seen[v] & 1) shares.rectum += area;
        if (seen[v] & 2) shares.caecum += area;
        if (seen[v]) shares.either += area;
    }
    if (!(all > 0)) return {};
    shares.rectum /= all, shares.caecum /= all, shares.either /= all;
    return shares;
}

}  // namespace stereonav
