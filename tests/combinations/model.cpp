#include "tests/combinations/model.h"

#include <algorithm>
#include <stdexcept>

namespace stereonav::test {
namespace {

using Names = std::vector<std::string>;

const Names kScenes{"hills.asc", "relief.tif", "scene.toml", "built.toml", "balls.nrrd", "body.nii.gz",
                    "mask.mha",  "dicom",      "tube.nrrd",  "cloud",      "wax",        "mesh.glb"};
const Names kToml{"scene.toml", "built.toml"};
const Names kTerrains{"hills.asc", "relief.tif", "scene.toml", "built.toml"};
const Names kOutside{"balls.nrrd", "body.nii.gz", "mask.mha", "dicom"};
const Names kColons{"tube.nrrd"};
const Names kBuiltInMedia{"cloud", "wax"};
const Names kMeshes{"mesh.glb"};
const Names kPairMethods{"sweep", "own-samples", "two-sweeps", "depthsplat"};

Names operator+(Names a, const Names& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

const FactorLevels& tableOf(Factor factor) {
    return factorTable()[static_cast<std::size_t>(factor)];
}

Clause::Part is(Factor factor, const Names& levels) {
    const Names& all = tableOf(factor).levels;
    LevelSet set = 0;
    for (const std::string& level : levels) {
        const auto at = std::find(all.begin(), all.end(), level);
        if (at == all.end()) throw std::logic_error("no level \"" + level + "\"");
        set |= LevelSet{1} << (at - all.begin());
    }
    return {static_cast<int>(factor), set};
}
Clause::Part isNot(Factor factor, const Names& levels) {
    const LevelSet all = (LevelSet{1} << tableOf(factor).levels.size()) - 1;
    return {static_cast<int>(factor), all & ~is(factor, levels).levels};
}
Clause::Part isGiven(Factor factor) {
    return isNot(factor, {tableOf(factor).levels.front()});
}
Clause::Part isLeftOut(Factor factor) {
    return is(factor, {tableOf(factor).levels.front()});
}

struct NamedOption {
    Factor factor;
    const char* option;
};

// Options of one kind of scene with another.
void addKinds(std::vector<Rule>& all) {
    const NamedOption ofVolumes[]{{Factor::Isovalue, "--isovalue"},
                                  {Factor::Ambient, "--ambient"},
                                  {Factor::Shading, "--shading"},
                                  {Factor::Modulation, "--modulate"},
                                  {Factor::Exposure, "--exposure"},
                                  {Factor::Turn, "--turn"},
                                  {Factor::Up, "--up"}};
    for (const auto& [factor, option] : ofVolumes)
        all.push_back(
            {"terrains have none of it", option, {{is(Factor::Scene, kTerrains), isGiven(factor)}}});
    all.push_back({"terrains are opaque", "--", {{is(Factor::Scene, kTerrains), isGiven(Factor::Opacity)}}});
    all.push_back(
        {"generated without", "--open-holes", {{is(Factor::Scene, {"built.toml"}), isGiven(Factor::Holes)}}});
    all.push_back({"a picture that holds the light of its own day",
                   "--sun",
                   {{is(Factor::Scene, kTerrains), isGiven(Factor::Photo), isGiven(Factor::Sun),
                     isLeftOut(Factor::Medium), isLeftOut(Factor::Light), isLeftOut(Factor::Landmark),
                     isLeftOut(Factor::Highlight)}}});
    const NamedOption ofTerrains[]{{Factor::Photo, "--image"},
                                   {Factor::Holes, "--open-holes"},
                                   {Factor::Heights, "--vertical-scale"},
                                   {Factor::Detail, "--ground-detail"}};
    for (const auto& [factor, option] : ofTerrains)
        all.push_back(
            {"volumes have none of it", option, {{isNot(Factor::Scene, kTerrains), isGiven(factor)}}});
    all.push_back({"volumes and media have none",
                   "--sun",
                   {{isNot(Factor::Scene, kTerrains + kMeshes), isGiven(Factor::Sun)}}});
    for (const Factor factor : {Factor::Fog, Factor::Highlight, Factor::Landmark})
        all.push_back({"keys of scene files", "", {{isNot(Factor::Scene, kToml), isGiven(factor)}}});
    for (const auto& [factor, option] : {NamedOption{Factor::Isovalue, "--isovalue"},
                                         {Factor::Ambient, "--ambient"},
                                         {Factor::Modulation, "--modulate"}})
        all.push_back(
            {"of volumes seen from outside", option, {{is(Factor::Scene, kColons), isGiven(factor)}}});
    all.push_back(
        {"of volumes seen from outside", "--up", {{is(Factor::Scene, kColons), isGiven(Factor::Up)}}});
}

void addLight(std::vector<Rule>& all) {
    const Names volumes = kOutside + kColons;
    for (const auto& [factor, option] :
         {NamedOption{Factor::Sky, "--sky"}, {Factor::Turn, "--turn"}, {Factor::Exposure, "--exposure"}})
        all.push_back({"expects baked light",
                       option,
                       {{is(Factor::Scene, volumes), isLeftOut(Factor::Light), isGiven(factor)}}});
    const Names still{"irradiance", "openness", "full"};
    for (const Factor factor : {Factor::Sky, Factor::Turn})
        all.push_back({"light that stands still",
                       "transfer",
                       {{is(Factor::Scene, volumes), is(Factor::Light, still), isGiven(factor)}}});
    all.push_back({"one of the two",
                   "--ambient",
                   {{isNot(Factor::Scene, kTerrains), isGiven(Factor::Light), isGiven(Factor::Ambient)}}});
    all.push_back(
        {"it takes its place", "--shading", {{isGiven(Factor::Ambient), is(Factor::Shading, {"varying"})}}});
    all.push_back({"it is all the light there is",
                   "--shading",
                   {{is(Factor::Ambient, {"near", "wide"}),
                     is(Factor::Shading, {"lambert", "lambert-shadows", "phong", "phong-shadows"})}}});
    const Names lazy{"lazy", "lazy-transfer"};
    all.push_back({"a surface alone", "--light", {{is(Factor::Light, lazy), isGiven(Factor::Opacity)}}});
    all.push_back(
        {"a sky that stands still", "lazy", {{is(Factor::Light, {"lazy"}), isGiven(Factor::Turn)}}});
    for (const Factor factor : {Factor::Turn, Factor::Opacity, Factor::Shading})
        all.push_back({"an opaque surface, a sky that stands still",
                       "--light",
                       {{is(Factor::Light, {"traced"}), isGiven(factor)}}});
    all.push_back({"the surface of a study",
                   "--light",
                   {{isNot(Factor::Scene, volumes), is(Factor::Light, {"traced"})}}});
    all.push_back({"each eye is traced",
                   "--method",
                   {{is(Factor::Light, {"traced"}), is(Factor::Scene, volumes), isLeftOut(Factor::Medium),
                     isNot(Factor::Method, {"auto", "full"})}}});
    all.push_back(
        {"openness weakens the lamp's light",
         "--exposure",
         {{is(Factor::Scene, volumes), is(Factor::Light, {"openness"}), isGiven(Factor::Exposure)}}});
    // What only opaque surfaces have, and what a lamp outside of a closed wall would show.
    const Names shadows{"lambert-shadows", "phong-shadows"};
    all.push_back({"layers cast no shadows",
                   "--shading",
                   {{is(Factor::Scene, volumes), is(Factor::Shading, shadows + Names{"fog"}),
                     isGiven(Factor::Opacity)}}});
    all.push_back({"all of it would be in shadow",
                   "--shading",
                   {{is(Factor::Scene, kColons), is(Factor::Shading, shadows)}}});
    // A colon is closed.
    all.push_back({"0 everywhere in a colon",
                   "lazy-transfer",
                   {{is(Factor::Scene, kColons), is(Factor::Light, {"lazy-transfer"})}}});
    all.push_back({"a bake that is refused",
                   "",
                   {{is(Factor::Scene, kColons), is(Factor::Light, {"transfer", "full"})}}});
    all.push_back(
        {"nothing of it gets in",
         "--sky",
         {{is(Factor::Scene, kColons), is(Factor::Light, {"lazy", "traced"}), isGiven(Factor::Sky)}}});
    // Terrains have transfer and openness, in a file or in the cache.
    all.push_back(
        {"no such bakes", "", {{is(Factor::Scene, kTerrains), is(Factor::Light, {"irradiance", "full"})}}});
    all.push_back({"of volumes", "lazy", {{is(Factor::Scene, kTerrains), is(Factor::Light, lazy)}}});
    all.push_back({"a file's name", "auto", {{is(Factor::Scene, volumes), is(Factor::Light, {"auto"})}}});
}

void addMedia(std::vector<Rule>& all) {
    const Names rays = kTerrains + kOutside + kColons;
    for (const auto& [factor, option] : {NamedOption{Factor::Model, "--model"},
                                         {Factor::Phase, "--phase"},
                                         {Factor::Lamp, "--l"},
                                         {Factor::Noise, "--noise"},
                                         {Factor::Mist, "--mist"},
                                         {Factor::Fineness, "--slices"}})
        all.push_back(
            {"of media", option, {{is(Factor::Scene, rays), isLeftOut(Factor::Medium), isGiven(factor)}}});
    for (const auto& [factor, option] : {NamedOption{Factor::Opacity, "--"},
                                         {Factor::Shading, "--shading"},
                                         {Factor::Modulation, "--modulate"},
                                         {Factor::Ambient, "--ambient"}}) {
        all.push_back({"media have their own", option, {{isGiven(Factor::Medium), isGiven(factor)}}});
        all.push_back(
            {"media have their own", option, {{is(Factor::Scene, kBuiltInMedia), isGiven(factor)}}});
    }
    all.push_back({"media are not lit lazily",
                   "--light",
                   {{isGiven(Factor::Medium), is(Factor::Light, {"lazy", "lazy-transfer", "traced"})}}});
    all.push_back({"baked light is of surfaces",
                   "--light",
                   {{isGiven(Factor::Medium), is(Factor::Scene, kTerrains), isGiven(Factor::Light)}}});
    all.push_back({"of terrains",
                   "ground",
                   {{isNot(Factor::Scene, kTerrains + kMeshes), is(Factor::Medium, {"ground"})}}});
    all.push_back({"of terrains",
                   "--mist",
                   {{isNot(Factor::Scene, kTerrains), isGiven(Factor::Medium), isGiven(Factor::Mist)}}});
    all.push_back({"of terrains", "--mist", {{is(Factor::Scene, kBuiltInMedia), isGiven(Factor::Mist)}}});
    for (const auto& [factor, option] : {NamedOption{Factor::Light, "--light"},
                                         {Factor::Sky, "--sky"},
                                         {Factor::Isovalue, "--isovalue"},
                                         {Factor::Exposure, "--exposure"},
                                         {Factor::Turn, "--turn"},
                                         {Factor::Up, "--up"}})
        all.push_back({"built in", option, {{is(Factor::Scene, kBuiltInMedia), isGiven(factor)}}});
    const Names unlit{"emission", "surface"};
    all.push_back({"nothing is scattered", "--phase", {{is(Factor::Model, unlit), isGiven(Factor::Phase)}}});
    all.push_back({"nothing is scattered on",
                   "--cone",
                   {{is(Factor::Model, unlit + Names{"direct"}), is(Factor::Fineness, {"narrow"})}}});
    const Clause::Part ownColors = is(Factor::Medium, {"tissue", "relief", "points", "regions"});
    all.push_back({"colours of its own",
                   "--image",
                   {{is(Factor::Scene, kTerrains), ownColors, isGiven(Factor::Photo)}}});
    all.push_back({"one light",
                   "--sun",
                   {{is(Factor::Scene, kTerrains), isGiven(Factor::Medium), isGiven(Factor::Sun),
                     isGiven(Factor::Lamp)}}});
    all.push_back(
        {"terrains are shaded at each sample",
         "--shading-width",
         {{is(Factor::Scene, kTerrains), isGiven(Factor::Medium), is(Factor::Fineness, {"each"})}}});
    all.push_back({"hundreds of slices are for tests of their own",
                   "",
                   {{isNot(Factor::Scene, kMeshes), isGiven(Factor::Medium), isLeftOut(Factor::Fineness)}}});
    all.push_back({"hundreds of slices are for tests of their own",
                   "",
                   {{is(Factor::Scene, kBuiltInMedia), isLeftOut(Factor::Fineness)}}});
}

void addMeshes(std::vector<Rule>& all) {
    for (const auto& [factor, option] : {NamedOption{Factor::Sky, "--sky"},
                                         {Factor::Light, "--light"},
                                         {Factor::Exposure, "--exposure"},
                                         {Factor::Turn, "--turn"},
                                         {Factor::Isovalue, "--isovalue"},
                                         {Factor::Opacity, "--"},
                                         {Factor::Ambient, "--ambient"},
                                         {Factor::Shading, "--shading"},
                                         {Factor::Modulation, "--modulate"},
                                         {Factor::Up, "--up"},
                                         {Factor::Medium, "--medium"},
                                         {Factor::Model, "--model"},
                                         {Factor::Phase, "--phase"},
                                         {Factor::Lamp, "--l"},
                                         {Factor::Noise, "--noise"},
                                         {Factor::Mist, "--mist"},
                                         {Factor::Fineness, "--"}})
        all.push_back({"meshes have none of it", option, {{is(Factor::Scene, kMeshes), isGiven(factor)}}});
}

// The dial's options, each named as it was given.
struct Dial {
    const char *level, *option;
};
constexpr Dial kDials[]{{"share", "--quality"}, {"psnr", "--target-psnr"}, {"time", "--target-ms"}};

void addMethods(std::vector<Rule>& all) {
    const Names swept = Names{"auto"} + kPairMethods;
    const Names onlyPairs{"sweep", "own-samples", "two-sweeps"};
    all.push_back(
        {"both eyes are swept", "method", {{isGiven(Factor::Medium), isNot(Factor::Method, swept)}}});
    all.push_back({"both eyes are swept",
                   "method",
                   {{is(Factor::Scene, kBuiltInMedia), isNot(Factor::Method, swept)}}});
    all.push_back(
        {"nothing is swept",
         "method",
         {{isNot(Factor::Scene, kBuiltInMedia), isLeftOut(Factor::Medium), is(Factor::Method, onlyPairs)}}});
    for (const Dial& dial : kDials) {
        const Clause::Part given = is(Factor::Quality, {dial.level});
        all.push_back({"nothing is warped", dial.option, {{isGiven(Factor::Medium), given}}});
        all.push_back({"nothing is warped", dial.option, {{is(Factor::Scene, kBuiltInMedia), given}}});
        all.push_back({"no expected error is known",
                       dial.option,
                       {{isNot(Factor::Scene, kBuiltInMedia), isLeftOut(Factor::Medium), given,
                         isNot(Factor::Method, {"auto", "linear", "cubic", "selective"})}}});
        all.push_back({"nothing is warped",
                       dial.option,
                       {{is(Factor::Light, {"traced"}), is(Factor::Scene, kOutside + kColons),
                         isLeftOut(Factor::Medium), given}}});
    }
    all.push_back({"a medium has no ground that is shaded",
                   "--ground-detail",
                   {{isGiven(Factor::Medium), is(Factor::Scene, kTerrains), isGiven(Factor::Detail)}}});
    const Clause::Part edges = isGiven(Factor::Edges);
    all.push_back({"nothing is cast", "--edges", {{isGiven(Factor::Medium), edges}}});
    all.push_back({"nothing is cast", "--edges", {{is(Factor::Scene, kBuiltInMedia), edges}}});
    all.push_back({"each pixel is traced",
                   "--edges",
                   {{is(Factor::Light, {"traced"}), is(Factor::Scene, kOutside + kColons),
                     isLeftOut(Factor::Medium), edges}}});
    all.push_back({"opacity to modulate",
                   "--modulate",
                   {{is(Factor::Scene, kOutside), isLeftOut(Factor::Medium), isGiven(Factor::Modulation),
                     isLeftOut(Factor::Opacity)}}});
}

}  // namespace

const std::vector<FactorLevels>& factorTable() {
    static const std::vector<FactorLevels> table{
        {Factor::Scene, "scene", kScenes},
        {Factor::Photo, "photo", {"none", "photo"}},
        {Factor::Fog, "fog", {"none", "thin", "thick"}},
        {Factor::Highlight, "highlight", {"none", "wide"}},
        {Factor::Landmark, "landmark", {"none", "tower"}},
        {Factor::Holes, "holes", {"filled", "open"}},
        {Factor::Heights, "heights", {"true", "scaled"}},
        {Factor::Sun, "sun", {"as it is", "high", "low", "set"}},
        {Factor::Sky, "sky", {"as it is", "picture", "probe"}},
        {Factor::Light,
         "light",
         {"none", "irradiance", "transfer", "openness", "full", "auto", "lazy", "lazy-transfer", "traced"}},
        {Factor::Exposure, "exposure", {"by mean", "given"}},
        {Factor::Turn, "turn", {"none", "turned"}},
        {Factor::Isovalue, "isovalue", {"chosen", "on", "off"}},
        {Factor::Opacity, "opacity", {"opaque", "dense", "glass", "file", "preset"}},
        {Factor::Ambient, "ambient", {"none", "near", "wide", "beside"}},
        {Factor::Shading,
         "shading",
         {"none", "lambert", "lambert-shadows", "phong", "phong-shadows", "varying", "fog"}},
        {Factor::Modulation, "modulation", {"none", "variance", "gradient"}},
        {Factor::Up, "up", {"z", "-y"}},
        {Factor::Medium, "medium", {"none", "tissue", "relief", "points", "regions", "ground"}},
        {Factor::Model, "model", {"as it is", "emission", "surface", "direct", "indirect"}},
        {Factor::Phase, "phase", {"none", "hg", "spectral"}},
        {Factor::Lamp, "lamp", {"as it is", "from", "head", "place"}},
        {Factor::Noise, "noise", {"as it is", "fur", "file", "fine"}},
        {Factor::Mist, "mist", {"none", "mist"}},
        {Factor::Fineness, "fineness", {"as it is", "coarse", "odd", "narrow", "each"}},
        {Factor::Separation, "separation", {"as it is", "zero", "wide"}},
        {Factor::Lens, "lens", {"as it is", "wide"}},
        {Factor::Method,
         "method",
         {"auto", "full", "paper", "linear", "cubic", "mcmillan", "nofill", "selective", "depthsplat",
          "sweep", "own-samples", "two-sweeps"}},
        {Factor::Quality, "quality", {"none", "share", "psnr", "time"}},
        {Factor::Edges, "edges", {"as they are", "jagged", "by two"}},
        {Factor::Detail, "detail", {"as it is", "off"}},
        {Factor::Mode, "mode", {"sbsl", "ml", "mr", "tb2r", "irl", "icr", "chl", "arcd"}},
        {Factor::Size, "size", {"61x47", "17x64", "1x1", "64x1"}},
        {Factor::Threads, "threads", {"all", "1", "3"}},
    };
    return table;
}

const std::vector<Rule>& rules() {
    static const std::vector<Rule> all = [] {
        std::vector<Rule> made;
        addKinds(made);
        addLight(made);
        addMedia(made);
        addMeshes(made);
        addMethods(made);
        return made;
    }();
    return all;
}

std::vector<Clause> clausesOf(const std::vector<Rule>& some) {
    std::vector<Clause> clauses;
    for (const Rule& rule : some) clauses.push_back(rule.clause);
    return clauses;
}

const std::string& levelOf(const Row& row, Factor factor) {
    return tableOf(factor).levels[static_cast<std::size_t>(row[static_cast<std::size_t>(factor)])];
}
bool given(const Row& row, Factor factor) {
    return row[static_cast<std::size_t>(factor)] != 0;
}

namespace {
bool sceneIn(const Row& row, const Names& scenes) {
    return std::find(scenes.begin(), scenes.end(), levelOf(row, Factor::Scene)) != scenes.end();
}
}  // namespace

bool isTerrain(const Row& row) {
    return sceneIn(row, kTerrains);
}
bool isMesh(const Row& row) {
    return sceneIn(row, kMeshes);
}
bool isColon(const Row& row) {
    return sceneIn(row, kColons);
}
bool isBuiltInMedium(const Row& row) {
    return sceneIn(row, kBuiltInMedia);
}
bool showsMedium(const Row& row) {
    return isBuiltInMedium(row) || given(row, Factor::Medium);
}

Covering covering() {
    return coveringUnder(rules());
}

Covering coveringUnder(const std::vector<Rule>& some) {
    std::vector<int> levels;
    for (const FactorLevels& factor : factorTable()) levels.push_back(static_cast<int>(factor.levels.size()));
    return {std::move(levels), clausesOf(some)};
}

std::vector<Tuple> wantedTuples(const Covering& covering, bool allTriples) {
    const int count = static_cast<int>(factorTable().size());
    std::vector<Tuple> tuples;
    const auto add = [&](const std::vector<int>& factors) {
        const std::vector<Tuple> some = covering.tuplesOf(factors);
        tuples.insert(tuples.end(), some.begin(), some.end());
    };
    for (int a = 0; a < count; ++a)
        for (int b = a + 1; b < count; ++b) {
            add({a, b});
            for (int c = b + 1; allTriples && c < count; ++c) add({a, b, c});
        }
    return tuples;
}

std::string textOf(const Row& row) {
    std::string text;
    for (const FactorLevels& factor : factorTable())
        if (factor.factor == Factor::Scene || given(row, factor.factor))
            text += (text.empty() ? "" : ", ") + std::string(factor.name) + " " + levelOf(row, factor.factor);
    return text;
}

Row rowFrom(const std::string& text) {
    Row row(factorTable().size(), 0);
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find(", ", at), text.size());
        const std::string said = text.substr(at, end - at);
        bool known = false;
        for (const FactorLevels& factor : factorTable())
            for (std::size_t level = 0; level < factor.levels.size(); ++level)
                if (said == std::string(factor.name) + " " + factor.levels[level]) {
                    row[static_cast<std::size_t>(factor.factor)] = static_cast<int>(level);
                    known = true;
                }
        if (!known) throw std::runtime_error("no factor has the level \"" + said + "\"");
        at = end + 2;
    }
    return row;
}

}  // namespace stereonav::test
