#include "app/scene/volume/slice_pieces.h"

#include <fmt/format.h>

#include "colon/segmentation/air_measures.h"
#include "colon/segmentation/segmentation_air.h"

namespace stereonav {
namespace {

// Millilitres below which a piece gets no description; neither does one outside the body.
constexpr double kWorthWords = 0.02;

AirPieces airOf(const SliceStudy& study, const SegmentationSetting& setting, Progress& progress) {
    AirPieces air;
    if (!study.ofMask) return findAir(study.grey, setting, {}, progress);
    air.pieces.runs = runsAbove(study.grey, 0.5);
    air.pieces.parts = connectedComponents(air.pieces.runs);
    air.kinds.assign(air.pieces.parts.list.size(), AirKind::Colon);
    air.reasons.resize(air.kinds.size());
    return air;
}

}  // namespace

SlicePieces slicePieces(const SliceStudy& study, const SegmentationSetting& setting, Progress& progress) {
    AirPieces air = airOf(study, setting, progress);
    const AirMeasures measures(study.grey, air.pieces);
    SlicePieces pieces;
    if (!study.ofMask) pieces.fluidAbove = setting.tagged;
    pieces.list.resize(air.kinds.size());
    for (std::size_t n = 0; n < air.kinds.size(); ++n) {
        const int piece = static_cast<int>(n);
        const double volume_ml = measures.volume(piece) * 1e6;
        if (air.kinds[n] == AirKind::Outside || volume_ml < kWorthWords) continue;
        const std::string& reason = air.reasons[n].text;
        pieces.list[n] = {measures.placeIn(piece),
                          fmt::format("{:.1f} ml{}{}", volume_ml, study.ofMask ? "" : " of gas",
                                      !reason.empty()                  ? ": " + reason
                                      : air.kinds[n] == AirKind::Small ? ": small"
                                                                       : ""),
                          air.reasons[n].sure};
    }
    pieces.runs = std::move(air.pieces.runs);
    pieces.parts = std::move(air.pieces.parts);
    return pieces;
}

}  // namespace stereonav
