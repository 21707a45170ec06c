#include "app/scene/volume/coverage.h"

#include <utility>

#include "app/scene/volume/flights.h"
#include "colon/instruments/coverage.h"
#include "colon/instruments/wall_painter.h"

namespace stereonav {
namespace {

CoverageSetting settingOf(const WallLooking& looking) {
    CoverageSetting setting;
    setting.within = looking.within;
    setting.angle = looking.angle;
    setting.smallestPatch = looking.smallestPatch;
    return setting;
}

class SeenOfColon final : public WallSeen {
public:
    SeenOfColon(const ColonScene& colon, const ColonInterior& inside, std::shared_ptr<const JoinedWall> wall,
                const WallLooking& looking)
        : mColon(colon),
          mInside(inside),
          mWall(std::move(wall)),
          mSight(colon.volume.field, colon.volume.cells, colon.lumen.isovalue),
          mCoverage(mWall->mesh, mWall->neighbours, mSight, settingOf(looking)) {}

    void look(std::span<const EyeView> eyes, Progress& progress) override { mCoverage.look(eyes, progress); }
    void judgeBy(const WallLooking& looking) override { mCoverage.startAgain(settingOf(looking)); }
    double percent() const override { return mCoverage.percent(); }

    std::vector<UnseenPart> unseen() const override {
        const auto freeDistance = [&](const glm::dvec3& place, double upTo) {
            return mColon.freeDistanceAt(place, upTo);
        };
        std::vector<UnseenPart> parts;
        for (const UnseenPatch& patch : mCoverage.patches(freeDistance, mColon.clearance))
            parts.push_back({patch.area, patch.place, mInside.placeOnLine(patch.place).along, patch.view});
        return parts;
    }

    std::shared_ptr<const EyePainter> painter() const override {
        return wallPainter(mWall->mesh, mWall->neighbours, mColon.volume.field.frame,
                           unseenMarks(mCoverage.seen()), kUnseenTint);
    }

private:
    const ColonScene& mColon;
    const ColonInterior& mInside;
    std::shared_ptr<const JoinedWall> mWall;
    LineOfSight mSight;
    Coverage mCoverage;
};

}  // namespace

std::unique_ptr<WallSeen> VolumeCoverage::begin(const WallLooking& looking, Progress& progress) const {
    return std::make_unique<SeenOfColon>(mColon, mInside, mWall.get(progress), looking);
}

std::vector<Pose> VolumeCoverage::ownFlight(bool back) const {
    const auto freeDistance = [&](const glm::dvec3& place, double upTo) {
        return mColon.freeDistanceAt(place, upTo);
    };
    ColonFlights flights = colonFlights(mColon, "", kFlightStep, freeDistance, mInside);
    return std::move(back ? flights.back : flights.there);
}

}  // namespace stereonav
