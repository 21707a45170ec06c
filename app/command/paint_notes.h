// Notes on paint that could not be drawn, each printed once.
#pragma once

#include "app/output/command_result.h"
#include "engine/render/paint_legend.h"
#include "engine/scene/scene.h"

namespace stereonav {

inline void tellPaintNotes(const Scene& scene, CommandResult& result) {
    const auto* const legend = scene.offered<const PaintLegend>();
    if (!legend || legend->notes.empty()) return;
    for (const std::string& note : legend->notes) result.say(note + "\n");
    result.add("paint_notes", legend->notes);
}

}  // namespace stereonav
