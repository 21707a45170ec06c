// A transfer function as one word, for option values: "curve:" and what its file's lines say, each line's
// words parted by colons, lines by commas (docs/formats.md).
#pragma once

#include <string>
#include <string_view>

#include "engine/volume/transfer_function.h"

namespace stereonav {

// Most points of a curve in a word: more belong into a file.
constexpr std::size_t kMostCurvePoints = 256;

// Returns whether the text is a curve, right or wrong, and no file's name.
bool isCurveText(std::string_view text);
// Reads a curve. Throws Error, named `source`, with the point's place.
TransferFunction transferFromCurve(std::string_view text, const std::string& source);
// Returns a curve, colours to four digits of sRGB, the reference length to nine digits of millimetres: what
// is read back gives the same text again.
std::string curveTextOf(const TransferFunction& function);

}  // namespace stereonav
