// `stereonav unfold`: lays the wall of a colon flat in a picture; finds places of the colon in it, and back.
#include <fmt/format.h>

#include <algorithm>

#include "app/options/command.h"
#include "app/options/option_numbers.h"
#include "app/options/option_take.h"
#include "app/options/output_place.h"
#include "app/options/typed_values.h"
#include "app/output/command_result.h"
#include "app/output/progress_bar.h"
#include "app/scene/scene_loading.h"
#include "app/scene/volume/colon_of.h"
#include "app/scene/volume/findings_words.h"
#include "colon/instruments/candidates.h"
#include "colon/instruments/finding.h"
#include "colon/instruments/panorama.h"
#include "colon/instruments/unfolding.h"
#include "engine/base/error.h"
#include "engine/image/image_file.h"

namespace stereonav {
namespace {

struct UnfoldOptions {
    SceneOptions scene;
    Telling telling;
    std::string out, distortion, panorama;  // pictures; except for `out` "": none
    double pixel_mm = 0.5;                  // size of a pixel on the wall, > 0
    std::vector<glm::dvec3> at;             // LPS, metres
    std::vector<std::pair<int, int>> pick;  // pixels
    std::string findings;                   // .json file of `findings` to mark; "": none
    bool candidates = false, truth = false;
};

constexpr double kShownWithin = 0.002;  // metres to the nearest wall of a place that counts as shown
const glm::vec3 kTruthColor(0.02f, 0.6f, 0.1f), kFindingColor(0.9f, 0.6f, 0.0f),
    kCandidateColor(0.05f, 0.2f, 0.9f);

void checkUnfoldOptions(const UnfoldOptions& options) {
    expectColonName(options.scene.scene);
    std::vector<NamedPlace> inputs = inputsOf(options.scene);
    if (!options.findings.empty()) inputs.push_back({"--findings", options.findings});
    for (const auto& [option, file] :
         {std::pair("--out", options.out), std::pair("--distortion", options.distortion),
          std::pair("--panorama", options.panorama)}) {
        if (file.empty()) continue;
        checkOutputPicture(option, file);
        checkNoInput({option, file}, inputs);
    }
    if (options.truth && options.scene.scene != "colon")
        throw Error("--truth", "", "only for the built-in colon: the truth of other studies is not known",
                    "mark findings with --findings FILE.json");
}

struct Flattened {
    const ColonScene& colon;
    const WallMesh& wall;
    const WallNeighbours& neighbours;
    const UnfoldedWall& flat;
};

// The marks of a picture, with the heads of polyps that they are made of.
struct Marked {
    std::vector<MeasuredPolyp> heads;
    std::vector<glm::vec3> colors;

