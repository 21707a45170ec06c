#include "colon/instruments/unfolding.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "engine/base/error.h"
#include "engine/base/memory.h"
#include "engine/base/parallel.h"

namespace stereonav {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kTurns = 360;               // angles that shares of area are kept for
constexpr double kSmoothLine = 8;         // frames, sigma
constexpr double kSmoothTurn = 6;         // angles, sigma
constexpr double kOffWall = 0.5;          // of the smallest spacing
constexpr int kVertices = 1024;           // of one task
constexpr int kNearest = 60, kEvery = 4;  // places of the line next to a vertex; which are tried

// A Gaussian over a row; beyond the ends of an open row the last values count on.
void smoothRow(std::vector<double>& row, double sigma, bool closed) {
    const int count = static_cast<int>(row.size()), reach = static_cast<int>(std::ceil(3 * sigma));
    std::vector<double> result(row.size());
    for (int n = 0; n < count; ++n) {
        double sum = 0, weights = 0;
        for (int k = -reach; k <= reach; ++k) {
            const int at = closed ? ((n + k) % count + count) % count : std::clamp(n + k, 0, count - 1);
            const double w = std::exp(-0.5 * k * k / (sigma * sigma));
            sum += w * row[at];
            weights += w;
        }
        result[n] = sum / weights;
    }
    row = std::move(result);
}

}  // namespace

UnfoldedWall::UnfoldedWall(const WallMesh& mesh, const WallNeighbours& neighbours, const Centreline& line,
                           const LineOfSight& sight, const UnfoldSetting& setting, Progress& progress)
    : mMesh(mesh), mNeighbours(neighbours), mSetting(setting) {
    if (mesh.places.empty() || line.points.size() < 3)
        throw Error("unfold", "", "expected a colon with a wall and a line", "choose another study");
    makeFrames(line);
    placeAlong(sight, progress);
    progress.report(0.5, "unfolding the wall");
    smoothAlong();
    placeAround();
    progress.report(0.8, "unfolding the wall");
    makeEqual();
    draw();
}

// Even places of the smoothed line, and a frame that does not twist (parallel transport).
void UnfoldedWall::makeFrames(const Centreline& line) {
    std::vector<double> x, y, z;
    double walked = 0;
    for (std::size_t n = 0; n < line.points.size(); ++n) {
        const glm::dvec3& to = line.points[n].position;
        const glm::dvec3 from = n > 0 ? line.points[n - 1].position : to;
        const double step = glm::distance(from, to);
        while (static_cast<double>(x.size()) * mStep <= walked + step) {
            const double t = step > 0 ? (static_cast<double>(x.size()) * mStep - walked) / step : 0;
            const glm::dvec3 p = glm::mix(from, to, t);
            x.push_back(p.x), y.push_back(p.y), z.push_back(p.z);
        }
        walked += step;
    }
    if (x.size() < 3) throw Error("unfold", "", "expected a line of 2 mm or more", "choose another study");
    const auto smoothEnds = [](std::vector<double>& row) {
        // Smoothed as what is left of a straight way between its ends, which stay.
        const double first = row.front(), last = row.back(), count = static_cast<double>(row.size() - 1);
        for (std::size_t n = 0; n < row.size(); ++n) row[n] -= first + (last - first) * (n / count);
        smoothRow(row, kSmoothLine, false);
        for (std::size_t n = 0; n < row.size(); ++n) row[n] += first + (last - first) * (n / count);
    };
    smoothEnds(x), smoothEnds(y), smoothEnds(z);
    const int count = static_cast<int>(x.size());
    mLength = (count - 1) * mStep;
    glm::dvec3 across(0);
    for (int n = 0; n < count; ++n) {
        const int a = std::max(n - 1, 0), b = std::min(n + 1, count - 1);
        const glm::dvec3 way(x[b] - x[a], y[b] - y[a], z[b] - z[a]);
        Frame frame{{x[n], y[n], z[n]}, glm::normalize(way + glm::dvec3(1e-12)), {}, {}};
        if (n == 0) {
            across = std::abs(frame.tangent.y) < 0.8 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
        }
        across = glm::normalize(across - glm::dot(across, frame.tangent) * frame.tangent);
        frame.across = across;
        frame.over = glm::cross(frame.tangent, across);
        mFrames.push_back(frame);
    }
}

