#include "colon/instruments/unfolding.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "colon/instruments/smooth_row.h"
#include "engine/base/error.h"
#include "engine/base/memory.h"
#include "engine/base/parallel.h"

namespace stereonav {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kTurns = 360;                 // angles that shares of area are kept for
constexpr double kSmoothTurn = 6;           // angles, sigma
constexpr double kOffWall = 0.5;            // share of the smallest spacing
constexpr int kVertices = 1024;             // vertices of one task
constexpr int kStride = 2;                  // frames that are tried
constexpr int kNearest = 60, kEvery = 3;    // places of the line next to a vertex; which are tried
constexpr double kColumnStep = 0.00025;     // metres along the line
constexpr double kEnds = 0.02;              // metres of the line whose height does not count
constexpr double kTallShare = 0.98;         // share of the line that keeps its length
constexpr double kLongestTriangle = 0.012;  // metres along the line; longer ones join two loops
constexpr int kMostPixels = 32768;
constexpr const char* kUnfolding = "unfolding the wall";

}  // namespace

UnfoldedWall::UnfoldedWall(const WallMesh& mesh, const WallNeighbours& neighbours, const Centreline& line,
                           const LineOfSight& sight, const UnfoldSetting& setting, Progress& progress)
    : mMesh(mesh), mNeighbours(neighbours), mSetting(setting), mLine(line, sight) {
    if (mesh.triangles.empty() || !(mesh.area() > 0))
        throw Error("unfold", "", "expected a colon with a wall", "choose another study");
    Progress along(progress, 0, 0.6), around(progress, 0.6, 0.9);
    placeAlong(sight, along);
    placeAround(around);
    makeColumns();
    makeEqual();
    draw();
    progress.report(1, kUnfolding);
}

// The nearest place of the line that a vertex sees: not that of a loop beside its own.
void UnfoldedWall::placeAlong(const LineOfSight& sight, Progress& progress) {
    const int count = static_cast<int>(mMesh.places.size());
    const std::vector<UnfoldingLine::Frame>& frames = mLine.frames();
    std::vector<glm::vec3> values(mMesh.places.size(), glm::vec3(0));
    std::vector<std::uint8_t> known(mMesh.places.size(), 0);
    const int tasks = (count + kVertices - 1) / kVertices;
    Progress looking(progress, 0, 0.7);
    ProgressSteps parts(looking, tasks, kUnfolding);
    parallelFor(tasks, [&](int task) {
        std::vector<std::pair<double, std::size_t>> near;
        for (int v = task * kVertices; v < std::min((task + 1) * kVertices, count); ++v) {
            const glm::dvec3 place(mMesh.places[v]);
            near.clear();
            for (std::size_t n = 0; n < frames.size(); n += kStride) {
                const glm::dvec3 to = frames[n].place - place;
                near.emplace_back(glm::dot(to, to), n);
            }
            const std::size_t tried = std::min<std::size_t>(kNearest, near.size());
            std::partial_sort(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(tried), near.end());
            const glm::dvec3 from = place + kOffWall * sight.smallestSpacing() * glm::dvec3(mMesh.normals[v]);
            values[v].x = static_cast<float>(mLine.alongOf(near[0].second));
            for (std::size_t n = 0; n < tried; n += kEvery) {
                if (!sight.clear(frames[near[n].second].place, from)) continue;
                values[v].x = static_cast<float>(mLine.alongOf(near[n].second));
                known[v] = 1;
                break;
            }
        }
        parts.done();
    });
    values = smoothOverWall(mMesh, mNeighbours, std::move(values), std::move(known), mSetting.stiff);
    mAlong.resize(values.size());
    std::transform(values.begin(), values.end(), mAlong.begin(), [](const glm::vec3& v) { return v.x; });
    progress.report(1, kUnfolding);
}

void UnfoldedWall::placeAround(Progress& progress) {
    const int count = static_cast<int>(mAlong.size());
    std::vector<glm::vec3> ways(mAlong.size());
    mTurn.resize(mAlong.size());
    mAway.resize(mAlong.size());
    parallelFor((count + kVertices - 1) / kVertices, [&](int task) {
        for (int v = task * kVertices; v < std::min((task + 1) * kVertices, count); ++v) {
            const UnfoldingLine::Frame frame = mLine.at(mAlong[v]);
            const glm::dvec3 to = glm::dvec3(mMesh.places[v]) - frame.place;
            const double x = glm::dot(to, frame.across), y = glm::dot(to, frame.over);
            const double away = std::hypot(x, y);
            ways[v] = away > 0 ? glm::vec3(x / away, y / away, 0) : glm::vec3(0);
            mAway[v] = static_cast<float>(away);
        }
    });
    progress.report(0.3, kUnfolding);
    ways = smoothOverWall(mMesh, mNeighbours, std::move(ways), std::vector<std::uint8_t>(mAlong.size(), 1),
                          mSetting.stiff);
    for (std::size_t v = 0; v < ways.size(); ++v) mTurn[v] = std::atan2(ways[v].y, ways[v].x);
    progress.report(1, kUnfolding);
}