    void add(MeasuredPolyp head, const glm::vec3& color) {
        heads.push_back(std::move(head));
        colors.push_back(color);
    }
    std::vector<UnfoldedWall::Mark> marks() const {
        std::vector<UnfoldedWall::Mark> all;
        for (std::size_t n = 0; n < heads.size(); ++n) all.push_back({heads[n].vertices, colors[n]});
        return all;
    }
};

// Reports how well the polyps of a generated colon are shown.
void tellTruth(CommandResult& result, const Flattened& of, Marked& marked) {
    std::vector<Facts> list;
    int once = 0;
    for (const Polyp& truth : of.colon.polyps) {
        std::string why;
        auto polyp =
            polypAt(of.wall, of.neighbours, truth.position, polypSettingOf(of.colon.volume.field.frame), why);
        Facts facts{factForJson("truth_mm", 1e3 * truth.diameter),
                    factForJson("truth_shape", std::string(nameOf(truth.shape)))};
        if (polyp) {
            const UnfoldedWall::Shown shown = of.flat.shown(*polyp);
            const glm::dvec2 at = of.flat.pixelOf(polyp->tip);
            once += shown.share >= 0.5 && shown.pieces == 1;
            facts.push_back(factForJson("shown_percent", 100 * shown.share));
            facts.push_back(factForJson("area_percent", 100 * shown.area));
            facts.push_back(factForJson("pieces", static_cast<std::int64_t>(shown.pieces)));
            facts.push_back(factForJson("pixel", FactNumbers{at.x, at.y}));
            marked.add(std::move(*polyp), kTruthColor);
        }
        list.push_back(std::move(facts));
    }
    result.say(fmt::format("  {} of {} polyps are shown once, by half of their heads at least\n", once,
                           of.colon.polyps.size()));
    result.add("polyps_once", static_cast<std::int64_t>(once));
    result.add("polyps", std::move(list));
}

void mark(const UnfoldOptions& options, const Flattened& of, Marked& marked) {
    const PolypSetting setting = polypSettingOf(of.colon.volume.field.frame);
    if (!options.findings.empty())
        for (const KeptFinding& kept : readFindings(options.findings)) {
            std::string why;
            if (auto polyp = polypAt(of.wall, of.neighbours, kept.place, setting, why))
                marked.add(std::move(*polyp), kFindingColor);
        }
    if (!options.candidates) return;
    CandidateSetting candidates;
    candidates.polyp = setting;
    for (Candidate& candidate : polypCandidates(of.wall, of.neighbours, candidates))
        marked.add(std::move(candidate.polyp), kCandidateColor);
}

void tellPlaces(CommandResult& result, const UnfoldOptions& options, const Flattened& of) {
    std::vector<Facts> list;
    for (const glm::dvec3& place : options.at) {
        const std::uint32_t vertex = nearestVertex(of.wall, place);
        const glm::dvec2 at = of.flat.pixelOf(vertex);
        const bool hidden = of.flat.hidden(vertex, kShownWithin);
        const double off = 1e3 * glm::distance(place, glm::dvec3(of.wall.places[vertex]));
        result.say(fmt::format("  {} is at pixel {:.0f},{:.0f}{}, {:.1f} mm from the wall\n",
                               placeText(place), at.x, at.y, hidden ? ", hidden by a fold" : "", off));
        list.push_back({factForJson("place_mm", placeNumbers(place)),
                        factForJson("pixel", FactNumbers{at.x, at.y}), factForJson("hidden", hidden),
                        factForJson("from_wall_mm", off)});
    }
    for (const auto& [x, y] : options.pick) {
        const auto place = of.flat.placeAt(x, y);
        if (!place) {
            result.say(fmt::format("  pixel {},{}: no wall\n", x, y));
            list.push_back({factForJson("pixel", FactNumbers{1.0 * x, 1.0 * y})});
            continue;
        }
        const double along = 1e3 * of.flat.alongAt(x);
        result.say(fmt::format("  pixel {},{} shows {}, {:.0f} mm along\n", x, y, placeText(*place), along));
        list.push_back({factForJson("pixel", FactNumbers{1.0 * x, 1.0 * y}),
                        factForJson("place_mm", placeNumbers(*place)), factForJson("along_mm", along)});
    }
    if (!list.empty()) result.add("places", std::move(list));
}

void drawPanorama(CommandResult& result, const UnfoldOptions& options, const Flattened& of,
                  const LineOfSight& sight, Progress& progress) {
    const Panorama panorama(of.colon.volume.field, of.colon.centreline, sight, 1e-3 * options.pixel_mm,
                            progress);
    writeColorImage(options.panorama, panorama.picture(of.colon.volume.look, progress));
    const Panorama::Shares shares = panorama.shares(of.wall, progress);
    result.say(
        fmt::format("{}: from the rectum's end {:.1f} % of the wall is seen, from the caecum's {:.1f} %, "
                    "from one of both "
                    "{:.1f} %\n",
                    options.panorama, 100 * shares.rectum, 100 * shares.caecum, 100 * shares.either));
    result.addFile("panorama", options.panorama);
    result.add("from_rectum_percent", 100 * shares.rectum);
    result.add("from_caecum_percent", 100 * shares.caecum);
    result.add("from_either_percent", 100 * shares.either);
}

int runUnfold(const UnfoldOptions& options) {
    checkUnfoldOptions(options);
    CommandResult result(
        "unfold", options.telling,
        {{"--out", options.out}, {"--distortion", options.distortion}, {"--panorama", options.panorama}});
    ProgressBar bar(!options.telling.quiet);
    const std::unique_ptr<Scene> scene = loadScene(options.scene, SizeOption{}, bar.progress(), kNoPicture);
    checkNotRead(
        {{"--out", options.out}, {"--distortion", options.distortion}, {"--panorama", options.panorama}});
    const ColonScene& colon = colonOf(*scene, options.scene);
    const WallMesh wall = wallMesh(colon.volume.field, colon.volume.cells, colon.lumen.lumen, bar.progress());
    const WallNeighbours neighbours = neighboursOf(wall);
    const LineOfSight sight(colon.volume.field, colon.volume.cells, colon.lumen.isovalue);
    UnfoldSetting setting;
    setting.pixel = 1e-3 * options.pixel_mm;
    const UnfoldedWall flat(wall, neighbours, colon.centreline, sight, setting, bar.progress());
    const Flattened of{colon, wall, neighbours, flat};
    Marked marked;
    if (options.truth) tellTruth(result, of, marked);
    mark(options, of, marked);
    tellPlaces(result, options, of);
    writeColorImage(options.out, flat.picture(colon.volume.look, marked.marks()));
    if (!options.distortion.empty()) writeColorImage(options.distortion, flat.distortionMap());
    if (!options.panorama.empty()) drawPanorama(result, options, of, sight, bar.progress());
    bar.clear();
    const UnfoldedWall::AreaError error = flat.areaError();
    const double hides = 100 * flat.hiddenShare(kShownWithin);
    result.say(fmt::format(
        "{}: {}x{} pixels of {:g} mm; areas of square centimetres are off by {:.0f} % on average, 95 of "
        "100 by {:.0f} % at most; {:.1f} % of the wall is hidden by folds; {}\n",
        options.out, flat.width(), flat.height(), options.pixel_mm, 100 * error.mean, 100 * error.most95,
        hides, kNoMedicalDevice));
    result.addScene(scene->name);
    result.addFile("picture", options.out);
    if (!options.distortion.empty()) result.addFile("map", options.distortion);
    result.add("size", FactIntegers{flat.width(), flat.height()});
    result.add("pixel_mm", options.pixel_mm);
    result.add("area_error_percent", 100 * error.mean);
    result.add("area_error_95_percent", 100 * error.most95);
    result.add("hidden_percent", hides);
    result.finish();
    return 0;
}

std::vector<Option> unfoldOptions() {
    return {
        {.key = "out",
         .value = fileValue(),
         .help = "the picture, .png or .ppm",
         .required = true,
         .take = into<&UnfoldOptions::out>},
        {.key = "distortion",
         .value = fileValue(),
         .help = "a picture of the distortion of areas: red is drawn too large, blue too small",
         .take = into<&UnfoldOptions::distortion>},
        {.key = "panorama",
         .value = fileValue(),
         .help = "a picture of the wall as seen from the centreline, ahead from the rectum and back from the "
                 "caecum",
         .take = into<&UnfoldOptions::panorama>},
        {.key = "pixel",
         .value = numberValue(within(0.1, 10, "mm")),
         .help = "side of a pixel on the wall",
         .advice = "0.5 is about a voxel",
         .fallback = "0.5",
         .take = into<&UnfoldOptions::pixel_mm>},
        {.key = "at",
         .value = numbersValue(seedNumbers()),
         .help = "print which pixel shows this place on the wall; may be given several times",
         .repeated = true,
         .take =
             [](OptionTargets& to, const OptionValue& value) {
                 to.of<UnfoldOptions>().at.push_back(placeOf(value) / 1000.0);
             }},
        {.key = "pick",
         .value = numbersValue(pixelNumbers()),
         .help = "print which place this pixel shows; may be given several times",
         .repeated = true,
         .take =
             [](OptionTargets& to, const OptionValue& value) {
                 to.of<UnfoldOptions>().pick.emplace_back(static_cast<int>(value.numbers[0]),
                                                          static_cast<int>(value.numbers[1]));
             }},
        {.key = "findings",
         .value = fileValue(),
         .help = "file of findings, .json, which are outlined in yellow",
         .take = into<&UnfoldOptions::findings>},
        {.key = "candidates",
         .value = flagValue(),
         .help = "outline places that are shaped like polyps in blue",
         .take = into<&UnfoldOptions::candidates>},
        {.key = "truth",
         .value = flagValue(),
         .help = "outline the polyps of the built-in colon in green, and print how each is shown",
         .take = into<&UnfoldOptions::truth>},
    };
}

}  // namespace

Command unfoldCommand() {
    return {.name = "unfold",
            .help = "draw a colon's wall laid flat",
            .scenes = scene_type::kVolumes,
            .traits = command::kOfColon | command::kTelling,
            .chapter = Chapter::Colon,
            .options = unfoldOptions,
            .start = startOf<UnfoldOptions, runUnfold>};
}

}  // namespace stereonav
