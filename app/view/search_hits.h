// What the search for commands, options and keys finds by words.
#pragma once

#include <string>
#include <vector>

#include "app/options/command.h"
#include "app/view/input.h"

namespace stereonav {

// One of these; the others are null.
struct SearchHit {
    const KeyHelp* key = nullptr;  // a key, or what a menu or panel has
    const Option* option = nullptr;
    const Command* command = nullptr;
};

// Returns what is found by all of the words, the best first: whole words count more than beginnings, and
// these more than parts. Without words, all keys, menus and options.
std::vector<SearchHit> searchHits(const std::string& words);

}  // namespace stereonav
