// The words of --paint: each of some types of scenes, with what may follow it after a colon.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/options/option_table.h"

namespace stereonav {

struct PaintWord {
    const char* word;   // "viewshed"
    const char* takes;  // what follows the colon, as help shows it: "X,Y,HEIGHT"; "": nothing
    SceneSet scenes;    // the types that it is for

    // What is wrong with what follows; null: nothing may follow.
    std::optional<ValueProblem> (*problem)(const std::string& rest) = nullptr;
};

// All, each type's from a file of its own.
std::vector<PaintWord> paintWords();
std::vector<PaintWord> groundPaintWords();   // paint_words_ground.cpp
std::vector<OptionRule> groundPaintRules();  // rules of --paint
std::vector<PaintWord> colonPaintWords();    // paint_words_colon.cpp
std::vector<OptionRule> colonPaintRules();   // rules of --paint

// Words of colons.
constexpr const char *kPaintCoverage = "coverage", *kPaintBothWays = "both";

// A value of --paint, cut at its first colon.
struct PaintAsked {
    std::string word, rest;
};
PaintAsked paintAskedOf(const std::string& text);

}  // namespace stereonav
