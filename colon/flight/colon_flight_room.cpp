// Free distance falls by at most a metre a metre, so a move shorter than the room needs no further look;
// longer ones are made of such pieces. Near the wall pieces turn along it.
#include "colon/flight/colon_flight_room.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

namespace stereonav {
namespace {

constexpr int kMostPieces = 12;  // pieces of one move; what is left then is not moved
constexpr int kMostLooks = 64;   // along a straight way
constexpr double kProbe = 0.25;  // share of the clearance: how far around the wall's direction is looked for
constexpr double kLeastProbe = 1e-4;  // metres, above the steps of a distance kept in voxels
constexpr double kClearSlope = 0.25;  // a gradient below it points nowhere: the head is between walls
constexpr double kOffWall = 1.5;      // times the way by which a piece came too near to the wall
constexpr double kFarther = 2.0;      // clearances: looked further than asked, to know more for later
constexpr double kNothing = 1e-12;    // metres
constexpr std::int64_t kCellSpan = 1 << 20;

}  // namespace

LumenRoom::LumenRoom(FreeDistance freeDistance, double clearance, double half,
                     const std::vector<NarrowPlace>& narrow)
    : mFree(std::move(freeDistance)), mClearance(clearance), mHalf(half) {
    double farthest = 0;
    for (const NarrowPlace& place : narrow)
        farthest = std::max(farthest, place.reach + (clearance - place.allowed) / kAllowedSlope);
    mCell = std::max(farthest, kLeastProbe);
    for (const NarrowPlace& place : narrow)
        for (int k = 0; k < 27; ++k)
            mCells[cellOf(place.position, glm::ivec3(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1))].push_back(place);
}

// Cells further apart than 2^20 of them share a number, which costs time only.
std::uint64_t LumenRoom::cellOf(const glm::dvec3& p, const glm::ivec3& offset) const {
    std::uint64_t cell = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double index = std::clamp(std::floor(p[axis] / mCell), -1e15, 1e15);
        const std::int64_t wrapped = (static_cast<std::int64_t>(index) + offset[axis]) & (kCellSpan - 1);
        cell = cell << 20 | static_cast<std::uint64_t>(wrapped);
    }
    return cell;
}

double LumenRoom::allowed(const glm::dvec3& head) const {
    if (mCells.empty()) return mClearance;
    const auto found = mCells.find(cellOf(head, glm::ivec3(0)));
    if (found == mCells.end()) return mClearance;
    double least = mClearance;
    for (const NarrowPlace& place : found->second) {
        const double beyond = std::max(0.0, glm::distance(head, place.position) - place.reach);
        least = std::min(least, place.allowed + kAllowedSlope * beyond);
    }
    return least;
}

double LumenRoom::freeAt(const glm::dvec3& point, double upTo) const {
    const double distance = mFree(point, upTo);
    return distance > 0 ? std::min(distance, upTo) : 0.0;  // NaN is no room
}

double LumenRoom::free(const glm::dvec3& head, const glm::dvec3& right, double upTo) const {
    if (head == mLastFree.head && right == mLastFree.right && upTo == mLastFree.upTo) return mLastFree.room;
    double nearest = freeAt(head, upTo);
    for (const double side : {-mHalf, mHalf})
        if (mHalf > 0) nearest = std::min(nearest, freeAt(head + side * right, upTo));
    mLastFree = {head, right, upTo, nearest};
    return nearest;
}

double LumenRoom::room(const glm::dvec3& head, const glm::dvec3& right, double upTo) const {
    const bool asAbove = head == mLast.head && right == mLast.right;
    if (asAbove && (mLast.room < mLast.upTo || upTo <= mLast.upTo)) return std::min(mLast.room, upTo);
    mLast = {head, right, upTo, lookedUp(head, right, upTo)};
    return mLast.room;
}

double LumenRoom::lookedUp(const glm::dvec3& head, const glm::dvec3& right, double upTo) const {
    const double need = allowed(head);
    // Around the head alone: holds for both eyes however the head is turned.
    const double enough = upTo + need + mHalf;
    if (mKnownFree - glm::distance(head, mKnownPoint) >= enough) return upTo;
    const double farther = enough + kFarther * mClearance, free = freeAt(head, farther);
    if (free > enough) {
        mKnownPoint = head;
        mKnownFree = free;
    }
    const double around = free - mHalf - need;
    if (around >= upTo || mHalf <= 0) return std::min(around, upTo);
    double nearest = std::min(free, need + upTo);
    for (const double side : {-mHalf, mHalf})
        nearest = std::min(nearest, freeAt(head + side * right, need + upTo));
    return std::max(around, nearest - need);
}

glm::dvec3 LumenRoom::away(const glm::dvec3& head, const glm::dvec3& right) const {
    if (mLastAway.known && head == mLastAway.head && right == mLastAway.right) return mLastAway.direction;
    const double probe = std::max(kProbe * mClearance, kLeastProbe);
    const double upTo = mClearance + mHalf + 4 * probe;
    glm::dvec3 slope(0.0);
    // The corners of a tetrahedron: the sum of d d^T over them is 4/3 of the identity for unit d.
    for (const glm::dvec3& d :
         {glm::dvec3(1, 1, 1), glm::dvec3(1, -1, -1), glm::dvec3(-1, 1, -1), glm::dvec3(-1, -1, 1)}) {
        const glm::dvec3 unit = d / std::sqrt(3.0);
        slope += unit * (room(head + probe * unit, right, upTo) * 0.75 / probe);
    }
    const double size = glm::length(slope);
    mLastAway = {true, head, right, size > kClearSlope ? slope / size : glm::dvec3(0.0)};
    return mLastAway.direction;
}

glm::dvec3 LumenRoom::moved(const glm::dvec3& head, const glm::dvec3& right, const glm::dvec3& by) const {
    glm::dvec3 at = head, left = by;
    double here = room(at, right, kSlope * glm::length(by));
    for (int piece = 0; piece < kMostPieces; ++piece) {
        const double length = glm::length(left);
        if (!(length > kNothing)) break;
        const double part = std::min(length, std::max(here / kSlope, kCrawl * allowed(at)));
        const glm::dvec3 next = at + left * (part / length);
        const double there = room(next, right, kSlope * length);
        if (there >= 0) {
            at = next;
            here = there;
            left *= 1 - part / length;
            continue;
        }
        const glm::dvec3 wall = away(at, right);
        if (glm::dot(wall, wall) == 0) {
            left *= 0.5;
            continue;
        }
        // Along the wall, and off it by more than the next piece was too near: a hollow wall takes it again.
        const double off = kOffWall * std::min(-there, part) * length / part;
        left += wall * (off - std::min(glm::dot(left, wall), 0.0));
        if (glm::length(left) > length) left *= length / glm::length(left);
    }
    return at;
}

bool LumenRoom::wayIsFree(const glm::dvec3& from, const glm::dvec3& to, const glm::dvec3& right) const {
    const double length = glm::distance(from, to);
    double done = 0;
    for (int look = 0; look < kMostLooks; ++look) {
        const glm::dvec3 at = from + (to - from) * (length > 0 ? done / length : 0.0);
        const double here = room(at, right, kSlope * (length - done));
        if (here < 0) return false;
        if (done >= length) return true;
        done = std::min(length, done + std::max(here / kSlope, kCrawl * allowed(at)));
    }
    return false;
}

}  // namespace stereonav