UnfoldedWall::Frame UnfoldedWall::frameAt(double along) const {
    const double at = std::clamp(along / mStep, 0.0, static_cast<double>(mFrames.size() - 1));
    const auto n = std::min(static_cast<std::size_t>(at), mFrames.size() - 2);
    const double t = at - static_cast<double>(n);
    const Frame &a = mFrames[n], &b = mFrames[n + 1];
    return {glm::mix(a.place, b.place, t), glm::mix(a.tangent, b.tangent, t), glm::mix(a.across, b.across, t),
            glm::mix(a.over, b.over, t)};
}

// The nearest place of the line that a vertex sees: not that of a loop beside its own.
void UnfoldedWall::placeAlong(const LineOfSight& sight, Progress& progress) {
    constexpr int kStride = 2;  // frames
    const int count = static_cast<int>(mMesh.places.size());
    mAlong.resize(count);
    parallelFor((count + kVertices - 1) / kVertices, [&](int task) {
        if (task % 64 == 0) progress.report(0.2, "unfolding the wall");
        std::vector<std::pair<double, int>> near;
        for (int v = task * kVertices; v < std::min((task + 1) * kVertices, count); ++v) {
            const glm::dvec3 place(mMesh.places[v]);
            near.clear();
            for (int n = 0; n < static_cast<int>(mFrames.size()); n += kStride) {
                const glm::dvec3 to = mFrames[n].place - place;
                near.emplace_back(glm::dot(to, to), n);
            }
            const std::size_t tried = std::min<std::size_t>(kNearest, near.size());
            std::partial_sort(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(tried), near.end());
            const glm::dvec3 from = place + kOffWall * sight.smallestSpacing() * glm::dvec3(mMesh.normals[v]);
            std::size_t best = 0;
            while (best < tried && !sight.clear(mFrames[near[best].second].place, from)) best += kEvery;
            mAlong[v] = static_cast<float>(near[best < tried ? best : 0].second * mStep);
        }
    });
}

// By mean over neighbours, again and again: jumps at folds and at the inner side of bends go.
void UnfoldedWall::smoothAlong() {
    const int count = static_cast<int>(mAlong.size());
    std::vector<float> next(mAlong.size());
    for (int round = 0; round < mSetting.rounds; ++round) {
        parallelFor((count + kVertices - 1) / kVertices, [&](int task) {
            for (int v = task * kVertices; v < std::min((task + 1) * kVertices, count); ++v) {
                double sum = mAlong[v], weights = 1;
                for (std::uint32_t k = mNeighbours.first[v]; k < mNeighbours.first[v + 1]; ++k)
                    sum += mAlong[mNeighbours.neighbours[k]], ++weights;
                next[v] = static_cast<float>(sum / weights);
            }
        });
        std::swap(mAlong, next);
    }
}

void UnfoldedWall::placeAround() {
    const int count = static_cast<int>(mAlong.size());
    mTurn.resize(count);
    mAway.resize(count);
    parallelFor((count + kVertices - 1) / kVertices, [&](int task) {
        for (int v = task * kVertices; v < std::min((task + 1) * kVertices, count); ++v) {
            const Frame frame = frameAt(mAlong[v]);
            const glm::dvec3 to = glm::dvec3(mMesh.places[v]) - frame.place;
            const double x = glm::dot(to, frame.across), y = glm::dot(to, frame.over);
            mTurn[v] = static_cast<float>(std::atan2(y, x));
            mAway[v] = static_cast<float>(std::hypot(x, y));
        }
    });
}

