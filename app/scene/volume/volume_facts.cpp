#include "app/scene/volume/volume_facts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "app/scene/type/held_facts.h"
#include "app/scene/volume/inside.h"
#include "colon/flight/colon_flight.h"
#include "colon/scene/colon_scene.h"
#include "engine/base/pages.h"
#include "engine/volume/value_range.h"

namespace stereonav {
namespace {

constexpr double kMm = 1000, kMl = 1e6;  // millimetres in a metre, millilitres in a cubic metre

// Returns the memory in use, by pages: large volumes occupy memory only where they were written.
std::vector<Held> heldBy(const ColonScene& colon) {
    std::vector<Held> held;
    const auto add = [&](const char* what, std::size_t bytes) {
        if (bytes > 0) held.push_back({what, bytes});
    };
    add("values", residentBytes(colon.volume.field.values));
    add("lumen", residentBytes(colon.lumen.lumen.values));
    add("cells", colon.volume.cells.bytesHeld());
    if (const auto& light = colon.volume.look.baked.light) add("illumination", light->bytesHeld());
    if (const auto& seen = colon.volume.look.studio.seen) add("sky", residentBytes(seen->words));
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

FactNumbers mmOf(const glm::dvec3& metres) {
    return {kMm * metres.x, kMm * metres.y, kMm * metres.z};
}

FactIntegers sizeOf(const VolumeFrame& frame) {
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

// Returns the distance that the flight keeps from the wall, with the eyes as far apart as they get.
FlightClearance clearanceIn(const Scene& scene) {
    const ColonScene& colon = *scene.offered<const ColonScene>();
    if (colon.path.samples().size() < 2) return {};
    const auto free = [&colon](const glm::dvec3& p, double upTo) { return colon.freeDistanceAt(p, upTo); };
    return clearanceOf(colon.path, free, scene.stereo.separation);
}

// Returns the distances rounded down, so that the true ones are no smaller.
std::string clearanceText(const FlightClearance& kept) {
    const auto mm = [](double metres) { return std::floor(kMm * metres * 100) / 100; };
    if (kept.head >= ColonFlight::kFarthestClearance)
        return fmt::format("{:g} mm or more from the wall", mm(ColonFlight::kFarthestClearance));
    return fmt::format("at least {:.2f} mm from the wall, an eye {:.2f} mm", mm(kept.head), mm(kept.eyes));
}

double isovalueOf(const ColonScene& colon) {
    return colon.volume.cells.isovalue * colon.volume.field.scale + colon.volume.field.offset;
}

// metres: over which a mask was smoothed.
std::string maskText(double metres) {
    return metres > 0 ? fmt::format("smoothed over {:.3g} mm of its wall", kMm * metres)
                      : "not smoothed: --mask-smoothing 0";
}

std::vector<Facts> segmentFacts(const ColonScene& colon, bool inside) {
    std::vector<Facts> segments;
    for (const LumenSegment& segment : colon.lumen.segments) {
        const double volume = kMl * segment.volume;
        Facts facts{factForJson("voxels", countOf(segment.voxels)), factForJson("volume_ml", volume, "ml")};
        if (inside)
            facts.push_back(factForText("", fmt::format("{:.1f} ml, {} voxels", volume, segment.voxels)));
        segments.push_back(std::move(facts));
    }
    return segments;
}

std::vector<Facts> polypFacts(const ColonScene& colon) {
    std::vector<Facts> polyps;
    for (const Polyp& polyp : colon.polyps) {
        const std::string shape = shapeName(polyp.shape);
        const FactNumbers position = mmOf(polyp.position);
        const double diameter = kMm * polyp.diameter, along = kMm * polyp.along;
        polyps.push_back(
            {factForJson("shape", shape), factForJson("diameter_mm", diameter, "mm"),
             factForJson("position_mm", position, "mm"), factForJson("along_mm", along, "mm"),
             factForText(polyps.empty() ? "polyps" : "",
                         fmt::format("{:.1f} mm {} at {:.0f} mm ({:.1f}, {:.1f}, {:.1f} mm)", diameter, shape,
                                     along, position[0], position[1], position[2]))});
    }
    return polyps;
}

}  // namespace

Facts factsOfVolume(const Scene& scene) {
    const ColonScene& colon = *scene.offered<const ColonScene>();
    const VolumeFrame& study = colon.studyFrame;
    const VolumeFrame& frame = colon.volume.field.frame;
    const bool inside = scene.offered<const ColonInterior>() != nullptr;
    const ValueSpan range = inside ? colon.valuesFound : wholeRangeOf(colon.volume.field);
    const bool opaque = colon.volume.look.transfer.empty();
    FactList list;
    list.json("kind", inside ? "colon" : "isosurface");
    list.both("format", colon.format, "read by");
    list.text("shown as", inside ? "a colon, from inside" : "a surface, from outside");
    // Facts of the study itself; those below describe the grid that is shown: a part around the lumen, or the
    // whole with a border.
    list.json("study", Facts{factForAll("size", sizeOf(study), "voxels"),
                             factForJson("spacing_mm", mmOf(study.spacing), "mm"),
                             factForJson("origin_mm", mmOf(study.origin), "mm")});
    if (inside && frame.size != study.size)
        list.both("size", sizeOf(frame), "", sizeText(frame) + " of them around the lumen are kept");
    else
        list.json("size", sizeOf(frame));
    const FactNumbers spacing = mmOf(frame.spacing);
    list.both("spacing_mm", spacing, "spacing",
              fmt::format("{:.4g} x {:.4g} x {:.4g} mm", spacing[0], spacing[1], spacing[2]), "mm");
    list.json("origin_mm", mmOf(frame.origin), "mm");
    list.json("range", FactNumbers{range.lowest, range.highest});
    const double isovalue = isovalueOf(colon);
    list.json("isovalue", isovalue);
    // Values of a colon are those of its box, without fluid; a mask's are smoothed.
    list.text("values", fmt::format("{:.6g} .. {:.6g}{}, surface at {:.6g}", range.lowest, range.highest,
                                    inside ? " in the lumen's box" : "", isovalue));
    if (colon.maskSmoothed)
        list.both("mask_smoothing_mm", kMm * *colon.maskSmoothed, "mask", maskText(*colon.maskSmoothed),
                  "mm");
    list.both("translucent", !opaque, "wall", opaque ? "opaque" : "translucent");
    // Adds a fact only where the lumen is a colon's.
    const auto ofColon = [&](const char* key, FactValue value, const char* label, std::string words,
                             const char* unit) {
        if (inside)
            list.both(key, std::move(value), label, std::move(words), unit);
        else
            list.json(key, std::move(value), unit);
    };
    ofColon("segments", segmentFacts(colon, inside), "segments", "", "");
    const double volume = millilitres(colon.lumen);
    ofColon("volume_ml", volume, "volume", fmt::format("{:.1f} ml", volume), "ml");
    const double length = inside ? kMm * colon.centreline.length() : 0.0;
    ofColon("centreline_mm", length, "centreline", fmt::format("{:.0f} mm", length), "mm");
    list.json("polyps", polypFacts(colon));
    list.json("records", countOf(colon.volume.cells.active));
    const std::string memory = addHeld(list.facts(), heldBy(colon));
    const bool flies = colon.path.samples().size() > 1;
    const double flight = flies ? colon.path.duration() : 0.0;
    list.json("flight_s", flight, "s");
    const FlightClearance kept = clearanceIn(scene);
    list.json("clearance_mm", kMm * kept.head, "mm");
    list.json("eye_clearance_mm", kMm * kept.eyes, "mm");
    if (flies) list.text("flight", fmt::format("{:.4g} s, {}", flight, clearanceText(kept)));
    list.text("memory", memory);
    list.json("notes", colon.notes);
    for (const std::string& note : colon.notes) list.text("note", note);
    return std::move(list.facts());
}

}  // namespace stereonav
