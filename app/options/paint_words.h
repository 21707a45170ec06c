// The words of --paint: each is for some types of scenes and may have an argument after a colon.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/options/option_table.h"

namespace stereonav {

struct PaintWord {
    const char* word;   // "viewshed"
    const char* takes;  // argument after the colon, for help: "X,Y,HEIGHT"; "": none
    SceneSet scenes;    // types of scenes that have the word

    // Returns what is wrong with the argument; null: the word has no argument.
    std::optional<ValueProblem> (*problem)(const std::string& rest) = nullptr;
};

// Returns all words; those of each type of scene are declared in a file of their own.
std::vector<PaintWord> paintWords();
std::vector<PaintWord> groundPaintWords();   // paint_words_ground.cpp
std::vector<OptionRule> groundPaintRules();  // rules of --paint
std::vector<PaintWord> colonPaintWords();    // paint_words_colon.cpp
std::vector<OptionRule> colonPaintRules();   // rules of --paint

// Words for colons.
constexpr const char *kPaintCoverage = "coverage", *kPaintBothWays = "both";

// A value of --paint, split at its first colon.
struct PaintAsked {
    std::string word, rest;
};
PaintAsked paintAskedOf(const std::string& text);

}  // namespace stereonav
