// Notes on what is seen in a picture, or is not, each printed once.
#pragma once

#include <cstdio>

#include "app/output/command_result.h"
#include "engine/render/paint_legend.h"
#include "engine/scene/scene.h"
#include "engine/text/printed.h"

namespace stereonav {

// Notes on paint that could not be drawn.
inline void tellPaintNotes(const Scene& scene, CommandResult& result) {
    const auto* const legend = scene.offered<const PaintLegend>();
    if (!legend || legend->notes.empty()) return;
    for (const std::string& note : legend->notes) result.say(note + "\n");
    result.add("paint_notes", legend->notes);
}

// The scene's warning, on standard error.
inline void tellWarning(const Scene& scene, const Telling& telling, CommandResult& result) {
    if (scene.warning.empty()) return;
    if (!telling.quiet) printLine(stderr, "note: " + scene.warning);
    result.add("warning", scene.warning);
}

}  // namespace stereonav
