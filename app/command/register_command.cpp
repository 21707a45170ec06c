// `stereonav register`: finds places of one study of a colon in another study of it.
#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "app/options/command.h"
#include "app/options/option_numbers.h"
#include "app/options/option_take.h"
#include "app/options/output_place.h"
#include "app/options/typed_values.h"
#include "app/output/command_result.h"
#include "app/output/handed_name.h"
#include "app/output/progress_bar.h"
#include "app/scene/scene_loading.h"
#include "app/scene/volume/colon_of.h"
#include "app/scene/volume/volume_loading.h"
#include "colon/instruments/finding.h"
#include "colon/instruments/registration.h"
#include "engine/base/error.h"
#include "engine/base/file.h"

namespace stereonav {
namespace {

struct RegisterOptions {
    SceneOptions scene;
    Telling telling;
    std::string with;            // the other study, or colon
    double bend_mm = 0;          // for the other colon, where it is the built-in one
    double inflate = 1;          // factor on its radius
    std::vector<glm::dvec3> at;  // LPS, metres, in the first study
    bool force = false;          // go on even if the colons do not match
    std::string out;             // .csv, or -; "": none
};

constexpr double kTableStep = 0.005;  // metres between rows of the table

void checkRegisterOptions(const RegisterOptions& options) {
    expectColonName(options.scene.scene);
    expectColonName(options.with);
    if (options.with != "colon" && (options.bend_mm != 0 || options.inflate != 1))
        throw Error(options.bend_mm != 0 ? "--bend" : "--inflate", "",
                    "needs --with colon, which is changed by it", "leave it out");
    if (options.out.empty()) return;
    if (!isStandardOutput(options.out) && !options.out.ends_with(".csv"))
        throw Error("--out", "", "expected a file named .csv, got \"" + options.out + "\"",
                    "name it places.csv");
    std::vector<NamedPlace> inputs = inputsOf(options.scene);
    inputs.push_back({"--with", options.with});
    checkNoInput({"--out", options.out}, inputs);
    checkOutputFile("--out", options.out);
}

ColonScene colonFrom(const ColonOptions& options, const std::string& name, Progress& progress) {
    ColonScene colon = loadColon(options, progress);
    if (!colon.isColon()) throw Error(name, "", "no colon was found", "give a study that is one");
    return colon;
}

// Returns the options without choices in the first study, which do not apply to the second.
ColonOptions secondOptions(const RegisterOptions& options) {
    SceneOptions second = options.scene;
    second.scene = options.with;
    second.volume.series.reset();
    second.volume.label.reset();
    second.volume.seeds.clear();
    second.volume.choices = {};
    ColonOptions reading = colonOptionsOf(second);
    reading.builtIn.bend = 1e-3 * options.bend_mm;
    reading.builtIn.inflation = options.inflate;
    return reading;
}

void tellPlaces(CommandResult& result, const RegisterOptions& options, const ColonScene& first,
                const ColonScene& second, const LineRegistration& registration) {
    std::vector<Facts> list;
    for (const glm::dvec3& place : options.at) {
        const double along = alongLine(first.centreline, place), there = registration.toSecond(along);
        const glm::dvec3 match = placeAlong(second.centreline, there);
        result.say(fmt::format("  {} is {:.0f} mm along; there {:.0f} mm along, at {}\n", placeText(place),
                               1e3 * along, 1e3 * there, placeText(match)));
        list.push_back({factForJson("place_mm", placeNumbers(place)), factForJson("along_mm", 1e3 * along),
                        factForJson("other_along_mm", 1e3 * there),
                        factForJson("other_place_mm", placeNumbers(match))});
    }
    result.add("places", std::move(list));
}

// Reports for two generated colons how far along the second line each polyp's place is from the polyp.
void tellErrors(CommandResult& result, const ColonScene& first, const ColonScene& second,
                const LineRegistration& registration) {
    if (first.polyps.empty() || first.polyps.size() != second.polyps.size()) return;
    FactNumbers errors;
    double sum = 0;
    for (std::size_t n = 0; n < first.polyps.size(); ++n) {
        const double along = alongLine(first.centreline, first.polyps[n].position);
        const double truth = alongLine(second.centreline, second.polyps[n].position);
        errors.push_back(1e3 * std::abs(registration.toSecond(along) - truth));
        sum += errors.back();
    }
    const double mean = sum / static_cast<double>(errors.size()),
                 most = *std::max_element(errors.begin(), errors.end());
    result.say(
        fmt::format("  polyps of one are found in the other within {:.1f} mm on average, {:.1f} mm at most\n",
                    mean, most));
    result.add("error_mean_mm", mean);
    result.add("error_most_mm", most);
    result.add("errors_mm", errors);
}

std::string tableOf(const ColonScene& first, const ColonScene& second, const LineRegistration& registration) {
    std::string text =
        "along_mm,left_mm,back_mm,head_mm,other_along_mm,other_left_mm,other_back_mm,other_head_mm\n";
    constexpr double kMostRows = 100'000;
    const double length = first.centreline.length(), step = std::max(kTableStep, length / kMostRows);
    for (double along = 0; along <= length; along += step) {
        const double there = registration.toSecond(along);
        const glm::dvec3 a = 1e3 * placeAlong(first.centreline, along),
                         b = 1e3 * placeAlong(second.centreline, there);
        text += fmt::format("{:.1f},{:.2f},{:.2f},{:.2f},{:.1f},{:.2f},{:.2f},{:.2f}\n", 1e3 * along, a.x,
                            a.y, a.z, 1e3 * there, b.x, b.y, b.z);
    }
    return text;
}

int runRegister(const RegisterOptions& options) {
    checkRegisterOptions(options);
    CommandResult result("register", options.telling, {{"--out", options.out}});
    ProgressBar bar(!options.telling.quiet);
    checkSceneOptions(options.scene);
    const ColonScene first = colonFrom(colonOptionsOf(options.scene), options.scene.scene, bar.progress());
    const ColonScene second = colonFrom(secondOptions(options), options.with, bar.progress());
    checkNotRead({{"--out", options.out}});
    const LineRegistration registration(first.centreline, second.centreline);
    bar.clear();
    if (!registration.matches() && !options.force)
        throw Error(
            options.with, "",
            fmt::format("is not of the same colon as {}: the mean cost of a pair is {:.3f}, of one colon it "
                        "is at most {:g}",
                        options.scene.scene, registration.cost(), kMostCostOfOneColon),
            "give two studies of one patient, or add --force");
    result.say(fmt::format("{}, {:.0f} mm, and {}, {:.0f} mm: mean cost of a pair {:.3f}; {}\n",
                           options.scene.scene, 1e3 * first.centreline.length(), options.with,
                           1e3 * second.centreline.length(), registration.cost(), kNoMedicalDevice));
    result.addScene(options.scene.scene);
    result.add("other", handedName(options.with));
    result.add("length_mm", 1e3 * first.centreline.length());
    result.add("other_length_mm", 1e3 * second.centreline.length());
    result.add("cost", registration.cost());
    result.add("matches", registration.matches());
    if (!registration.matches())
        result.say(
            fmt::format("  they do not match: of one colon the cost is at most {:g}\n", kMostCostOfOneColon));
    tellPlaces(result, options, first, second, registration);
    tellErrors(result, first, second, registration);
    if (!options.out.empty()) {
        writeTextFile(options.out, tableOf(first, second, registration));
        result.addFile("table", options.out);
    }
    result.finish();
    return 0;
}

std::vector<Option> registerOptions() {
    return {
        {.key = "with",
         .value = fileValue().offering({"colon"}),
         .help = "the other study, or colon for the built-in one",
         .required = true,
         .take = into<&RegisterOptions::with>},
        {.key = "with",
         .value = fileValue(),
         .help = "another study of the same colon; its matching place is shown beside the picture",
         .fallback = "none",
         .commands = command::kView,
         .scenes = scene_type::kSurfaces,
         .take = [](OptionTargets&, const OptionValue&) {}},  // read from the texts of options by the window
        {.key = "at",
         .value = numbersValue(seedNumbers()),
         .help = "a place of the first study to find in the other; may be given several times",
         .repeated = true,
         .take =
             [](OptionTargets& to, const OptionValue& value) {
                 to.of<RegisterOptions>().at.push_back(placeOf(value) / 1000.0);
             }},
        {.key = "bend",
         .value = numberValue(within(0, 30, "mm")),
         .help = "largest shift of the loops of --with colon",
         .advice = "10 is a patient who has turned round",
         .fallback = "0",
         .take = into<&RegisterOptions::bend_mm>},
        {.key = "inflate",
         .value = numberValue(within(0.7, 1.4)),
         .help = "factor on the radii of --with colon",
         .advice = "1.2 is more gas",
         .fallback = "1",
         .take = into<&RegisterOptions::inflate>},
        {.key = "force",
         .value = flagValue(),
         .help = "print places even where the two studies do not match",
         .take = into<&RegisterOptions::force>},
        {.key = "out",
         .value = fileValue(),
         .help = "matching places of both, every 5 mm, as a table, .csv or -",
         .take = into<&RegisterOptions::out>},
    };
}

}  // namespace

Command registerCommand() {
    return {.name = "register",
            .help = "find places of a colon in another study of it",
            .scenes = scene_type::kVolumes,
            .traits = command::kOfColon | command::kTelling,
            .chapter = Chapter::Colon,
            .options = registerOptions,
            .start = startOf<RegisterOptions, runRegister>};
}

}  // namespace stereonav
