#include "terrain/read/gdal/raster_words.h"

#include <algorithm>
#include <cctype>
#include <string_view>
#include <vector>

namespace stereonav {
namespace {

bool isLetter(char c) {
    return std::isalpha(static_cast<unsigned char>(c)) != 0;
}

// Returns words in small letters. A capital after a small letter begins a word too: demSlope.
std::vector<std::string> wordsIn(const std::string& text) {
    std::vector<std::string> words(1);
    for (std::size_t n = 0; n < text.size(); ++n) {
        const char c = text[n];
        const bool camel = n > 0 && std::islower(static_cast<unsigned char>(text[n - 1])) &&
                           std::isupper(static_cast<unsigned char>(c));
        if (!isLetter(c) || camel) words.emplace_back();
        if (isLetter(c)) words.back() += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
    std::erase(words, "");
    return words;
}

bool isOneOf(std::string_view word, const std::vector<std::string_view>& words) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

bool beginsLike(std::string_view word, const std::vector<std::string_view>& begins) {
    return std::any_of(begins.begin(), begins.end(),
                       [&](std::string_view begin) { return word.starts_with(begin); });
}

}  // namespace

bool speaksOfHeights(const std::string& text) {
    static const std::vector<std::string_view> others{"err",   "uncert", "qual", "mask", "count",
                                                      "slope", "aspect", "std",  "sigma"},
        begins{"elev", "height", "altitude", "topograph", "bathy"},
        wholes{"dem", "dtm", "dsm", "hgt", "alt", "topo", "z"};
    bool heights = false;
    for (const std::string& word : wordsIn(text)) {
        if (beginsLike(word, others)) return false;
        heights |= beginsLike(word, begins) || isOneOf(word, wholes);
    }
    return heights;
}

bool fileIsCalledHeights(const std::string& stem) {
    std::string text;
    for (const std::string& word : wordsIn(stem))
        if (word != "z") text += word + ' ';
    return speaksOfHeights(text);
}

bool namedForOtherThings(const std::string& stem) {
    static const std::vector<std::string_view> begins{
        "err",     "uncert", "qual",      "mask",      "count",   "slope",  "aspect",    "std",
        "sigma",   "hillsh", "shade",     "rough",     "rugged",  "confid", "coher",     "varian",
        "densit",  "intens", "class",     "landcover", "landuse", "water",  "flow",      "accum",
        "curvat",  "geoid",  "undul",     "dist",      "source",  "date",   "footprint", "browse",
        "preview", "thumb",  "quicklook", "match",     "bitmask", "ortho",  "viewshed",  "illum",
        "insol",   "stack",  "weight",    "valid",     "cloud",   "canopy", "veget",     "ndvi"};
    static const std::vector<std::string_view> wholes{
        "num", "stk", "msk", "hem", "edm", "flm", "wbm", "swb", "wam", "amp",  "cov", "com", "lsm", "att",
        "tri", "tpi", "qa",  "qc",  "tid", "sd",  "ql",  "rgb", "chm", "ndsm", "hs",  "inc", "mad", "acm"};
    const std::vector<std::string> words = wordsIn(stem);
    return std::any_of(words.begin(), words.end(), [](const std::string& word) {
        return beginsLike(word, begins) || isOneOf(word, wholes);
    });
}

std::string lastWordOf(const std::string& stem) {
    if (stem.empty() || !isLetter(stem.back())) return "";
    return wordsIn(stem).back();
}

}  // namespace stereonav
