#include "colon/instruments/coverage.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <numbers>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "engine/peers/piece_dealer.h"

namespace stereonav {
namespace {

constexpr std::uint32_t kChunk = 256;  // vertices
constexpr double kLift = 0.5;  // share of the smallest spacing: how far off the wall lines of sight end
constexpr std::size_t kPiecesEach = 8;    // for each of several processes, where there are so many chunks
constexpr std::size_t kMostInPiece = 64;  // chunks
constexpr const char* kLooking = "looking at the wall";
constexpr double kFarthestView = 0.02;  // metres from a patch to the eye that looks at it

void check(const CoverageSetting& setting) {
    const auto refuseUnless = [](bool holds, const char* what, const char* expected) {
        if (!holds) throw Error("coverage", what, expected, "correct it");
    };
    refuseUnless(setting.verticalFov > 0 && setting.verticalFov < std::numbers::pi, "field of view",
                 "expected more than 0 and less than 180 degrees");
    refuseUnless(setting.aspect > 0 && std::isfinite(setting.aspect), "aspect", "expected more than 0");
    refuseUnless(setting.within > 0, "distance", "expected more than 0");
    refuseUnless(setting.angle > 0 && setting.angle <= 0.5 * std::numbers::pi, "angle",
                 "expected more than 0 and at most 90 degrees");
    refuseUnless(setting.smallestPatch >= 0, "patch", "expected 0 or more");
}

// Looks from `eye` at `target`, as upright as it can be.
Pose lookingAt(const glm::dvec3& eye, const glm::dvec3& target) {
    const glm::dvec3 way = glm::normalize(target - eye);
    return poseFromAngles(eye, std::atan2(way.x, way.y), std::asin(std::clamp(way.z, -1.0, 1.0)), 0);
}

}  // namespace

Coverage::Coverage(const WallMesh& mesh, const WallNeighbours& neighbours, const LineOfSight& sight,
                   const CoverageSetting& setting)
    : mMesh(mesh), mNeighbours(neighbours), mSight(sight), mSetting(setting), mSeen(mesh.places.size(), 0) {
    check(setting);
    makeChunks();
}

void Coverage::makeChunks() {
    const auto count = static_cast<std::uint32_t>(mMesh.places.size());
    for (std::uint32_t from = 0; from < count; from += kChunk) {
        Chunk chunk{from, std::min(from + kChunk, count), glm::vec3(0), 0};
        glm::vec3 low(std::numeric_limits<float>::max()), high(-low);
        for (std::uint32_t v = chunk.from; v < chunk.to; ++v) {
            low = glm::min(low, mMesh.places[v]);
            high = glm::max(high, mMesh.places[v]);
        }
        chunk.middle = 0.5f * (low + high);
        chunk.radius = 0.5f * glm::length(high - low);
        mChunks.push_back(chunk);
    }
}

EyeView Coverage::viewFrom(const Pose& pose) const {
    EyeView view;
    view.eye = view.head = pose.position;
    view.right = pose.right();
    view.up = pose.up();
    view.forward = pose.forward();
    view.yMax = std::tan(0.5 * mSetting.verticalFov);
    view.yMin = -view.yMax;
    view.xMax = view.yMax * mSetting.aspect;
    view.xMin = -view.xMax;
    return view;
}

// Returns whether anything of the chunk is near enough and not behind the eye.
bool Coverage::reaches(const Chunk& chunk, const EyeView& view) const {
    const glm::dvec3 to = glm::dvec3(chunk.middle) - view.eye;
    const double r = chunk.radius + mSight.smallestSpacing();
    return glm::length(to) - r <= mSetting.within && glm::dot(to, view.forward) > -r;
}

// Returns a place off the wall: on the wall itself every line of sight would end in it.
glm::dvec3 Coverage::lifted(std::uint32_t vertex) const {
    return glm::dvec3(mMesh.places[vertex]) +
           kLift * mSight.smallestSpacing() * glm::dvec3(mMesh.normals[vertex]);
}

bool Coverage::sees(const EyeView& view, std::uint32_t vertex) const {
    const glm::dvec3 place(mMesh.places[vertex]), to = place - view.eye;
    const double depth = glm::dot(to, view.forward), away = glm::length(to);
    if (!(depth > 0) || away > mSetting.within) return false;
    const double x = glm::dot(to, view.right), y = glm::dot(to, view.up);
    if (y < view.yMin * depth || y > view.yMax * depth) return false;
    if (x < view.xMin * depth || x > view.xMax * depth) return false;
    if (-glm::dot(to, glm::dvec3(mMesh.normals[vertex])) < std::cos(mSetting.angle) * away) return false;
    return mSight.clear(view.eye, lifted(vertex));
}

void Coverage::startAgain(const CoverageSetting& setting) {
    check(setting);
    mSetting = setting;
    std::fill(mSeen.begin(), mSeen.end(), std::uint8_t{0});
}

void Coverage::look(std::span<const Pose> poses, Progress& progress) {
    std::vector<EyeView> eyes;
    eyes.reserve(poses.size());
    for (const Pose& pose : poses) eyes.push_back(viewFrom(pose));
    look(eyes, progress);
}

void Coverage::look(std::span<const EyeView> eyes, Progress& progress) {
    if (mPeers && !mPeers->alone())
        lookShared(eyes, progress);
    else
        lookHere(eyes, progress);
}

void Coverage::lookHere(std::span<const EyeView> eyes, Progress& progress) {
    ProgressSteps chunks(progress, mChunks.size(), kLooking);
    // A chunk is one task: no two write the same vertex.
    parallelFor(static_cast<int>(mChunks.size()), [&](int n) {
        lookAt(static_cast<std::size_t>(n), eyes);
        chunks.done();
    });
}

void Coverage::lookAt(std::size_t n, std::span<const EyeView> eyes) {
    const Chunk& chunk = mChunks[n];
    std::uint32_t left = 0;
    for (std::uint32_t v = chunk.from; v < chunk.to; ++v) left += !mSeen[v];
    for (std::size_t p = 0; p < eyes.size() && left > 0; ++p) {
        if (!reaches(chunk, eyes[p])) continue;
        for (std::uint32_t v = chunk.from; v < chunk.to; ++v)
            if (!mSeen[v] && sees(eyes[p], v)) mSeen[v] = 1, --left;
    }
}

std::span<std::uint8_t> Coverage::seenOf(std::size_t firstChunk, std::size_t chunks) {
    const std::uint32_t from = mChunks[firstChunk].from, to = mChunks[firstChunk + chunks - 1].to;
    return std::span(mSeen).subspan(from, to - from);
}

// Pieces of work are parts of the wall, not poses: a process then leaves out what it has already seen of its
// part.
void Coverage::lookShared(std::span<const EyeView> eyes, Progress& progress) {
    const std::size_t each = std::clamp<std::size_t>(
        mChunks.size() / (kPiecesEach * static_cast<std::size_t>(mPeers->count())), 1, kMostInPiece);
    const auto make = [&](std::size_t piece, std::span<const std::byte> order) {
        const std::size_t first = piece * each;
        if (first >= mChunks.size())
            throw Error("", "coverage", "the processes do not find the same wall", "give all the same files");
        const std::size_t chunks = std::min(each, mChunks.size() - first);
        const std::span<std::uint8_t> seen = seenOf(first, chunks);
        ByteReader(order).getAll(seen);
        parallelFor(static_cast<int>(chunks),
                    [&](int n) { lookAt(first + static_cast<std::size_t>(n), eyes); });
        return ByteWriter().putAll(std::span<const std::uint8_t>(seen)).take();
    };
    if (!mPeers->first()) return mPeers->serve(make);
    PieceWork work;
    work.count = (mChunks.size() + each - 1) / each;
    const auto seenOfPiece = [&](std::size_t piece) {
        return seenOf(piece * each, std::min(each, mChunks.size() - piece * each));
    };
    work.order = [&](std::size_t piece) {
        return ByteWriter().putAll(std::span<const std::uint8_t>(seenOfPiece(piece))).take();
    };
    work.make = make;
    ProgressSteps pieces(progress, work.count, kLooking);
    work.take = [&](std::size_t piece, std::span<const std::byte> made) {
        ByteReader(made).getAll(seenOfPiece(piece));
        pieces.done();
    };
    PieceDealer(*mPeers).deal(work);
}

double Coverage::percent() const {
    double seen = 0, all = 0;
    for (std::size_t v = 0; v < mSeen.size(); ++v) {
        all += mMesh.areas[v];
        if (mSeen[v]) seen += mMesh.areas[v];
    }
    return all > 0 ? 100 * seen / all : 0;
}

// Returns the connected patches of unseen vertices among `vertices` (ascending) that have the smallest size
// or more, largest first.
std::vector<UnseenPatch> Coverage::patchesAmong(const std::vector<std::uint32_t>& vertices) const {
    std::vector<std::uint8_t> open(mSeen.size(), 0);
    for (const std::uint32_t v : vertices) open[v] = !mSeen[v];
    std::vector<UnseenPatch> found;
    for (const std::uint32_t start : vertices) {
        if (!open[start]) continue;
        UnseenPatch patch;
        patch.vertices.push_back(start);
        open[start] = 0;
        glm::dvec3 sum(0.0);
        for (std::size_t n = 0; n < patch.vertices.size(); ++n) {
            const std::uint32_t v = patch.vertices[n];
            patch.area += mMesh.areas[v];
            sum += static_cast<double>(mMesh.areas[v]) * glm::dvec3(mMesh.places[v]);
            for (std::uint32_t k = mNeighbours.first[v]; k < mNeighbours.first[v + 1]; ++k)
                if (const std::uint32_t next = mNeighbours.neighbours[k]; open[next])
                    open[next] = 0, patch.vertices.push_back(next);
        }
        if (!(patch.area > 0) || patch.area < mSetting.smallestPatch) continue;
        const glm::dvec3 middle = sum / patch.area;
        const auto nearer = [&](std::uint32_t a, std::uint32_t b) {
            return glm::distance(glm::dvec3(mMesh.places[a]), middle) <
                   glm::distance(glm::dvec3(mMesh.places[b]), middle);
        };
        std::sort(patch.vertices.begin(), patch.vertices.end());
        patch.place = mMesh.places[*std::min_element(patch.vertices.begin(), patch.vertices.end(), nearer)];
        found.push_back(std::move(patch));
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const UnseenPatch& a, const UnseenPatch& b) { return a.area > b.area; });
    return found;
}

