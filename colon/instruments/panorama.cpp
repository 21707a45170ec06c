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
constexpr double kFarthest = 0.2;         // metres that a ray goes
constexpr double kNearLine = 0.09;        // metres of a place from eyes that may see it
constexpr int kRays = 16, kEvery = 20;    // that the mean radius is taken from; frames between them
constexpr int kGap = 14, kLongMark = 10;  // pixels between the strips, of a long mark
constexpr int kWidest = 32768;
constexpr int kOneTask = 512;  // vertices

double meanRadius(const UnfoldingLine& line, const LineOfSight& sight) {
    double sum = 0;
    int count = 0;
    for (std::size_t n = 0; n < line.frames().size(); n += kEvery) {
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
}

// So far before what it looks at that a wall of the mean radius lies in its column.
double Panorama::eyeAt(End from, int x) const {
    return x * mPixel - signOf(from) * mRadius;
}

Plane<PackedColor> Panorama::picture(const VolumeLook& look, Progress& progress) const {
    Plane<PackedColor> picture(mWidth, 2 * mHeight + kGap);
    const PackedColor white = packColor(glm::vec3(1)), black = packColor(glm::vec3(0));
    parallelFor(mWidth, [&](int x) {
        if (x % 64 == 0) progress.report(0.5, "drawing the panorama");
        if (progress.cancelled()) throw Cancelled();
        for (int y = 0; y < picture.height(); ++y) picture.at(x, y) = white;
        for (const End from : {End::Rectum, End::Caecum}) {
            const double along = eyeAt(from, x);
            if (along < 0 || along > mLine.length()) continue;
            const UnfoldingLine::Frame frame = mLine.at(along);
            const int top = from == End::Rectum ? 0 : mHeight + kGap;
            for (int y = 0; y < mHeight; ++y) {
                const double turn = kWholeTurn * (y + 0.5) / mHeight;
                const glm::dvec3 aside = std::cos(turn) * frame.across + std::sin(turn) * frame.over;
                const glm::dvec3 way = glm::normalize(aside + signOf(from) * frame.tangent);
                const double reach = mSight.reach(frame.place, way, kFarthest);
                const glm::dvec3 place = frame.place + reach * way,
                                 voxel = mField.frame.voxelFromWorld(place);
                const glm::dvec3 inside = glm::clamp(voxel, glm::dvec3(0), glm::dvec3(mField.frame.size - 1));
                picture.at(x, top + y) =
                    packColor(glm::vec3(shadePlain(look, place, plainNormal(mField, inside), frame.place,
                                                   frame.place, glm::dvec3(look.surface))));
            }
        }
        const int marks = static_cast<int>(std::floor(x * mPixel / 0.01 + 1e-9));
        const bool isMark = x == 0 || marks != static_cast<int>(std::floor((x - 1) * mPixel / 0.01 + 1e-9));
        const int tall = !isMark ? 1 : marks % 10 == 0 ? kLongMark : kLongMark / 2;
        for (int y = 0; y < tall; ++y) picture.at(x, mHeight + 2 + y) = black;
    });
    return picture;
}

// The ring of a frame passes through a place that is as far aside of the line as ahead of the frame: where
// the difference of both changes its sign from one frame to the next.
bool Panorama::shows(End from, const glm::dvec3& place) const {
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
            if (mSight.clear(eye, place)) return true;
        }
        before = off, known = true;
    }
    return false;
}

Panorama::Shares Panorama::shares(const WallMesh& wall, Progress& progress) const {
    const int count = static_cast<int>(wall.places.size()), tasks = (count + kOneTask - 1) / kOneTask;
    std::vector<std::uint8_t> seen(wall.places.size(), 0);
    const double lifted = 0.5 * mSight.smallestSpacing();  // lines of sight end before the wall
    parallelFor(tasks, [&](int task) {
        if (task % 64 == 0) progress.report(0.7, "looking at the wall from both ends");
        if (progress.cancelled()) throw Cancelled();
        for (int v = task * kOneTask; v < std::min((task + 1) * kOneTask, count); ++v) {
            const glm::dvec3 place = glm::dvec3(wall.places[v]) + lifted * glm::dvec3(wall.normals[v]);
            seen[v] = static_cast<std::uint8_t>((shows(End::Rectum, place) ? 1 : 0) |
                                                (shows(End::Caecum, place) ? 2 : 0));
        }
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
