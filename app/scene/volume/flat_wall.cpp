#include "app/scene/volume/flat_wall.h"

#include <glm/geometric.hpp>
#include <utility>

#include "colon/instruments/panorama.h"
#include "colon/instruments/polyp.h"
#include "colon/instruments/registration.h"
#include "colon/instruments/unfolding.h"
#include "colon/wall/line_of_sight.h"
#include "engine/base/memory.h"
#include "engine/base/parallel.h"

namespace stereonav {
namespace {

// Returns the nearest vertex of the wall; empty where it is farther than `within`.
std::optional<std::uint32_t> wallNextTo(const WallMesh& mesh, const glm::dvec3& world, double within) {
    const std::uint32_t vertex = nearestVertex(mesh, world);
    if (glm::distance(glm::dvec3(mesh.places[vertex]), world) > within) return std::nullopt;
    return vertex;
}

class ColonFlatPicture final : public FlatPicture {
public:
    ColonFlatPicture(const ColonScene& colon, std::shared_ptr<const JoinedWall> wall, Progress& progress)
        : mColon(colon),
          mWall(std::move(wall)),
          mFlat(mWall->mesh, mWall->neighbours, colon.centreline,
                LineOfSight(colon.volume.field, colon.volume.cells, colon.lumen.isovalue), UnfoldSetting{},
                progress) {}

    int width() const override { return mFlat.width(); }
    int height() const override { return mFlat.height(); }
    double pixel() const override { return mFlat.pixel(); }
    double columnAt(double along) const override { return mFlat.columnAt(along); }

    Plane<PackedColor> picture(const FlatTint& tint) const override {
        Plane<PackedColor> picture = mFlat.picture(mColon.volume.look, {});
        if (!tint) return picture;
        parallelFor(height(), [&](int y) {
            for (int x = 0; x < width(); ++x)
                if (const auto place = mFlat.placeAt(x, y)) {
                    PackedColor& color = picture.at(x, y);
                    color = packColor(tint(*place, unpackColor(color)));
                }
        });
        return picture;
    }

    std::optional<FlatPlace> placeAt(int x, int y) const override {
        const auto wall = mFlat.placeAt(x, y);
        if (!wall) return std::nullopt;
        const double along = mFlat.alongAt(x);
        return FlatPlace{*wall, placeAlong(mColon.centreline, along), along};
    }

    std::vector<glm::dvec2> pixelsOf(const glm::dvec3& world, double within) const override {
        const auto vertex = wallNextTo(mWall->mesh, world, within);
        if (!vertex) return {};
        return {mFlat.pixelOf(*vertex)};
    }

private:
    const ColonScene& mColon;
    std::shared_ptr<const JoinedWall> mWall;
    UnfoldedWall mFlat;
};

// Both strips of the panorama. The wall vertex of each pixel is kept, so that painting casts no rays.
class ColonPanoramaPicture final : public FlatPicture {
public:
    ColonPanoramaPicture(const ColonScene& colon, std::shared_ptr<const JoinedWall> wall, Progress& placing,
                         Progress& drawing)
        : mWall(std::move(wall)),
          mSight(colon.volume.field, colon.volume.cells, colon.lumen.isovalue),
          mPanorama(colon.volume.field, colon.centreline, mSight, UnfoldSetting{}.pixel, placing) {
        checkMemory("panorama", static_cast<double>(sizeof(Shown)) * width() * height(),
                    "use the command unfold --panorama");
        mPlaces.resize(width(), height());
        mPicture =
            mPanorama.picture(colon.volume.look, drawing, [this](int x, int y, const Panorama::Place& place) {
                mPlaces.at(x, y) = {place.wall, place.eye, true};
            });
    }

    int width() const override { return mPanorama.width(); }
    int height() const override { return mPanorama.rows(); }
    double pixel() const override { return mPanorama.pixel(); }
    double columnAt(double along) const override { return along / mPanorama.pixel(); }

    Plane<PackedColor> picture(const FlatTint& tint) const override {
        Plane<PackedColor> picture = mPicture;
        if (!tint) return picture;
        parallelFor(height(), [&](int y) {
            for (int x = 0; x < width(); ++x) {
                const Shown& shown = mPlaces.at(x, y);
                PackedColor& color = picture.at(x, y);
                if (shown.any) color = packColor(tint(glm::dvec3(shown.wall), unpackColor(color)));
            }
        });
        return picture;
    }

    std::optional<FlatPlace> placeAt(int x, int y) const override {
        if (x < 0 || x >= width() || y < 0 || y >= height() || !mPlaces.at(x, y).any) return std::nullopt;
        const Shown& shown = mPlaces.at(x, y);
        return FlatPlace{shown.wall, shown.eye, x * mPanorama.pixel()};
    }

    std::vector<glm::dvec2> pixelsOf(const glm::dvec3& world, double within) const override {
        const auto vertex = wallNextTo(mWall->mesh, world, within);
        if (!vertex) return {};
        // The line of sight ends just before the wall.
        const glm::dvec3 before = glm::dvec3(mWall->mesh.places[*vertex]) +
                                  0.5 * mSight.smallestSpacing() * glm::dvec3(mWall->mesh.normals[*vertex]);
        std::vector<glm::dvec2> pixels;
        for (const auto& at : mPanorama.pixelsOf(before))
            if (at) pixels.push_back(*at);
        return pixels;
    }

private:
    struct Shown {
        glm::vec3 wall{0.0f}, eye{0.0f};  // world, metres
        bool any = false;
    };
    std::shared_ptr<const JoinedWall> mWall;
    LineOfSight mSight;
    Panorama mPanorama;
    Plane<PackedColor> mPicture;
    Plane<Shown> mPlaces;
};

}  // namespace

std::shared_ptr<const FlatPicture> VolumeFlatWall::makeFlat(Progress& progress) const {
    Progress joining(progress, 0, 0.3), making(progress, 0.3, 1);
    const std::shared_ptr<const JoinedWall> wall = mWall.get(joining);
    return std::make_shared<const ColonFlatPicture>(mColon, wall, making);
}

std::shared_ptr<const FlatPicture> VolumeFlatWall::makePanorama(Progress& progress) const {
    Progress joining(progress, 0, 0.3), placing(progress, 0.3, 0.4), drawing(progress, 0.4, 1);
    const std::shared_ptr<const JoinedWall> wall = mWall.get(joining);
    return std::make_shared<const ColonPanoramaPicture>(mColon, wall, placing, drawing);
}

}  // namespace stereonav