// An eye before the wall, where it keeps the clearance and sees the vertex; along the normal, as far away as
// it goes.
std::optional<Pose> Coverage::viewOf(std::uint32_t vertex, const FreeDistance& freeDistance,
                                     double clearance) const {
    const glm::dvec3 from = lifted(vertex), normal(mMesh.normals[vertex]);
    const double room = mSight.reach(from, normal, kFarthestView);
    for (int n = 20; n > 0; --n) {
        const glm::dvec3 eye = from + room * n / 20.0 * normal;
        if (freeDistance(eye, clearance) >= clearance)
            return lookingAt(eye, glm::dvec3(mMesh.places[vertex]));
    }
    return std::nullopt;
}

std::vector<UnseenPatch> Coverage::patches(const FreeDistance& freeDistance, double clearance) const {
    std::vector<std::uint32_t> all(mSeen.size());
    for (std::uint32_t v = 0; v < all.size(); ++v) all[v] = v;
    std::vector<UnseenPatch> found = patchesAmong(all);
    for (UnseenPatch& patch : found) {
        std::uint32_t at = patch.vertices.front();
        for (const std::uint32_t v : patch.vertices)
            if (glm::dvec3(mMesh.places[v]) == patch.place) at = v;
        patch.view = viewOf(at, freeDistance, clearance);
        // In a narrow pit another place of it may have room.
        const std::size_t stride = std::max<std::size_t>(patch.vertices.size() / 64, 1);
        for (std::size_t n = 0; n < patch.vertices.size() && !patch.view; n += stride)
            patch.view = viewOf(patch.vertices[n], freeDistance, clearance);
    }
    return found;
}

