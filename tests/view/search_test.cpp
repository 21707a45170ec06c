// The search finds what does it by the words that people of other programs type.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <utility>

#include "app/view/search_hits.h"

namespace stereonav {
namespace {

std::string nameOf(const SearchHit& hit) {
    if (hit.key) return hit.key->keys;
    return hit.option ? hit.option->name() : std::string("stereonav ") + hit.command->name;
}

constexpr std::size_t kSeen = 8;  // rows that are in sight

// Words, and the keys, menu, option or command among the first that are found.
constexpr std::pair<const char*, const char*> kWanted[] = {
    // Words of Slicer and ParaView.
    {"orbit", "Ctrl+R"},
    {"rotate", "Ctrl+R"},
    {"zoom", "wheel, right drag"},
    {"pan", "drag, Shift+drag"},
    {"trackball", "Ctrl+R"},
    {"camera", "Ctrl+R"},
    {"reset view", "R"},
    {"reset camera", "Space"},
    {"window level", "V"},
    {"window/level", "V"},
    {"threshold", "--isovalue"},
    {"isosurface", "--isosurface"},
    {"contour", "--isovalue"},
    {"opacity", "--opacity"},
    {"transparency", "T"},
    {"colormap", "--transfer"},
    {"color map", "--transfer"},
    {"lookup table", "--transfer"},
    {"transfer function", "F2, Material"},
    {"volume rendering", "T"},
    {"mpr", "V"},
    {"axial", "V"},
    {"segmentation", "V"},
    {"fiducial", "Ctrl+F"},
    {"markup", "Ctrl+F"},
    {"annotation", "Ctrl+F"},
    {"ruler", "Ctrl+M"},
    {"measure distance", "Ctrl+M"},
    {"measure distance", "F3, Measure"},
    {"export mesh", "stereonav mesh"},
    {"save scene", "Ctrl+S"},
    {"load data", "Ctrl+O"},
    {"import dicom", "Ctrl+O"},
    {"background", "--sky"},
    {"ssao", "--ambient"},
    // Words of QGIS.
    {"hillshade", "--sun"},
    {"hillshade", "--paint"},
    {"slope", "--paint"},
    {"aspect", "--paint"},
    {"viewshed", "--paint"},
    {"symbology", "--paint"},
    {"exaggeration", "--vertical-scale"},
    {"layer", "--image"},
    {"raster layer", "--image"},
    {"vector layer", "--tracks"},
    {"gpx", "--tracks"},
    {"satellite", "--image"},
    {"contour lines", "--contours"},
    {"curvature", "--curvature"},
    {"elevation profile", "F3, Measure"},
    {"area", "Ctrl+M"},
    {"coordinates", "Ctrl+C"},
    {"identify", "Ctrl+C"},
    {"bookmark", "Ctrl+B"},
    {"overview", "F3, Map"},
    {"labels", "View"},
    {"sunrise", "F2, Light"},
    // Words of VLC and stereo players.
    {"fly", "Shift+Z"},
    {"fly", "W S A D"},
    {"play", "Shift+Z"},
    {"pause", "Shift+Z"},
    {"record", "z"},
    {"video", "Flight"},
    {"movie", "Flight"},
    {"mp4", "Flight"},
    {"screenshot", "P F12"},
    {"snapshot", "P F12"},
    {"export image", "File"},
    {"jps", "File"},
    {"stereo", "3"},
    {"3d", "3"},
    {"anaglyph", "9"},
    {"anaglyph", "--mode"},
    {"red cyan", "9"},
    {"glasses", "9"},
    {"interlaced", "6"},
    {"side-by-side", "--mode"},
    {"side by side", "1"},
    {"over under", "5"},
    {"swap eyes", "X"},
    {"separation", "--separation"},
    {"interocular", "[ ]"},
    {"convergence", "--zero-parallax"},
    {"fullscreen", "F11"},
    {"full screen", "--full-screen"},
    {"brightness", "--exposure"},
    {"speed", "wheel, Shift"},
    {"faster", "wheel, Shift"},
    {"fps", "--target-ms"},
    {"antialiasing", "--edges"},
    {"settings", "F2"},
    {"preferences", "F2"},
    {"shortcuts", "F1"},
    {"help", "F1"},
    {"undo", "Ctrl+Z"},
    {"redo", "Ctrl+Y"},
    {"exit", "Ctrl+Q"},
    {"font", "View"},
    {"theme", "View"},
    // Words of readers of colons.
    {"polyp", "Ctrl+F"},
    {"candidates", "F3, Findings"},
    {"unfold", "F10"},
    {"coverage", "F9"},
    {"centreline", "stereonav centreline"},
    {"prone", "File"},
};

TEST(ViewSearch, WordsOfOtherProgramsFindWhatDoesIt) {
    for (const auto& [words, wanted] : kWanted) {
        const auto hits = searchHits(words);
        const auto end = hits.begin() + static_cast<std::ptrdiff_t>(std::min(hits.size(), kSeen));
        const bool found = std::any_of(
            hits.begin(), end, [&, name = wanted](const SearchHit& hit) { return nameOf(hit) == name; });
        std::string seen;
        for (auto hit = hits.begin(); hit != end; ++hit) seen += "\n  " + nameOf(*hit);
        EXPECT_TRUE(found) << words << " does not find " << wanted << ", but" << seen;
    }
}

TEST(ViewSearch, WholeWordsComeFirstAndAllHaveToOccur) {
    const auto hits = searchHits("fly");
    ASSERT_FALSE(hits.empty());
    ASSERT_TRUE(hits.front().key);
    EXPECT_NE((hits.front().key->meaning + " " + hits.front().key->also).find("fly"), std::string::npos);
    EXPECT_TRUE(searchHits("fly hippopotamus").empty());
    EXPECT_EQ(nameOf(searchHits("SwAp   EYES").front()), "X");
}

// A row has a meaning at the left and its key at the right.
TEST(ViewSearch, NoMeaningReachesItsKey) {
    for (const auto* entries : {&viewKeys(), &menuEntries()})
        for (const KeyHelp& entry : *entries) {
            EXPECT_LE(entry.meaning.size(), 64u) << entry.meaning;
            EXPECT_LE(entry.keys.size(), 17u) << entry.keys;
        }
}

TEST(ViewSearch, WithoutWordsAllIsThereOnce) {
    const auto hits = searchHits(" ");
    std::size_t keys = 0, options = 0;
    std::set<std::string> names;
    for (const SearchHit& hit : hits) {
        EXPECT_EQ((hit.key != nullptr) + (hit.option != nullptr) + (hit.command != nullptr), 1);
        keys += hit.key != nullptr;
        options += hit.option != nullptr;
        if (hit.option) {
            EXPECT_NE(hit.option->panel, OptionPanel::None) << hit.option->key;
        }
    }
    EXPECT_EQ(keys, viewKeys().size() + menuEntries().size());
    EXPECT_GT(options, 40u);
}

}  // namespace
}  // namespace stereonav
