// A CT study as `info` describes it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <vector>

#include "app/command/info_text.h"
#include "colon/flight/colon_flight.h"
#include "colon/scene/colon_scene.h"
#include "engine/base/pages.h"

namespace stereonav {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kMm = 1000, kMl = 1e6;  // of a metre, of a cubic metre

struct GreyRange {
    double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
};

GreyRange wholeRange(const GreyVolume& grey) {
    GreyRange range;
    for (std::size_t n = 0; n < grey.frame.count() && !grey.empty(); ++n) {
        range.lowest = std::min<double>(range.lowest, grey.values[n]);
        range.highest = std::max<double>(range.highest, grey.values[n]);
    }
    return {range.lowest * grey.scale + grey.offset, range.highest * grey.scale + grey.offset};
}

// Pages in use: volumes are written where there is something.
std::vector<Held> heldBy(const ColonScene& colon) {
    std::vector<Held> held;
    const auto add = [&](const char* what, std::size_t bytes) {
        if (bytes > 0) held.push_back({what, bytes});
    };
    add("values", residentBytes(colon.volume.field.values));
    add("lumen", residentBytes(colon.lumen.lumen.values));
    add("distances", residentBytes(colon.distance.values));
    add("cells", colon.volume.cells.bytesHeld());
    if (const auto& light = colon.volume.look.baked.light) add("illumination", light->bytesHeld());
    return held;
}

std::string shapeName(PolypShape shape) {
    switch (shape) {
        case PolypShape::Pedunculated:
            return "pedunculated";
        case PolypShape::Sessile:
            return "sessile";
        case PolypShape::Flat:
            break;
    }
    return "flat";
}

std::vector<double> mmOf(const glm::dvec3& metres) {
    return {kMm * metres.x, kMm * metres.y, kMm * metres.z};
}

std::vector<int> sizeOf(const VolumeFrame& frame) {
    return {frame.size.x, frame.size.y, frame.size.z};
}

std::string sizeText(const VolumeFrame& frame) {
    return fmt::format("{} x {} x {}", frame.size.x, frame.size.y, frame.size.z);
}

double millilitres(const LumenField& lumen) {
    double sum = 0;
    for (const LumenSegment& segment : lumen.segments) sum += segment.volume;
    return kMl * sum;
}

// What the flight keeps from the wall, the eyes as far apart as they get.
FlightClearance clearanceIn(const Scene& scene) {
    const ColonScene& colon = *scene.offered<const ColonScene>();
    if (colon.path.samples().size() < 2) return {};
    const auto free = [&colon](const glm::dvec3& p, double upTo) { return colon.freeDistanceAt(p, upTo); };
    return clearanceOf(colon.path, free, scene.stereo.separation);
}

// Rounded down: what is kept is no less.
std::string clearanceText(const Scene& scene) {
    const FlightClearance kept = clearanceIn(scene);
    const auto mm = [](double metres) { return std::floor(kMm * metres * 100) / 100; };
    if (kept.head >= ColonFlight::kFarthestClearance)
        return fmt::format("{:g} mm or more from the wall", mm(ColonFlight::kFarthestClearance));
    return fmt::format("at least {:.2f} mm from the wall, an eye {:.2f} mm", mm(kept.head), mm(kept.eyes));
}

double isovalueOf(const ColonScene& colon) {
    return colon.volume.cells.isovalue * colon.volume.field.scale + colon.volume.field.offset;
}

}  // namespace