int Coverage::visit(const std::vector<UnseenPatch>& patches, const FreeDistance& freeDistance,
                    double clearance, Progress& progress) {
    int views = 0;
    ProgressSteps visits(progress, patches.size(), "looking at unseen patches");
    for (std::size_t n = 0; n < patches.size(); ++n) {
        std::optional<Pose> view = patches[n].view;
        double left = patches[n].area;
        for (int round = 0; round < kMostViews && view; ++round) {
            Progress silent([&](double, const std::string&) { throwIfStopped(); });
            const EyeView eye = viewFrom(*view);
            lookHere(std::span(&eye, 1), silent);
            ++views;
            const std::vector<UnseenPatch> rest = patchesAmong(patches[n].vertices);
            if (rest.empty() || rest.front().area >= left) break;
            left = rest.front().area;
            view = viewOf(rest.front().vertices[rest.front().vertices.size() / 2], freeDistance, clearance);
        }
        visits.done();
    }
    return views;
}

std::vector<float> unseenMarks(const std::vector<std::uint8_t>& seen) {
    std::vector<float> marks(seen.size());
    std::transform(seen.begin(), seen.end(), marks.begin(),
                   [](std::uint8_t was) { return was ? 0.0f : 1.0f; });
    return marks;
}

}  // namespace stereonav
