#include "app/scene/terrain/ground_paint.h"

#include <fmt/format.h>

#include <utility>

#include "app/options/paint_words.h"
#include "engine/text/length_text.h"
#include "terrain/paint/contour_painter.h"
#include "terrain/scene/slope_color.h"

namespace stereonav {
namespace {

// Returns the interval of contours in metres; 0: no contours.
double contourIntervalOf(const TerrainScene& terrain, const GroundPaintOptions& options) {
    if (!options.contoursAuto) return options.contours_m.value_or(0);
    const Heightfield& ground = terrain.ground;
    return contourIntervalFor((double(ground.maxHeight()) - ground.minHeight()) / terrain.verticalScale);
}

}  // namespace

GroundPaint groundPaintOf(const SceneOptions& options) {
    return groundPaintOf(options.paint);
}

GroundPaint groundPaintOf(const std::string& paint) {
    return groundPaintNamed(paintAskedOf(paint).word).value_or(GroundPaint::None);
}

std::shared_ptr<const EyePainter> contoursOf(const TerrainScene& terrain, const Fog& fog,
                                             const GroundPaintOptions& options, PaintLegend& legend) {
    const double interval = contourIntervalOf(terrain, options);
    if (!(interval > 0)) return nullptr;
    legend.legends.push_back({"contours",
                              {{glm::vec3(kContourInk[0], kContourInk[1], kContourInk[2]),
                                fmt::format("every {}", lengthText(interval))}}});
    return std::make_shared<ContourPainter>(terrain.ground, fog,
                                            ContourSetting{interval, terrain.verticalScale});
}

void addLegend(const PaintLegend& legend, Facts& facts) {
    FactList list;
    for (const Legend& part : legend.legends) {
        std::string words;
        for (const LegendEntry& entry : part.entries) words += (words.empty() ? "" : "; ") + entry.text;
        list.text(part.title, words);
    }
    for (const std::string& note : legend.notes) list.text("note", note);
    for (Fact& fact : list.facts()) facts.push_back(std::move(fact));
}

}  // namespace stereonav