// How tall each column is, and which share of it lies before each angle: by the area of wall around there.
void UnfoldedWall::makeEqual() {
    mWidth = static_cast<int>(std::ceil(mLength / mSetting.pixel)) + 1;
    checkMemory("unfold", static_cast<double>(mWidth) * (kTurns + 1) * 4 * sizeof(double),
                "use larger pixels");
    std::vector<std::vector<double>> byTurn(kTurns, std::vector<double>(mWidth, 0.0));
    for (std::size_t v = 0; v < mAlong.size(); ++v) {
        const int column = std::clamp(static_cast<int>(mAlong[v] / mSetting.pixel + 0.5), 0, mWidth - 1);
        const int turn = std::clamp(static_cast<int>((mTurn[v] + kPi) / (2 * kPi) * kTurns), 0, kTurns - 1);
        byTurn[turn][column] += mMesh.areas[v];
    }
    const double sigma = mSetting.smooth / mSetting.pixel;
    parallelFor(kTurns, [&](int turn) { smoothRow(byTurn[turn], sigma, false); });
    mTall.resize(mWidth);
    mShare.assign(static_cast<std::size_t>(mWidth) * (kTurns + 1), 0);
    parallelFor(mWidth, [&](int column) {
        std::vector<double> row(kTurns);
        double sum = 0;
        for (int turn = 0; turn < kTurns; ++turn) sum += row[turn] = byTurn[turn][column];
        smoothRow(row, kSmoothTurn, true);
        mTall[column] = static_cast<float>(sum / (mSetting.pixel * mSetting.pixel));
        double before = 0;
        float* share = &mShare[static_cast<std::size_t>(column) * (kTurns + 1)];
        // A hundredth is even, so that no angle is without room.
        for (int turn = 0; turn < kTurns; ++turn) {
            before += (sum > 0 ? 0.99 * row[turn] / sum : 0.99 / kTurns) + 0.01 / kTurns;
            share[turn + 1] = static_cast<float>(before);
        }
    });
    const double tallest = *std::max_element(mTall.begin(), mTall.end());
    if (!(tallest < 32768) || mWidth > 32768)
        throw Error("unfold", "", "the picture would be larger than 32768 pixels", "use larger pixels");
    mHeight = static_cast<int>(std::ceil(tallest)) + 2;
    checkMemory("unfold", static_cast<double>(mWidth) * mHeight * 40, "use larger pixels");
}

double UnfoldedWall::halfAt(int column) const {
    return 0.5 * mTall[std::clamp(column, 0, mWidth - 1)];
}

// Pixels from the top, of a turn that may lie beyond a whole one.
double UnfoldedWall::downAt(double column, double turn) const {
    const auto inColumn = [&](int c) {
        const float* share = &mShare[static_cast<std::size_t>(c) * (kTurns + 1)];
        const double whole = std::floor((turn + kPi) / (2 * kPi));
        const double at = ((turn + kPi) / (2 * kPi) - whole) * kTurns;
        const int n = std::min(static_cast<int>(at), kTurns - 1);
        const double before = share[n] + (at - n) * (share[n + 1] - share[n]);
        return 0.5 * mHeight + (whole * share[kTurns] + before - 0.5) * mTall[c];
    };
    const double x = std::clamp(column, 0.0, static_cast<double>(mWidth - 1));
    const int c = std::min(static_cast<int>(x), std::max(mWidth - 2, 0));
    const int next = std::min(c + 1, mWidth - 1);
    return glm::mix(inColumn(c), inColumn(next), x - c);
}

glm::dvec2 UnfoldedWall::pixelOf(std::uint32_t vertex) const {
    const double column = mAlong[vertex] / mSetting.pixel;
    return {column, downAt(column, mTurn[vertex])};
}

void UnfoldedWall::draw() {
    const std::size_t count = static_cast<std::size_t>(mWidth) * mHeight;
    mVertex.assign(count, kNone);
    mNear.assign(count, std::numeric_limits<float>::infinity());
    mPlaces.assign(count, glm::vec3(0));
    mNormals.assign(count, glm::vec3(0));
    for (const auto& triangle : mMesh.triangles) drawTriangle(triangle);
}