// At the line's ends the closing wall has almost the same place along the line. There a column covers less of
// the line, so that it is not higher than the columns between the ends.
void UnfoldedWall::makeColumns() {
    const auto [least, most] = std::minmax_element(mAlong.begin(), mAlong.end());
    mFirst = *least;
    const auto steps = static_cast<std::size_t>(std::ceil((*most - *least) / kColumnStep)) + 2;
    checkMemory("unfold", static_cast<double>(steps) * 3 * sizeof(double), "choose another study");
    std::vector<double> tall(steps, 0.0);
    for (std::size_t v = 0; v < mAlong.size(); ++v)
        tall[static_cast<std::size_t>((mAlong[v] - mFirst) / kColumnStep)] += mMesh.areas[v] / kColumnStep;
    smoothRow(tall, 0.3 * mSetting.even / kColumnStep, false);
    const double ends = std::min(kEnds, mLine.length() / 3);
    std::vector<double> usual;
    for (std::size_t n = 0; n < steps; ++n) {
        const double along = mFirst + static_cast<double>(n) * kColumnStep;
        if (along >= ends && along <= mLine.length() - ends && tall[n] > 0) usual.push_back(tall[n]);
    }
    double limit = std::numeric_limits<double>::infinity();
    if (!usual.empty()) {
        const auto at = usual.begin() + static_cast<std::ptrdiff_t>(kTallShare * (usual.size() - 1.0));
        std::nth_element(usual.begin(), at, usual.end());
        limit = *at;
    }
    mColumns.assign(steps, 0);
    for (std::size_t n = 1; n < steps; ++n)
        mColumns[n] = mColumns[n - 1] +
                      std::max(1.0, 0.5 * (tall[n - 1] + tall[n]) / limit) * kColumnStep / mSetting.pixel;
    if (!(mColumns.back() < kMostPixels))
        throw Error("unfold", "", "the picture would be wider than 32768 pixels", "use larger pixels");
    mWidth = static_cast<int>(std::ceil(mColumns.back())) + 1;
}

double UnfoldedWall::columnAt(double along) const {
    const double at =
        std::clamp((along - mFirst) / kColumnStep, 0.0, static_cast<double>(mColumns.size() - 1));
    const auto n = std::min(static_cast<std::size_t>(at), mColumns.size() - 2);
    return glm::mix(mColumns[n], mColumns[n + 1], at - static_cast<double>(n));
}

double UnfoldedWall::alongAt(double column) const {
    const auto after = std::upper_bound(mColumns.begin() + 1, mColumns.end() - 1, column);
    const auto n = static_cast<std::size_t>(after - mColumns.begin()) - 1;
    const double t = (column - mColumns[n]) / (mColumns[n + 1] - mColumns[n]);
    return mFirst + (static_cast<double>(n) + std::clamp(t, 0.0, 1.0)) * kColumnStep;
}

// Computes the height of each column, and the share of its wall before each angle, from the area of wall
// around there.
void UnfoldedWall::makeEqual() {
    checkMemory("unfold", static_cast<double>(mWidth) * (kTurns + 1) * 4 * sizeof(double),
                "use larger pixels");
    std::vector<std::vector<double>> byTurn(kTurns, std::vector<double>(mWidth, 0.0));
    for (std::size_t v = 0; v < mAlong.size(); ++v) {
        const int column = std::clamp(static_cast<int>(std::lround(columnAt(mAlong[v]))), 0, mWidth - 1);
        const int turn = std::clamp(static_cast<int>((mTurn[v] + kPi) / (2 * kPi) * kTurns), 0, kTurns - 1);
        byTurn[turn][column] += mMesh.areas[v];
    }
    const double sigma = mSetting.even / mSetting.pixel;
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
    if (!(tallest < kMostPixels))
        throw Error("unfold", "", "the picture would be higher than 32768 pixels", "use larger pixels");
    mHeight = static_cast<int>(std::ceil(tallest)) + 2;
    checkMemory("unfold", static_cast<double>(mWidth) * mHeight * 40, "use larger pixels");
}

double UnfoldedWall::halfAt(int column) const {
    return 0.5 * mTall[std::clamp(column, 0, mWidth - 1)];
}

// Pixels from the top, of a turn that may lie beyond a whole one.
double UnfoldedWall::downAt(double column, double turn) const {
    const double turns = (turn + kPi) / (2 * kPi), whole = std::floor(turns), at = (turns - whole) * kTurns;
    const int n = std::min(static_cast<int>(at), kTurns - 1);
    const auto inColumn = [&](int c) {
        const float* share = &mShare[static_cast<std::size_t>(c) * (kTurns + 1)];
        const double before = share[n] + (at - n) * (share[n + 1] - share[n]);
        return 0.5 * mHeight + (whole * share[kTurns] + before - 0.5) * mTall[c];
    };
    const double x = std::clamp(column, 0.0, static_cast<double>(mWidth - 1));
    const int c = std::min(static_cast<int>(x), std::max(mWidth - 2, 0));
    return glm::mix(inColumn(c), inColumn(std::min(c + 1, mWidth - 1)), x - c);
}

