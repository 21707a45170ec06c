// The keys of light baked over ground: whatever the light depends on gives another key, so that no light of
// other settings or other heights is shown or gone on from.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "raster_files.h"
#include "terrain/light/fine_bake.h"
#include "terrain/light/light_tiles.h"
#include "terrain/light/terrain_bake_part.h"
#include "terrain/light/terrain_light.h"
#include "terrain/tiles/stored_levels.h"
#include "terrain/tiles/tile_maker.h"
#include "tests/support/each_member.h"
#include "tests/support/own_cache.h"

namespace stereonav::test {

template <>
struct Members<TerrainLightSettings> {
    static constexpr std::array names{"kind",     "order",  "bounces", "rays",
                                      "azimuths", "stride", "albedo",  "seed"};
};
template <>
struct Members<FineLightShape> {
    static constexpr std::array names{"settings", "key", "size", "coarsest", "finest", "content"};
};

namespace {

// What a heightfield is made of.
struct KeyedGround {
    glm::ivec2 size{5, 4};
    glm::dvec2 spacing{30, 25};
    std::vector<float> heights;

    KeyedGround() {
        for (int n = 0; n < size.x * size.y; ++n) heights.push_back(100 + 7.5f * static_cast<float>(n % 6));
    }
    Heightfield field(const std::string& name = "ground") const {
        return Heightfield(size.x, size.y, spacing, heights, name);
    }
};

std::vector<Changed<KeyedGround>> groundsBeside(const KeyedGround& base) {
    std::vector<Changed<KeyedGround>> changes;
    const auto add = [&](const std::string& what) -> KeyedGround& {
        changes.push_back({what, base});
        return changes.back().value;
    };
    for (int axis = 0; axis < 2; ++axis)
        add("the spacing along " + std::to_string(axis)).spacing[axis] =
            std::nextafter(base.spacing[axis], 0);
    add("both spacings").spacing = {25, 30};
    add("another shape of as many samples").size = {4, 5};
    for (std::size_t n = 0; n < base.heights.size(); ++n) {
        float& height = add("sample " + std::to_string(n)).heights[n];
        height = std::nextafter(height, 0.0f);
    }
    add("a sample that is missing").heights[7] = std::numeric_limits<float>::quiet_NaN();
    return changes;
}

TEST(TerrainLightKey, HasEverySettingOfTheBake) {
    const Heightfield ground = KeyedGround().field();
    for (const TerrainLightKind kind : {TerrainLightKind::Transfer, TerrainLightKind::Openness}) {
        TerrainLightSettings base;
        base.kind = kind;
        expectKeysDiffer(base, eachMemberChanged(base),
                         [&](const TerrainLightSettings& s) { return terrainLightKey(ground, s); });
    }
}

TEST(TerrainLightKey, HasEverySampleAndTheirSpacing) {
    const KeyedGround base;
    const auto changes = groundsBeside(base);
    expectKeysDiffer(base, changes, [](const KeyedGround& g) { return terrainLightKey(g.field(), {}); });
    expectKeysDiffer(base, changes,
                     [](const KeyedGround& g) { return terrainLightCache(g.field()).string(); });
    // The same heights under another file's name are the same ground.
    EXPECT_EQ(terrainLightKey(base.field("a copy"), {}), terrainLightKey(base.field(), {}));
    EXPECT_EQ(terrainLightCache(base.field("a copy")), terrainLightCache(base.field()));
}

// A bake that was stopped leaves a file for each key, and one that was renamed is not gone on from.
TEST(TerrainLightKey, NamesThePartOfItsBake) {
    const std::uint64_t key = 0x1234567890abcdef;
    std::vector<Changed<std::uint64_t>> keys;
    for (int bit = 0; bit < 64; ++bit) keys.push_back({std::to_string(bit), key ^ 1ull << bit});
    expectKeysDiffer(key, keys, [](std::uint64_t k) { return terrainBakePart(k).string(); });
    std::array<std::byte, 6> done{};
    done.fill(std::byte{7});
    const BakeBand band{0, 0, 2};
    ASSERT_GT(keepBakeBand(key, 0, band, {done}), 0u);
    const auto rowsOf = [](std::uint64_t of) {
        std::array<std::byte, 6> read{};
        return readBakePart(of, 4, 1, [&](const BakeBand&) { return BakeBlocks{read}; }).reached.rows;
    };
    EXPECT_EQ(rowsOf(key), 2);
    std::filesystem::rename(terrainBakePart(key), terrainBakePart(key + 1));
    EXPECT_EQ(rowsOf(key + 1), 0);
    std::filesystem::remove(terrainBakePart(key + 1));
}

// Tiles of a ground of 301 x 131: of its level 1 and, where it is finer, level 0.
FineLightShape keyedShape() {
    FineLightShape shape;
    shape.settings.kind = TerrainLightKind::Openness;
    shape.key = 42;
    shape.size = {301, 131};
    shape.coarsest = 1;
    shape.content = 77;
    return shape;
}

void writeTiles(const FineLightShape& shape, const std::filesystem::path& part,
                const std::filesystem::path& place) {
    LightTiles tiles = LightTiles::begin(part, shape);
    for (std::size_t n = 0; n < tiles.count(); ++n) {
        const glm::ivec2 size = tiles.sizeOf(tiles.tile(n));
        tiles.write(n, std::vector<std::byte>(static_cast<std::size_t>(size.x) * size.y, std::byte{9}));
    }
    tiles.finish(place);
}

// The settings of its light are in the key of that light.
TEST(FineLightKey, IsOfOneLightAndOneGround) {
    const TempFolder folder;
    const FineLightShape base = keyedShape();
    const auto place = folder / "a.fine";
    const auto problemOf = [&](const FineLightShape& shape) {
        return errorOf([&] { LightTiles(place, shape); });
    };
    writeTiles(base, folder / "a.part", place);
    EXPECT_EQ(problemOf(base), "");
    for (const auto& changed : eachMemberChanged(base, {"settings", "finest"}))
        EXPECT_NE(problemOf(changed.value), "") << changed.what;
    for (const auto& changed : eachMemberChanged(base, {"settings"})) {
        std::filesystem::remove(folder / "b.part");
        std::filesystem::copy_file(place, folder / "b.part");
        const LightTiles tiles = LightTiles::begin(folder / "b.part", changed.value);
        for (std::size_t n = 0; n < tiles.count(); ++n)
            EXPECT_FALSE(tiles.has(n)) << changed.what << " " << n;
    }
    std::filesystem::copy_file(place, folder / "c.part");
    const LightTiles same = LightTiles::begin(folder / "c.part", base);
    for (std::size_t n = 0; n < same.count(); ++n) EXPECT_TRUE(same.has(n)) << n;
}

// Heights of 70 x 90 samples. A change of one of them by a float is lost in the rounding of the level above,
// whose light is the one that is gone on from.
std::vector<float> finestHeights() {
    std::vector<float> heights;
    for (int j = 0; j < 90; ++j)
        for (int i = 0; i < 70; ++i)
            heights.push_back(2000 + static_cast<float>(40 * std::sin(0.2 * i) * std::cos(0.3 * j)));
    return heights;
}

FineLightShape shapeOf(const GroundLevels& levels) {
    TerrainLight light;
    light.key = 5;
    return fineLightShape(levels, 1, light, 1);
}

TEST(FineLightKey, HasEveryFinestSampleInMemory) {
    const std::vector<float> base = finestHeights();
    std::vector<Changed<std::vector<float>>> changes;
    for (const std::size_t n : {std::size_t{0}, std::size_t{69}, std::size_t{3001}, base.size() - 1}) {
        changes.push_back({"sample " + std::to_string(n), base});
        changes.back().value[n] = std::nextafter(base[n], 0.0f);
    }
    expectKeysDiffer(base, changes, [](const std::vector<float>& heights) {
        const Heightfield ground(70, 90, {10, 10}, heights, "finest");
        return shapeOf(GroundLevels(ground)).content;
    });
}

TEST(FineLightKey, HasEveryFinestSampleOnDisk) {
    struct Case {
        std::vector<float> heights = finestHeights();
        double verticalScale = 1;
    };
    const TempFolder folder;
    const Case base;
    std::vector<Changed<Case>> changes;
    for (const std::size_t n :
         {std::size_t{0}, std::size_t{69}, std::size_t{3001}, base.heights.size() - 1}) {
        changes.push_back({"sample " + std::to_string(n), base});
        changes.back().value.heights[n] = std::nextafter(base.heights[n], 0.0f);
    }
    changes.push_back({"the vertical scale", base});
    changes.back().value.verticalScale = 1.5;
    expectKeysDiffer(base, changes, [&](const Case& c) {
        const glm::ivec2 size(70, 90);
        Progress quiet;
        const TileSource source{size, 1, 32, 0, [&](int first, int count, float* to) {
                                    std::copy_n(c.heights.data() + std::ptrdiff_t{first} * size.x,
                                                std::ptrdiff_t{count} * size.x, to);
                                }};
        const auto file = folder / "ground.tiles";
        makeTiles(source, file, quiet);
        const auto store = std::make_shared<const TileStore>(file, 1);
        return shapeOf(GroundLevels(storedLevels(store, {10, 10}, c.verticalScale))).content;
    });
}

}  // namespace
}  // namespace stereonav::test
