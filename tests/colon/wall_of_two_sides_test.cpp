// Thin walls from both sides: each side bends, faces, is seen and is painted for itself, and what lies on the
// other side counts for nothing. Sheets and folds whose curvature is known in closed form, at any attitude.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <numbers>
#include <utility>

#include "colon/instruments/coverage.h"
#include "colon/instruments/wall_painter.h"
#include "colon/wall/wall_curvature.h"
#include "tests/colon/lumen_wall.h"

namespace stereonav::test {
namespace {

constexpr double kSheetPi = std::numbers::pi;

// Two sheets of a grid of vertices, `thick` apart, joined at their rims: the front where `place` has it, with
// `normal`, the back behind it. Counter-clockwise as seen from the lumen, which is all around.
struct Sheet {
    WallMesh mesh;
    int side = 0;
    std::uint32_t vertexAt(int i, int j, bool back) const {
        return static_cast<std::uint32_t>((back ? side * side : 0) + j * side + i);
    }
};

template <typename Height>
Sheet sheetOf(int side, double step, double thick, const glm::dquat& turn, const Height& height) {
    Sheet sheet;
    sheet.side = side;
    const auto add = [&](const glm::dvec3& place, const glm::dvec3& normal) {
        sheet.mesh.places.emplace_back(turn * place);
        sheet.mesh.normals.emplace_back(turn * normal);
        sheet.mesh.areas.push_back(static_cast<float>(step * step));
        sheet.mesh.cells.emplace_back(0);
    };
    constexpr double kDelta = 1e-6;
    for (const bool back : {false, true})
        for (int j = 0; j < side; ++j)
            for (int i = 0; i < side; ++i) {
                const double x = step * (i - 0.5 * (side - 1)), y = step * (j - 0.5 * (side - 1));
                const glm::dvec3 up = glm::normalize(
                    glm::dvec3((height(x - kDelta, y) - height(x + kDelta, y)) / (2 * kDelta),
                               (height(x, y - kDelta) - height(x, y + kDelta)) / (2 * kDelta), 1));
                const glm::dvec3 place(x, y, height(x, y));
                add(back ? place - thick * up : place, back ? -up : up);
            }
    const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
        sheet.mesh.triangles.push_back({a, b, c});
        sheet.mesh.triangles.push_back({a, c, d});
    };
    for (int j = 0; j + 1 < side; ++j)
        for (int i = 0; i + 1 < side; ++i) {
            const auto at = [&](int p, int q, bool back) { return sheet.vertexAt(i + p, j + q, back); };
            quad(at(0, 0, false), at(1, 0, false), at(1, 1, false), at(0, 1, false));
            quad(at(0, 0, true), at(0, 1, true), at(1, 1, true), at(1, 0, true));
        }
    for (int n = 0; n + 1 < side; ++n) {
        const int last = side - 1;
        const auto rim = [&](int i0, int j0, int i1, int j1) {
            quad(sheet.vertexAt(i0, j0, true), sheet.vertexAt(i1, j1, true), sheet.vertexAt(i1, j1, false),
                 sheet.vertexAt(i0, j0, false));
        };
        rim(n, 0, n + 1, 0);
        rim(last, n, last, n + 1);
        rim(n + 1, last, n, last);
        rim(0, n + 1, 0, n);
    }
    return sheet;
}

// Returns rotations by which normals point along all of the axes, and between them.
std::vector<glm::dquat> attitudes() {
    const auto about = [](const glm::dvec3& axis, double angle) {
        return glm::angleAxis(angle, glm::normalize(axis));
    };
    return {glm::dquat(1, 0, 0, 0),         about({1, 0, 0}, kSheetPi),      about({1, 0, 0}, kSheetPi / 2),
            about({0, 1, 0}, kSheetPi / 2), about({0, 1, 0}, -kSheetPi / 2), about({1, 2, 3}, 1.1),
            about({-3, 1, 2}, 2.5)};
}

// In the middle of a paraboloid z = (a x^2 + b y^2) / 2 the principal curvatures are a and b: the front,
// whose lumen is above it, bends into it with the other sign, and the back with this one.
TEST(WallOfTwoSides, BendsTheOtherWayOnItsOtherSide) {
    for (const glm::dvec2& bend :
         {glm::dvec2(60, 60), glm::dvec2(60, 0), glm::dvec2(60, -40), glm::dvec2(-60, -20), glm::dvec2(0, 0)})
        for (const glm::dquat& turn : attitudes())
            for (const double thick : {0.0002, 0.001}) {
                SCOPED_TRACE(testing::Message() << bend.x << " " << bend.y << " thick " << thick << " turned "
                                                << turn.w << " " << turn.x << " " << turn.y);
                const Sheet sheet = sheetOf(21, 0.0002, thick, turn, [&](double x, double y) {
                    return 0.5 * (bend.x * x * x + bend.y * y * y);
                });
                const WallNeighbours neighbours = neighboursOf(sheet.mesh);
                const Curvatures front = curvaturesAt(sheet.mesh, neighbours, sheet.vertexAt(10, 10, false),
                                                      0.0013),
                                 back = curvaturesAt(sheet.mesh, neighbours, sheet.vertexAt(10, 10, true),
                                                     0.0013);
                // Behind, radii differ by the thickness.
                const auto behind = [&](double k) { return k / (1 + k * thick); };
                EXPECT_NEAR(front.larger, std::max(-bend.x, -bend.y), 1);
                EXPECT_NEAR(front.smaller, std::min(-bend.x, -bend.y), 1);
                EXPECT_NEAR(back.larger, std::max(behind(bend.x), behind(bend.y)), 1);
                EXPECT_NEAR(back.smaller, std::min(behind(bend.x), behind(bend.y)), 1);
                if (bend == glm::dvec2(0)) continue;  // what is flat has no shape
                EXPECT_NEAR(front.shapeIndex() + back.shapeIndex(), 1, 0.03)
                    << "a cap from here is a cup from there, a ridge a rut";
            }
}

// A fold: two flat sides along y with a half round of radius r at x = 0 between them. Of a place on it, `way`
// is the length along its profile, 0 at the tip.
struct Fold {
    double radius;
    glm::dvec3 place(double way, double y) const {
        const double round = 0.5 * kSheetPi * radius;
        if (std::abs(way) <= round)
            return {radius * std::cos(way / radius), y, radius * std::sin(way / radius)};
        return {-(std::abs(way) - round), y, way > 0 ? radius : -radius};
    }
    glm::dvec3 normal(double way) const {
        const double angle = std::clamp(way / radius, -0.5 * kSheetPi, 0.5 * kSheetPi);
        return {std::cos(angle), 0, std::sin(angle)};
    }
};

// Rows of `along` vertices from -reach to reach of the profile. keep: of a row's place along it.
template <typename Keep>
WallMesh foldMesh(const Fold& fold, double reach, double step, const glm::dquat& turn, const Keep& keep,
                  std::map<std::pair<int, int>, std::uint32_t>& numbers) {
    WallMesh mesh;
    const int half = static_cast<int>(std::lround(reach / step)), across = 25;
    for (int i = -half; i <= half; ++i)
        for (int j = -across; j <= across; ++j) {
            if (!keep(i * step)) continue;
            numbers[{i, j}] = static_cast<std::uint32_t>(mesh.places.size());
            mesh.places.emplace_back(turn * fold.place(i * step, j * step));
            mesh.normals.emplace_back(turn * fold.normal(i * step));
            mesh.areas.push_back(static_cast<float>(step * step));
            mesh.cells.emplace_back(0);
        }
    for (const auto& [place, number] : numbers) {
        const auto [i, j] = place;
        const auto a = numbers.find({i + 1, j}), b = numbers.find({i + 1, j + 1}),
                   c = numbers.find({i, j + 1});
        if (a == numbers.end() || b == numbers.end() || c == numbers.end()) continue;
        mesh.triangles.push_back({number, b->second, a->second});
        mesh.triangles.push_back({number, c->second, b->second});
    }
    return mesh;
}

// Beside the rim of a flat sheet the other side is nearer than the radius, along the wall too: it faces away,
// and counts for nothing.
TEST(WallOfTwoSides, BesideARimTheOtherSideCountsForNothing) {
    for (const glm::dquat& turn : attitudes())
        for (const double thick : {0.0002, 0.0005}) {
            const Sheet sheet = sheetOf(21, 0.0002, thick, turn, [](double, double) { return 0.0; });
            const WallNeighbours neighbours = neighboursOf(sheet.mesh);
            for (const bool back : {false, true})
                for (const int from : {1, 2, 4}) {
                    SCOPED_TRACE(testing::Message()
                                 << from << " from the rim, thick " << thick << (back ? ", back" : ""));
                    const Curvatures bends =
                        curvaturesAt(sheet.mesh, neighbours, sheet.vertexAt(from, 10, back), 0.0013);
                    EXPECT_NEAR(bends.larger, 0, 1);
                    EXPECT_NEAR(bends.smaller, 0, 1);
                }
        }
}

// What is near in space but joined over the edge alone, further than the radius, is not around.
TEST(WallOfTwoSides, TheOtherSideIsNotAroundAPlace) {
    const double step = 0.0001;
    std::map<std::pair<int, int>, std::uint32_t> numbers;
    const Fold fold{0.0001};
    const WallMesh mesh = foldMesh(
        fold, 0.004, step, glm::dquat(1, 0, 0, 0), [](double) { return true; }, numbers);
    const WallNeighbours neighbours = neighboursOf(mesh);
    for (const int row : {30, -30}) {
        const auto around = verticesAround(mesh, neighbours, numbers.at({row, 0}), 0.0013);
        EXPECT_EQ(around.front(), numbers.at({row, 0}));
        EXPECT_GT(around.size(), 400u);
        for (const std::uint32_t v : around) ASSERT_GT(mesh.normals[v].z * static_cast<float>(row), 0) << row;
    }
}

// --- a plate of flesh across a tube along z, 2 mm thick, that leaves an opening where x > 4 mm

constexpr double kPlateRadius = 0.012, kPlateEnd = 0.02, kPlateHalf = 0.001, kPlateEdge = 0.004;

const LumenWall& plate() {
    static const LumenWall wall(
        [](const glm::dvec3& p) {
            const double flesh = std::max(std::abs(p.z) - kPlateHalf, p.x - kPlateEdge);
            return std::max(toTube(p, kPlateRadius, -kPlateEnd, kPlateEnd), -flesh);
        },
        {-0.015, -0.015, -0.023}, {0.015, 0.015, 0.023}, 0.0005);
    return wall;
}

// Returns whether a vertex is on the plate's lower face (-1) or upper one (1), off its edges.
bool isOnFace(const WallMesh& mesh, std::size_t v, int face) {
    const glm::vec3& p = mesh.places[v];
    return std::abs(p.z - face * kPlateHalf) < 1e-4 && p.x < kPlateEdge - 0.001 &&
           std::hypot(p.x, p.y) < kPlateRadius - 0.001;
}

Pose lookingUp(double z, double up) {
    return poseFromAngles({-0.004, 0, z}, 0, up * kSheetPi / 2, 0);
}

TEST(ThinWall, HasTwoFacesThatFaceAwayFromEachOther) {
    const WallMesh& mesh = plate().mesh;
    double area[2] = {0, 0};
    int count[2] = {0, 0};
    for (std::size_t v = 0; v < mesh.places.size(); ++v)
        for (const int face : {-1, 1}) {
            if (!isOnFace(mesh, v, face)) continue;
            ASSERT_GT(mesh.normals[v].z * static_cast<float>(face), 0.99f) << "into its own lumen";
            area[face > 0] += mesh.areas[v];
            ++count[face > 0];
        }
    // The part of a disc of that radius up to a chord.
    const double r = kPlateRadius - 0.001, c = kPlateEdge - 0.001;
    const double wanted = r * r * (kSheetPi - std::acos(c / r)) + c * std::sqrt(r * r - c * c);
    for (const int n : {0, 1}) EXPECT_NEAR(area[n], wanted, 0.04 * wanted) << n;
    EXPECT_EQ(count[0], count[1]);
    // Triangles go round the other way as seen from the other side.
    for (const auto& t : mesh.triangles) {
        const glm::vec3 across =
            glm::cross(mesh.places[t[1]] - mesh.places[t[0]], mesh.places[t[2]] - mesh.places[t[0]]);
        if (isOnFace(mesh, t[0], -1) && isOnFace(mesh, t[1], -1) && isOnFace(mesh, t[2], -1)) {
            ASSERT_LT(across.z, 0);
        }
        if (isOnFace(mesh, t[0], 1) && isOnFace(mesh, t[1], 1) && isOnFace(mesh, t[2], 1)) {
            ASSERT_GT(across.z, 0);
        }
    }
}

TEST(ThinWall, HidesBothWays) {
    const LineOfSight sight = plate().sight();
    int through = 0, beside = 0;
    for (double x = -0.008; x <= 0.0101; x += 0.0012)
        for (double to = -0.008; to <= 0.0101; to += 0.0012) {
            const glm::dvec3 below(x, 0.001, -0.006), above(to, -0.002, 0.007);
            // Where the line crosses the plate's two faces.
            const auto at = [&](double z) { return below.x + (z + 0.006) / 0.013 * (above.x - below.x); };
            const double nearest = std::min(at(-kPlateHalf), at(kPlateHalf));
            if (std::abs(nearest - kPlateEdge) < 0.0006) continue;  // grazes the edge
            const bool clear = nearest > kPlateEdge;
            ++(clear ? beside : through);
            EXPECT_EQ(sight.clear(below, above), clear) << x << " " << to;
            EXPECT_EQ(sight.clear(above, below), clear) << x << " " << to;
        }
    EXPECT_GT(through, 40);
    EXPECT_GT(beside, 20);
    // The face is as far from either side.
    for (const double z : {0.002, 0.01, 0.018})
        EXPECT_NEAR(sight.reach({-0.003, 0, z}, {0, 0, -1}, 0.1),
                    sight.reach({-0.003, 0, -z}, {0, 0, 1}, 0.1), 2e-4);
}

TEST(ThinWall, IsSeenOnTheSideThatIsLookedAtAlone) {
    const LineOfSight sight = plate().sight();
    const WallMesh& mesh = plate().mesh;
    Progress progress;
    CoverageSetting setting;
    setting.angle = kSheetPi / 2;
    double percent[2] = {0, 0};
    for (const int from : {-1, 1}) {
        SCOPED_TRACE(from);
        const Pose eye = lookingUp(from * 0.014, -from);
        Coverage coverage(mesh, plate().neighbours, sight, setting);
        coverage.look({&eye, 1}, progress);
        int seen[2] = {0, 0}, all[2] = {0, 0};
        for (std::size_t v = 0; v < mesh.places.size(); ++v)
            for (const int face : {-1, 1}) {
                if (!isOnFace(mesh, v, face)) continue;
                ++all[face == from];
                seen[face == from] += coverage.seen()[v];
            }
        EXPECT_GT(seen[1], all[1] * 9 / 10) << "its own side";
        EXPECT_EQ(seen[0], 0) << "the other one";
        percent[from > 0] = coverage.percent();
    }
    EXPECT_NEAR(percent[0], percent[1], 0.5);
}

TEST(ThinWall, IsPaintedOnTheSideThatIsMarkedAlone) {
    const WallMesh& mesh = plate().mesh;
    for (const int marked : {-1, 1}) {
        std::vector<float> marks(mesh.places.size(), 0.0f);
        for (std::size_t v = 0; v < mesh.places.size(); ++v)
            marks[v] = mesh.places[v].z * static_cast<float>(marked) > 0 ? 1.0f : 0.0f;
        const auto painter =
            wallPainter(mesh, plate().neighbours, plate().lumen.field.frame, marks, {0, 0, 2});
        for (const int face : {-1, 1})
            for (const double x : {-0.006, -0.002, 0.001}) {
                const glm::vec3 grey(0.25f);
                const glm::vec3 shown = painter->paintPlace({x, 0.001, face * kPlateHalf}, grey);
                EXPECT_EQ(shown != grey, face == marked) << marked << " " << face << " " << x;
            }
    }
}

// Lines that hardly leave a face of voxels: as far as others, in as many steps. With a step of 1e-7 of a
// voxel each these would take minutes.
TEST(ThinWall, LinesAlongFacesOfVoxelsGetOn) {
    const VolumeFrame& frame = plate().lumen.field.frame;
    const LineOfSight sight = plate().sight();
    const glm::dvec3 voxel = glm::round(frame.voxelFromWorld({0.001, 0.001, 0.004}));
    const glm::dvec3 from = frame.worldFromVoxel(voxel);
    const double straight = sight.reach(from, {0, 0, -1}, 0.02);
    EXPECT_LT(straight, 0.02) << "the plate is on the way";
    for (const double aside : {-1e-17, 1e-17, -1e-12, 1e-12, -1e-9, 1e-9})
        for (const glm::dvec3& along :
             {glm::dvec3(aside, 0, -1), glm::dvec3(0, aside, -1), glm::dvec3(aside, -aside, -1)})
            ASSERT_NEAR(sight.reach(from, along, 0.02), straight, 1e-9) << aside;
    // Along the volume's own face, out of it at the end.
    const glm::dvec3 last(frame.size - 1);
    for (const double aside : {-1e-17, 1e-17}) {
        const glm::dvec3 edge = frame.worldFromVoxel({last.x, 0.5 * last.y, last.z});
        ASSERT_LE(sight.reach(edge, {aside, -1, -aside}, 1), frame.spacing.y * last.y);
    }
}

}  // namespace
}  // namespace stereonav::test
