// What tests of ground in tiles share: a cache of their own, scenes that are held to the memory that is
// allowed, and pictures of them.
#pragma once

#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <string>

#include "engine/base/memory.h"
#include "raster_files.h"
#include "terrain/cast/terrain_renderer.h"
#include "terrain/scene/terrain_loader.h"
#include "tests/support/held_memory.h"
#include "tests/support/own_cache.h"

namespace stereonav::test {

class TiledCase : public testing::Test {
protected:
    TiledCase() {
        const char* const before = std::getenv("XDG_CACHE_HOME");
        mCacheBefore = before ? before : "";
        setenv("XDG_CACHE_HOME", (mFolder / "cache").c_str(), 1);
        std::filesystem::create_directories(mFolder / "cache");
    }
    ~TiledCase() override {
        limitMemory(0);
        setenv("XDG_CACHE_HOME", mCacheBefore.c_str(), 1);
    }

    // mFile. With tiles as many bytes more are allowed, from now on.
    TerrainScene loadWithin(GroundTiles tiles, double allowed) {
        limitMemory(tiles == GroundTiles::Off ? 0 : bytesHeld() + allowed);
        SceneFile file = mFile;
        file.tiles = tiles;
        Progress progress;
        TerrainScene scene = loadTerrain(file, progress);
        scene.levelOfDetail = 0.5;
        return scene;
    }

    TempFolder mFolder;
    SceneFile mFile;

private:
    std::string mCacheBefore;
};

inline EyeImage pictureOf(const TerrainRenderer& renderer, const EyeView& view) {
    EyeImage image;
    image.resize(view.width, view.height);
    renderer.lookFrom(view);
    renderEye(renderer, view, image);
    return image;
}

// Returns the error as a share of a display's range.
inline double rootMeanSquare(const EyeImage& a, const EyeImage& b) {
    double sum = 0;
    for (int y = 0; y < a.height(); ++y)
        for (int x = 0; x < a.width(); ++x) {
            const glm::dvec3 off(glm::sqrt(unpackColor(a.color.at(x, y))) -
                                 glm::sqrt(unpackColor(b.color.at(x, y))));
            sum += glm::dot(off, off) / 3;
        }
    return std::sqrt(sum / (double(a.width()) * a.height()));
}

}  // namespace stereonav::test