glm::dvec2 UnfoldedWall::pixelOf(std::uint32_t vertex) const {
    const double column = columnAt(mAlong[vertex]);
    return {column, downAt(column, mTurn[vertex])};
}

std::optional<glm::dvec3> UnfoldedWall::placeAt(int x, int y) const {
    if (x < 0 || y < 0 || x >= mWidth || y >= mHeight || vertexAt(x, y) == kNone) return std::nullopt;
    return glm::dvec3(mPlaces[static_cast<std::size_t>(y) * mWidth + x]);
}

bool UnfoldedWall::hidden(std::uint32_t vertex, double within) const {
    const glm::dvec2 p = pixelOf(vertex);
    const glm::dvec3 place(mMesh.places[vertex]);
    // The pixels around it: at the wall's edges one of them may lie beside it.
    for (int dy = 0; dy <= 1; ++dy)
        for (int dx = 0; dx <= 1; ++dx) {
            const auto shown =
                placeAt(static_cast<int>(std::floor(p.x)) + dx, static_cast<int>(std::floor(p.y)) + dy);
            if (shown && glm::distance(*shown, place) <= within) return false;
        }
    return true;
}

double UnfoldedWall::hiddenShare(double within) const {
    double all = 0, hides = 0;
    for (std::uint32_t v = 0; v < mAlong.size(); ++v) {
        all += mMesh.areas[v];
        if (hidden(v, within)) hides += mMesh.areas[v];
    }
    return all > 0 ? hides / all : 0;
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
    const auto [from, to] = std::minmax({mAlong[t[0]], mAlong[t[1]], mAlong[t[2]]});
    if (to - from > kLongestTriangle) return;
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
        std::array<glm::dvec2, 3> at;
        for (int n = 0; n < 3; ++n) {
            const double column = columnAt(mAlong[t[n]]);
            at[n] = {column, downAt(column, turns[n] + 2 * kPi * whole)};
        }
        drawFlat(t, at);
    }
}

void UnfoldedWall::drawFlat(const std::array<std::uint32_t, 3>& t, const std::array<glm::dvec2, 3>& p) {
    const double doubled = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[2].x - p[0].x) * (p[1].y - p[0].y);
    if (doubled == 0) return;
    // A vertex of flesh thinner than a voxel may be of both its sides: then its normal is of neither.
    const glm::vec3 &a3 = mMesh.places[t[0]], &b3 = mMesh.places[t[1]], &c3 = mMesh.places[t[2]];
    const glm::vec3 across = glm::cross(b3 - a3, c3 - a3);
    glm::vec3 normals[3];
    for (int n = 0; n < 3; ++n) {
        normals[n] = mMesh.normals[t[n]];
        if (glm::dot(normals[n], across) < 0) normals[n] = glm::normalize(across);
    }
    const int x0 = std::max(static_cast<int>(std::ceil(std::min({p[0].x, p[1].x, p[2].x}))), 0);
    const int x1 = std::min(static_cast<int>(std::floor(std::max({p[0].x, p[1].x, p[2].x}))), mWidth - 1);
    for (int x = x0; x <= x1; ++x) {
        const double top = 0.5 * mHeight - halfAt(x), bottom = 0.5 * mHeight + halfAt(x);
        const int y0 = static_cast<int>(std::ceil(std::max(std::min({p[0].y, p[1].y, p[2].y}), top)));
        const int y1 = static_cast<int>(std::floor(std::min(std::max({p[0].y, p[1].y, p[2].y}), bottom)));
        for (int y = std::max(y0, 0); y <= std::min(y1, mHeight - 1); ++y) {
            float share[3];
            for (int n = 0; n < 3; ++n) {
                const glm::dvec2 &a = p[(n + 1) % 3], &b = p[(n + 2) % 3];
                share[n] = static_cast<float>(((a.x - x) * (b.y - y) - (b.x - x) * (a.y - y)) / doubled);
            }
            if (share[0] < -1e-5f || share[1] < -1e-5f || share[2] < -1e-5f) continue;
            const float away = share[0] * mAway[t[0]] + share[1] * mAway[t[1]] + share[2] * mAway[t[2]];
            const std::size_t at = static_cast<std::size_t>(y) * mWidth + x;
            if (away >= mNear[at]) continue;
            mNear[at] = away;
            mVertex[at] = t[std::max_element(share, share + 3) - share];
            mPlaces[at] = mNormals[at] = glm::vec3(0);
            for (int n = 0; n < 3; ++n) {
                mPlaces[at] += share[n] * mMesh.places[t[n]];
                mNormals[at] += share[n] * normals[n];
            }
        }
    }
}

}  // namespace stereonav
