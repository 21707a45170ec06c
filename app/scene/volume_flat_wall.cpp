#include "app/scene/volume_flat_wall.h"

#include <glm/geometric.hpp>
#include <utility>

#include "colon/instruments/polyp.h"
#include "colon/instruments/registration.h"
#include "colon/instruments/unfolding.h"
#include "colon/wall/line_of_sight.h"
#include "engine/base/parallel.h"

namespace stereonav {
namespace {

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

    std::optional<glm::dvec2> pixelOf(const glm::dvec3& world, double within) const override {
        const std::uint32_t vertex = nearestVertex(mWall->mesh, world);
        if (glm::distance(glm::dvec3(mWall->mesh.places[vertex]), world) > within) return std::nullopt;
        return mFlat.pixelOf(vertex);
    }

private:
    const ColonScene& mColon;
    std::shared_ptr<const JoinedWall> mWall;
    UnfoldedWall mFlat;
};

}  // namespace

std::shared_ptr<const FlatPicture> VolumeFlatWall::makeFlat(Progress& progress) const {
    return std::make_shared<const ColonFlatPicture>(mColon, mWall.get(progress), progress);
}

}  // namespace stereonav