void UnfoldedWall::drawTriangle(const std::array<std::uint32_t, 3>& t) {
    double turns[3];
    for (int n = 0; n < 3; ++n) {
        turns[n] = mTurn[t[n]];
        if (n > 0) turns[n] -= 2 * kPi * std::round((turns[n] - turns[0]) / (2 * kPi));
    }
    // Around the line's ends the wall closes: angles mean nothing in what holds the pole.
    const auto [least, most] = std::minmax({turns[0], turns[1], turns[2]});
    if (most - least > 0.6 * kPi) return;
    for (int whole = -1; whole <= 1; ++whole) {
        if (most + 2 * kPi * whole < -kPi || least + 2 * kPi * whole > kPi) continue;
        glm::dvec2 p[3];
        for (int n = 0; n < 3; ++n) {
            const double column = mAlong[t[n]] / mSetting.pixel;
            p[n] = {column, downAt(column, turns[n] + 2 * kPi * whole)};
        }
        const double doubled = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[2].x - p[0].x) * (p[1].y - p[0].y);
        if (doubled == 0) continue;
        const int x0 = std::max(static_cast<int>(std::ceil(std::min({p[0].x, p[1].x, p[2].x}))), 0);
        const int x1 = std::min(static_cast<int>(std::floor(std::max({p[0].x, p[1].x, p[2].x}))), mWidth - 1);
        for (int x = x0; x <= x1; ++x) {
            const double top = 0.5 * mHeight - halfAt(x), bottom = 0.5 * mHeight + halfAt(x);
            const int y0 = static_cast<int>(std::ceil(std::max(std::min({p[0].y, p[1].y, p[2].y}), top)));
            const int y1 = static_cast<int>(std::floor(std::min(std::max({p[0].y, p[1].y, p[2].y}), bottom)));
            for (int y = std::max(y0, 0); y <= std::min(y1, mHeight - 1); ++y) {
                double share[3];
                for (int n = 0; n < 3; ++n) {
                    const glm::dvec2 &a = p[(n + 1) % 3], &b = p[(n + 2) % 3];
                    share[n] = ((a.x - x) * (b.y - y) - (b.x - x) * (a.y - y)) / doubled;
                }
                if (share[0] < -1e-9 || share[1] < -1e-9 || share[2] < -1e-9) continue;
                const auto away = static_cast<float>(share[0] * mAway[t[0]] + share[1] * mAway[t[1]] +
                                                     share[2] * mAway[t[2]]);
                const std::size_t at = static_cast<std::size_t>(y) * mWidth + x;
                if (away >= mNear[at]) continue;
                mNear[at] = away;
                const int nearest = static_cast<int>(std::max_element(share, share + 3) - share);
                mVertex[at] = t[nearest];
                mPlaces[at] = glm::vec3(0);
                mNormals[at] = glm::vec3(0);
                for (int n = 0; n < 3; ++n) {
                    mPlaces[at] += static_cast<float>(share[n]) * mMesh.places[t[n]];
                    mNormals[at] += static_cast<float>(share[n]) * mMesh.normals[t[n]];
                }
            }
        }
    }
}

UnfoldedWall::Shown UnfoldedWall::shown(const MeasuredPolyp& polyp) const {
    const auto ofHead = [&](int x, int y) {
        const std::uint32_t v = vertexAt(x, y);
        return v != kNone && std::binary_search(polyp.vertices.begin(), polyp.vertices.end(), v);
    };
    double seen = 0, all = 0;
    int low = mWidth, high = 0;
    for (const std::uint32_t v : polyp.vertices) {
        const glm::dvec2 p = pixelOf(v);
        const int x = std::clamp(static_cast<int>(p.x + 0.5), 0, mWidth - 1),
                  y = std::clamp(static_cast<int>(p.y + 0.5), 0, mHeight - 1);
        all += mMesh.areas[v];
        if (ofHead(x, y)) seen += mMesh.areas[v];
        low = std::min(low, x - 2), high = std::max(high, x + 2);
    }
    low = std::max(low, 0), high = std::min(high, mWidth - 1);
    std::vector<std::pair<int, int>> pixels;
    for (int x = low; x <= high; ++x)
        for (int y = 0; y < mHeight; ++y)
            if (ofHead(x, y)) pixels.emplace_back(x, y);
    std::vector<std::uint8_t> open(pixels.size(), 1);
    Shown result;
    result.share = all > 0 ? seen / all : 0;
    // What is cut by the picture's upper edge goes on at its lower one.
    const auto joined = [&](const std::pair<int, int>& a, const std::pair<int, int>& b) {
        const int dx = std::abs(a.first - b.first), dy = std::abs(a.second - b.second);
        const double whole = mTall[a.first];
        return dx <= 2 && (dy <= 2 || std::abs(dy - whole) <= 4);
    };
    for (std::size_t start = 0; start < pixels.size(); ++start) {
        if (!open[start]) continue;
        std::vector<std::size_t> piece{start};
        open[start] = 0;
        for (std::size_t n = 0; n < piece.size(); ++n)
            for (std::size_t k = 0; k < pixels.size(); ++k)
                if (open[k] && joined(pixels[piece[n]], pixels[k])) open[k] = 0, piece.push_back(k);
        result.pieces += piece.size() * 20 >= pixels.size();
    }
    return result;
}

}  // namespace stereonav