Json colonJson(const Scene& scene) {
    const ColonScene& colon = *scene.offered<const ColonScene>();
    const GreyVolume& field = colon.volume.field;
    const GreyRange range = wholeRange(field);
    Json json;
    json["kind"] = colon.isColon() ? "colon" : "isosurface";
    json["format"] = colon.format;
    // The study's own; what follows is of the grid that is shown: a part around the lumen, or one with a
    // border.
    json["study"] = {{"size", sizeOf(colon.studyFrame)},
                     {"spacing_mm", mmOf(colon.studyFrame.spacing)},
                     {"origin_mm", mmOf(colon.studyFrame.origin)}};
    json["size"] = sizeOf(field.frame);
    json["spacing_mm"] = mmOf(field.frame.spacing);
    json["origin_mm"] = mmOf(field.frame.origin);
    json["range"] = {range.lowest, range.highest};
    json["isovalue"] = isovalueOf(colon);
    json["translucent"] = !colon.volume.look.transfer.empty();
    json["segments"] = Json::array();
    for (const LumenSegment& segment : colon.lumen.segments)
        json["segments"].push_back({{"voxels", segment.voxels}, {"volume_ml", kMl * segment.volume}});
    json["volume_ml"] = millilitres(colon.lumen);
    json["centreline_mm"] = colon.isColon() ? kMm * colon.centreline.length() : 0.0;
    json["polyps"] = Json::array();
    for (const Polyp& polyp : colon.polyps)
        json["polyps"].push_back({{"shape", shapeName(polyp.shape)},
                                  {"diameter_mm", kMm * polyp.diameter},
                                  {"position_mm", mmOf(polyp.position)},
                                  {"along_mm", kMm * polyp.along}});
    json["records"] = colon.volume.cells.records.size();
    json["bytes"] = bytesOf(heldBy(colon));
    json["held"] = heldJson(heldBy(colon));
    json["flight_s"] = colon.path.samples().size() < 2 ? 0.0 : colon.path.duration();
    const FlightClearance kept = clearanceIn(scene);
    json["clearance_mm"] = kMm * kept.head;
    json["eye_clearance_mm"] = kMm * kept.eyes;
    json["notes"] = colon.notes;
    return json;
}

std::string colonText(const Scene& scene) {
    const ColonScene& colon = *scene.offered<const ColonScene>();
    const GreyVolume& field = colon.volume.field;
    const VolumeFrame& frame = field.frame;
    const GreyRange range = wholeRange(field);
    std::string text;
    const auto line = [&](const char* name, const std::string& value) { text += infoLine(name, value); };
    line("read by", colon.format);
    line("shown as", colon.isColon() ? "a colon, from inside" : "a surface, from outside");
    line("voxels", sizeText(colon.studyFrame));
    if (colon.isColon() && frame.size != colon.studyFrame.size)
        line("", sizeText(frame) + " of them around the lumen are kept");
    line("spacing", fmt::format("{:.4g} x {:.4g} x {:.4g} mm", kMm * frame.spacing.x, kMm * frame.spacing.y,
                                kMm * frame.spacing.z));
    line("values",
         // Those of a colon are around its lumen alone, without fluid; a mask's are smoothed.
         fmt::format("{:.6g} .. {:.6g}{}, surface at {:.6g}", range.lowest, range.highest,
                     colon.isColon() ? " of what is kept" : "", isovalueOf(colon)));
    line("wall", colon.volume.look.transfer.empty() ? "opaque" : "translucent");
    if (colon.isColon()) {
        line("segments", std::to_string(colon.lumen.segments.size()));
        for (const LumenSegment& segment : colon.lumen.segments)
            line("", fmt::format("{:.1f} ml, {} voxels", kMl * segment.volume, segment.voxels));
        line("volume", fmt::format("{:.1f} ml", millilitres(colon.lumen)));
        line("centreline", fmt::format("{:.0f} mm", kMm * colon.centreline.length()));
    }
    for (const Polyp& polyp : colon.polyps)
        line(&polyp == colon.polyps.data() ? "polyps" : "",
             fmt::format("{:.1f} mm {} at {:.0f} mm ({:.1f}, {:.1f}, {:.1f} mm)", kMm * polyp.diameter,
                         shapeName(polyp.shape), kMm * polyp.along, kMm * polyp.position.x,
                         kMm * polyp.position.y, kMm * polyp.position.z));
    if (colon.path.samples().size() > 1)
        line("flight", fmt::format("{:.4g} s, {}", colon.path.duration(), clearanceText(scene)));
    line("memory", heldText(heldBy(colon)));
    for (const std::string& note : colon.notes) line("note", note);
    return text;
}

}  // namespace stereonav
