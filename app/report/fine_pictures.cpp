#include "app/report/fine_pictures.h"

#include <fmt/format.h>

#include "engine/metrics/supersampled_picture.h"
#include "terrain/cast/terrain_renderer.h"

namespace stereonav {
namespace {

struct FineOrder {
    std::size_t scene;
    FineView view;
    int factor;
    bool finestGround;
};

std::vector<Plane<PackedColor>> pictures(ReportRun& run, const ReportScene& scene,
                                         const std::vector<FineView>& views, int factor, bool finestGround) {
    std::vector<UntimedPiece> pieces;
    pieces.reserve(views.size());
    for (const FineView& view : views)
        pieces.push_back(
            pieceOf(Untimed::FinePicture, FineOrder{run.indexOf(scene), view, factor, finestGround}));
    std::vector<Plane<PackedColor>> all;
    for (const PeerBytes& piece : run.untimed().all(pieces)) {
        const EyeView& view = views[all.size()].view;
        all.emplace_back(view.width, view.height);
        ByteReader reader(piece);
        getRows(reader, 0, view.height, all.back());
    }
    return all;
}

}  // namespace

std::vector<Plane<PackedColor>> finePictures(ReportRun& run, const ReportScene& scene,
                                             const std::vector<FineView>& views, int factor) {
    return pictures(run, scene, views, factor, false);
}

std::vector<Plane<PackedColor>> finestGround(ReportRun& run, const ReportScene& scene,
                                             const std::vector<FineView>& views, int factor) {
    return pictures(run, scene, views, factor, true);
}

PeerBytes makeFinePicture(ReportRun& run, ByteReader& order) {
    const auto asked = order.get<FineOrder>();
    const ReportScene& scene = run.castScene(asked.scene);
    const std::string words = fmt::format("{} rays a pixel, {}", asked.factor * asked.factor, scene.title);
    run.tell(words);
    Progress telling([&](double, const std::string&) { run.tell(words); });
    Plane<PackedColor> picture;
    if (asked.finestGround) {
        const Scene& loaded = scene.loaded();
        const auto ground =
            run.untimed().kept<TerrainRenderer>(fmt::format("finest ground {}", asked.scene), [&] {
                auto renderer = std::make_shared<TerrainRenderer>(*terrainOf(loaded), loaded.simd,
                                                                  GroundFilter{false, 0});
                renderer->takeCoarser(0);
                return renderer;
            });
        picture = renderSupersampled(*ground, asked.view.view, asked.factor, telling);
    } else {
        picture = renderSupersampled(scene.frames(), asked.view.view, asked.view.time, asked.factor, telling);
    }
    ByteWriter writer;
    putRows(writer, 0, picture.height(), picture);
    return writer.take();
}

}  // namespace stereonav
