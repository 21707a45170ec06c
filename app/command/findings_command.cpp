// `stereonav findings`: measures places of a colon's wall, for a list, a table, a file to go on with, and a
// page.
#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "app/options/command.h"
#include "app/options/option_numbers.h"
#include "app/options/option_take.h"
#include "app/options/output_place.h"
#include "app/output/command_result.h"
#include "app/output/progress_bar.h"
#include "app/scene/scene_loading.h"
#include "app/scene/volume/colon_of.h"
#include "app/scene/volume/findings_words.h"
#include "app/scene/volume/volume_loading.h"
#include "engine/base/error.h"
#include "engine/base/file.h"

namespace stereonav {
namespace {

struct FindingsOptions {
    SceneOptions scene;
    Telling telling;
    bool atTruth = false;                                    // at the polyps of the built-in colon
    std::vector<glm::dvec3> at;                              // LPS, metres
    std::vector<std::pair<glm::dvec3, glm::dvec3>> between;  // LPS, metres: pairs, for their distances
    bool candidates = false;                                 // include places that look like polyps
    std::optional<std::string> comment;                      // comment on the only place in `at`
    std::string file;                                        // .json file that findings are kept in; "": none
    std::string csv, page, sr;                               // .csv, .html, .dcm, or -; "": none
};

void checkPlace(const char* option, const std::string& file, const char* ending,
                const FindingsOptions& options) {
    if (file.empty()) return;
    if (!isStandardOutput(file) && !file.ends_with(ending))
        throw Error(option, "", fmt::format("expected a file named {}, got \"{}\"", ending, file),
                    fmt::format("name it findings{}", ending));
    checkNoInput({option, file}, inputsOf(options.scene));
    checkOutputFile(option, file);
}

void checkFindingsOptions(const FindingsOptions& options) {
    expectColonName(options.scene.scene);
    checkPlace("--csv", options.csv, ".csv", options);
    checkPlace("--page", options.page, ".html", options);
    checkPlace("--sr", options.sr, ".dcm", options);
    checkPlace("--file", options.file, ".json", options);
    if (!options.file.empty()) checkOutputToReadAgain("--file", options.file);
    if (options.atTruth && options.scene.scene != "colon")
        throw Error("--at-truth", "", "only for the built-in colon: the truth of other studies is not known",
                    "give places with --at x,y,z");
    if (!options.sr.empty() && options.candidates)
        throw Error("--sr", "", "does not go with --candidates, which nobody has looked at",
                    "give those that are polyps with --at x,y,z");
    if (!options.candidates && !options.atTruth && options.at.empty() && options.between.empty() &&
        options.file.empty())
        throw Error("findings", "", "expected a place, found none", "add --at x,y,z, or --file");
    if (options.comment && options.at.size() != 1)
        throw Error("--comment", "", "needs exactly one --at, whose comment it is",
                    "give one place at a time");
}

// Measures the kept findings again, each place once.
void addKept(const std::vector<KeptFinding>& list, const FindingTool& tool, Progress& progress,
             std::vector<Finding>& findings) {
    if (list.empty()) return;
    ProgressSteps measured(progress, list.size(), "measuring findings");
    for (const KeptFinding& kept : list) {
        Finding finding = listsPlace(findings, kept.place) ? Finding() : tool.at(kept.place);
        finding.asked = kept.place;
        finding.comment = kept.comment;
        finding.candidate = kept.candidate;
        addFinding(findings, std::move(finding));
        measured.done();
    }
}

std::vector<Finding> collect(const FindingsOptions& options, const std::vector<KeptFinding>& kept,
                             const FindingTool& tool, Progress& progress) {
    std::vector<Finding> findings;
    addKept(kept, tool, progress, findings);
    for (const glm::dvec3& place : options.at) {
        Finding finding = tool.at(place);
        finding.comment = options.comment.value_or("");
        addFinding(findings, std::move(finding));
    }
    if (options.atTruth)
        for (Finding& finding : tool.atTruth()) addFinding(findings, std::move(finding));
    if (options.candidates)
        for (Finding& finding : tool.candidates(progress)) addFinding(findings, std::move(finding));
    if (!options.file.empty() && findings.size() > kMostFindings)
        throw Error(options.file, "",
                    fmt::format("would keep {} findings, more than {}", findings.size(), kMostFindings),
                    "name another file for the new ones");
    noteDoubles(findings);
    return findings;
}

// Reports distances in a straight line, and along the centreline between its points nearest to both places.
void tellDistances(CommandResult& result, const FindingsOptions& options, const ColonScene& colon) {
    std::vector<Facts> list;
    for (const auto& [from, to] : options.between) {
        const double straight = 1e3 * glm::distance(from, to);
        const double along =
            1e3 * std::abs(alongLine(colon.centreline, to) - alongLine(colon.centreline, from));
        result.say(fmt::format("  {} to {}: {:.2f} mm straight, {:.0f} mm along the colon\n", placeText(from),
                               placeText(to), straight, along));
        list.push_back({factForJson("from_mm", FactNumbers{1e3 * from.x, 1e3 * from.y, 1e3 * from.z}),
                        factForJson("to_mm", FactNumbers{1e3 * to.x, 1e3 * to.y, 1e3 * to.z}),
                        factForJson("straight_mm", straight), factForJson("along_mm", along)});
    }
    if (!list.empty()) result.add("distances", std::move(list));
}

void tellFindings(CommandResult& result, const std::vector<Finding>& findings) {
    std::vector<Facts> list;
    FactWords missed;
    std::int64_t truths = 0, right = 0;
    for (std::size_t n = 0; n < findings.size(); ++n) {
        const Finding& finding = findings[n];
        list.push_back(factsOf(finding, n + 1));
        result.say(lineOf(finding, n + 1));
        if (!finding.truth) continue;
        ++truths, right += finding.right();
        if (!finding.right())
            missed.push_back(fmt::format("{}: {} of {:.1f} mm, measured {:.1f} mm", n + 1,
                                         nameOf(finding.truth->shape), 1e3 * finding.truth->diameter,
                                         1e3 * finding.diameter()));
    }
    result.add("findings", std::move(list));
    if (const std::string crads = cradsClassOf(findings); !crads.empty()) result.add("crads", crads);
    if (truths == 0) return;
    result.say(fmt::format("{} of {} within 1 mm or 10 % of the truth\n", right, truths));
    result.add("truths", truths);
    result.add("within", right);
    result.add("missed", missed);
}

int runFindings(const FindingsOptions& options) {
    checkFindingsOptions(options);
    CommandResult result(
        "findings", options.telling,
        {{"--csv", options.csv}, {"--page", options.page}, {"--file", options.file}, {"--sr", options.sr}});
    const std::vector<KeptFinding> kept =
        options.file.empty() ? std::vector<KeptFinding>() : readFindings(options.file);
    ProgressBar bar(!options.telling.quiet);
    checkSceneOptions(options.scene);
    ColonOptions reading = colonOptionsOf(options.scene);
    reading.keepsStudy = true;
    const ColonScene colon = loadColon(reading, bar.progress());
    if (!colon.isColon())
        throw Error(options.scene.scene, "", "no colon was found", "give --seed x,y,z inside it");
    checkNotRead({{"--csv", options.csv}, {"--page", options.page}, {"--sr", options.sr}});
    const FindingTool tool(colon, joinedWall(colon, bar.progress()));
    const std::vector<Finding> findings = collect(options, kept, tool, bar.progress());
    bar.clear();
    if (!options.sr.empty() && cradsClassOf(findings).empty())
        throw Error("--sr", "", "expected a finding that a person kept, found candidates alone",
                    "give those that are polyps with --at x,y,z");
    result.say(fmt::format("{}: {} findings, {}; {}\n", options.scene.scene, findings.size(),
                           cradsWords(findings), kNoMedicalDevice));
    result.addScene(options.scene.scene);
    result.add("notice", std::string(kNoMedicalDevice));
    tellFindings(result, findings);
    tellDistances(result, options, colon);
    if (!options.file.empty()) writeFindings(options.file, colon.name, findings);
    if (!options.csv.empty()) writeTextFile(options.csv, csvOf(findings));
    if (!options.page.empty())
        writeTextFile(options.page, findingsPage(colon, colon.study, findings, bar.progress()));
    if (!options.sr.empty()) writeTextFile(options.sr, findingsReport(reading, findings));
    for (const auto& [key, file] :
         {std::pair("kept", options.file), std::pair("table", options.csv), std::pair("page", options.page),
          std::pair("structured_report", options.sr)})
        if (!file.empty()) result.addFile(key, file);
    result.finish();
    return 0;
}

glm::dvec3 placeFrom(const OptionValue& value, int first) {
    return glm::dvec3(value.numbers[first], value.numbers[first + 1], value.numbers[first + 2]) / 1000.0;
}

std::vector<Option> findingsOptions() {
    return {
        {.key = "at",
         .value = numbersValue(seedNumbers()),
         .help = "a place on or in a polyp: left, back, head (from RAS change the first two signs); may be "
                 "given several times",
         .repeated = true,
         .take =
             [](OptionTargets& to, const OptionValue& value) {
                 to.of<FindingsOptions>().at.push_back(placeFrom(value, 0));
             }},
        {.key = "comment",
         .value = textValue(),
         .help = "comment on the finding of --at",
         .take = into<&FindingsOptions::comment>},
        {.key = "at-truth",
         .value = flagValue(),
         .help =
             "measure the polyps of the built-in colon at their true places, and print the true sizes too",
         .take = into<&FindingsOptions::atTruth>},
        {.key = "candidates",
         .value = flagValue(),
         .help = "list places that are shaped like polyps, the most likely first, to be looked at",
         .take = into<&FindingsOptions::candidates>},
        {.key = "between",
         .value = numbersValue(betweenNumbers()),
         .help = "measure the distance between two places; may be given several times",
         .repeated = true,
         .take =
             [](OptionTargets& to, const OptionValue& value) {
                 to.of<FindingsOptions>().between.emplace_back(placeFrom(value, 0), placeFrom(value, 3));
             }},
        {.key = "file",
         .value = fileValue(),
         .help = "file that keeps findings, .json: those in it are measured again, new ones are added",
         .take = into<&FindingsOptions::file>},
        {.key = "csv",
         .value = fileValue(),
         .help = "the findings as a table, .csv or -",
         .take = into<&FindingsOptions::csv>},
        {.key = "page",
         .value = fileValue(),
         .help = "one .html page with pictures of each, or -",
         .take = into<&FindingsOptions::page>},
        {.key = "sr",
         .value = fileValue(),
         .help = "the findings as a DICOM structured report, .dcm or -, with patient and study as in the "
                 "study's headers",
         .take = into<&FindingsOptions::sr>},
    };
}

}  // namespace

Command findingsCommand() {
    return {.name = "findings",
            .help = "measure polyps at places in a colon; write a list, a file and a page",
            .scenes = scene_type::kVolumes,
            .traits = command::kOfColon | command::kTelling,
            .chapter = Chapter::Colon,
            .options = findingsOptions,
            .start = startOf<FindingsOptions, runFindings>};
}

}  // namespace stereonav
