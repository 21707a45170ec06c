// `stereonav report`: writes one page on what the program's shortcuts cost and save.
#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <thread>

#include "app/options/command.h"
#include "app/options/option_take.h"
#include "app/options/output_place.h"
#include "app/options/typed_values.h"
#include "app/options/usual_words.h"
#include "app/output/command_result.h"
#include "app/output/progress_bar.h"
#include "app/report/json.h"
#include "app/report/machine.h"
#include "app/report/page.h"
#include "app/report/papers/data.h"
#include "app/report/papers/run.h"
#include "app/report/run.h"
#include "app/report/stability.h"
#include "engine/base/error.h"
#include "engine/base/file.h"
#include "engine/base/parallel.h"
#include "engine/peers/peers.h"

namespace stereonav {
namespace {

namespace fs = std::filesystem;

struct Part {
    const char* id;  // id of the section
    void (*measure)(ReportRun& run, double seconds);
    double weight;         // share of the time
    bool surfaces = true;  // whether it measures scenes whose rays are cast
    bool media = false;    // whether it measures swept scenes
    bool papers = false;   // part of --papers, which loads its own scenes
};
constexpr Part kParts[] = {{"right-eye", reportRightEye, 4.0},
                           {"felt", reportFelt, 1.5},
                           {"late", reportLate, 0.4, true, true},
                           {"quality", reportQuality, 2.0},
                           {"casting", reportCasting, 1.0},
                           {"light", reportLight, 1.0, false},
                           {"occlusion", reportOcclusion, 0.3, false},
                           {"volume-light", reportMedium, 2.0, false, true},
                           {"plan", reportPlan, 2.0},
                           {"time", reportStages, 2.0},
                           {"left-out", reportScenes, 0.3},
                           {"stability", reportStability, 0.0, false},
                           {"papers-stereo", reportPapersStereo, 3.0, false, false, true},
                           {"papers-light", reportPapersLight, 5.0, false, false, true},
                           {"papers-media", reportPapersMedia, 2.0, false, false, true},
                           {"papers-occlusion", reportPapersOcclusion, 1.0, false, false, true},
                           {"papers-scaling", reportPapersScaling, 1.0, false, false, true}};

std::vector<Part> partsOf(const ReportOptions& options) {
    std::string names;
    for (const Part& part : kParts)
        if (part.papers == options.papers) names += (names.empty() ? "" : ", ") + std::string(part.id);
    for (const std::string& id : options.parts)
        if (std::none_of(std::begin(kParts), std::end(kParts),
                         [&](const Part& p) { return id == p.id && p.papers == options.papers; }))
            throw Error("--parts", "", "there is no part \"" + id + "\"",
                        std::string("the parts ") + (options.papers ? "of --papers " : "") + "are " + names);
    std::vector<Part> parts;
    const auto wanted = [&](const Part& part) {
        return options.parts.empty() ||
               std::find(options.parts.begin(), options.parts.end(), part.id) != options.parts.end();
    };
    for (const Part& part : kParts)
        if (part.papers == options.papers && wanted(part)) parts.push_back(part);
    return parts;
}

std::string untimedText() {
    const int processes = peersOfThisRun().count();
    return fmt::format(
        "Untimed: work whose time counts for no figure, by {}. Processor: all threads together{}.",
        processes == 1 ? "one process" : fmt::format("{} processes, which rest otherwise", processes),
        processes == 1 ? "" : " of the first process");
}

void measureAll(ReportRun& run, const std::vector<Part>& parts) {
    double all = 1e-9;
    for (const Part& part : parts) all += part.weight;
    double left = all;
    ReportTable times{"Where this run's own time went",
                      untimedText(),
                      {"part", "planned s", "taken s", "untimed s", "processor s"},
                      {{"loading", "", fmt::format("{:.1f}", run.elapsed_s()), "", ""}}};
    for (const Part& part : parts) {
        run.feelMood();
        const double seconds = run.share_s(part.weight, std::max(left, 1e-9)), before = run.elapsed_s(),
                     untimed = run.untimed().taken_s();
        const std::clock_t processor = std::clock();
        run.begin(part.id, seconds, run.whole_s() * part.weight / all);
        part.measure(run, seconds);
        left -= part.weight;
        times.rows.push_back(
            {part.id, fmt::format("{:.1f}", seconds), fmt::format("{:.1f}", run.elapsed_s() - before),
             fmt::format("{:.1f}", run.untimed().taken_s() - untimed),
             fmt::format("{:.1f}", static_cast<double>(std::clock() - processor) / CLOCKS_PER_SEC)});
    }
    run.feelMood();
    addFigure(run.report(), {kMoodFigure, "ms", "", ReportFigure::Kind::Time, spreadOf(run.mood_ms())});
    run.report().sections.push_back({"run", "This run", "", {std::move(times)}});
}

void describeRun(ReportRun& run) {
    Report& report = run.report();
    report.machine = machineFacts();
    report.machine.emplace_back("kind of run", run.quick() ? "quick: fewer frames and repeats" : "full");
    report.machine.emplace_back("seed", std::to_string(run.options().seed));
    if (run.options().curvature)
        report.machine.emplace_back(
            "round Earth",
            fmt::format("refraction {:.6g}", run.options().refraction.value_or(kUsualRefraction)));
    const std::string noise =
        noiseWarning(loadAverage(), static_cast<int>(std::thread::hardware_concurrency()));
    if (!noise.empty()) report.warnings.push_back(noise);
}

// Writes all files at the end, each in one go: a report of one process that is stopped leaves nothing.
void writeReport(const Report& report, const fs::path& folder) {
    makeOutputFolder(folder);
    writeTextFile(folder / "report.csv", figuresCsv(report));
    if (!report.papers.empty()) writeTextFile(folder / "papers.csv", papersCsv(report.papers));
    writeTextFile(folder / "report.json", figuresJson(report));
    writeTextFile(folder / "index.html", pageOf(report));
}

// Writes the finished parts where one of several processes is lost: they may have taken hours.
void keepWhatIsDone(ReportRun& run, const fs::path& folder) {
    Report& report = run.report();
    run.dropPart();
    if (report.sections.empty()) return;
    report.warnings.push_back("This run ended early: parts are missing.");
    writeReport(report, folder);
}

void tellOf(CommandResult& result, const ReportOptions& options, const Report& report, double seconds) {
    const fs::path folder = options.out;
    result.say((folder / "index.html").string() + "\n");
    result.addFile("page", folder / "index.html");
    result.addFile("figures_json", folder / "report.json");
    result.addFile("figures_csv", folder / "report.csv");
    if (!report.papers.empty()) result.addFile("papers_csv", folder / "papers.csv");
    result.add("figures", static_cast<std::int64_t>(report.figures.size()));
    result.add("time_s", seconds);
    result.add("warnings", report.warnings);
}

// Runs a process that is not the first. Times are true only while nobody else computes: the first process
// takes them, and the others sleep until it needs work that is not timed.
int helpWithReport(const ReportOptions& options) {
    const int share = peersOfThisRun().threads();
    if (options.threads > 0 || share > 0) setThreadCount(options.threads > 0 ? options.threads : share);
    Progress quiet;
    ReportRun run(options, quiet);
    run.untimed().serve();
    return 0;
}

int runReport(const ReportOptions& options) {
    if (!peersOfThisRun().first()) return helpWithReport(options);
    checkOutputFolder("--out", options.out);
    std::optional<EarlierReport> earlier;
    if (!options.compare.empty()) earlier = readEarlierReport(options.compare);
    const long studies = std::ranges::count_if(options.scenes, isStudy);
    if (options.up && studies == 0)
        throw Error("--up", "", "needs a CT study among the scenes", "name one with --scene");
    // Files that can not be read are reported before minutes are spent.
    if (!options.stability.empty()) stabilitySection(readTextFile(options.stability), options.stability);
    const std::vector<Part> parts = partsOf(options);
    const auto any = [&](bool Part::*what) {
        return std::any_of(parts.begin(), parts.end(), [&](const Part& p) { return p.*what; });
    };
    if (options.curvature && !any(&Part::surfaces))
        throw Error("--curvature", "", "has no effect: none of these parts shows ground",
                    "leave it out, or add one that does, such as right-eye, to --parts");
    const PaperData checked(options.data);
    for (const char* name : {"report.csv", "papers.csv", "report.json", "index.html"})
        checkNotRead({{"--out", (fs::path(options.out) / name).string()}});
    CommandResult result("report", options.telling, {});
    ProgressBar bar(!options.telling.quiet);
    ReportRun run(options, bar.progress());
    if (options.threads > 0) setThreadCount(options.threads);
    describeRun(run);
    if (!options.papers) loadReportScenes(run, any(&Part::surfaces), any(&Part::media));
    try {
        measureAll(run, parts);
    } catch (...) {
        if (!peersOfThisRun().alone()) keepWhatIsDone(run, options.out);
        throw;
    }
    Report& report = run.report();
    if (!run.hurriedParts().empty())
        report.warnings.push_back(fmt::format("Time ran short: {} measured as in a quick run.",
                                              fmt::join(run.hurriedParts(), ", ")));
    bool worse = false;
    if (earlier) {
        const ReportComparison comparison = compareReports(*earlier, report);
        worse = comparison.worse();
        report.sections.insert(report.sections.begin(),
                               comparisonSection(comparison, *earlier, options.compare));
    }
    run.tell("writing");
    writeReport(report, options.out);
    bar.clear();
    tellOf(result, options, report, run.elapsed_s());
    if (earlier) {
        result.say(report.sections.front().text + "\n");
        result.add("worse", worse);
        result.add("compared", report.sections.front().text);
    }
    result.finish();
    return worse ? 1 : 0;
}

std::vector<Option> reportSubjects() {
    return {
        {.key = "scene",
         .value = fileValue(),
         .help = "another scene, beside the built-in ones; may be given several times",
         .rules = {{[](const Asked& asked) { return asked.has("papers"); },
                    "does not go with --papers, which has scenes of its own", "name --data"}},
         .repeated = true,
         .take = into<&ReportOptions::scenes>},
        {.key = "up",
         .value = wordValue({"x", "-x", "y", "-y", "z", "-z"}),
         .help = kUpHelp,
         .advice = kUpAdvice,
         .fallback = "z",
         .take = [](OptionTargets& to,
                    const OptionValue& value) { to.of<ReportOptions>().up = upAxisOf(value); }},
        {.key = "compare",
         .value = fileValue(),
         .help = "report.json of an earlier run: the page shows what changed; exit status 1 where something "
                 "got worse",
         .take = into<&ReportOptions::compare>},
        {.key = "stability",
         .value = fileValue(),
         .help = "rows that the stability tests wrote, in JSON lines",
         .take = into<&ReportOptions::stability>},
    };
}

std::vector<Option> reportRun() {
    return {
        {.key = "threads",
         .value = wholeValue(kThreadsRange),
         .help = kThreadsHelp,
         .advice = kThreadsAdvice,
         .fallback = "0",
         .take = into<&ReportOptions::threads>},
        {.key = "seed",
         .value = wholeValue(within(0, 9e18)),
         .help = "seed of all random numbers",
         .advice = "1 is the default",
         .fallback = "1",
         .take = into<&ReportOptions::seed>},
        {.key = "minutes",
         .value = numberValue(above(0, 1440, "minutes")),
         .help = "time for the whole report",
         .advice = "a fraction is fine",
         .fallback = "about 9; 1 with --quick",
         .take = into<&ReportOptions::minutes>},
        {.key = "parts",
         .value = wordsValue(),
         .help = "parts to make, such as right-eye,light",
         .fallback = "all",
         .repeated = true,
         .take =
             [](OptionTargets& to, const OptionValue& value) {
                 to.of<ReportOptions>().parts.insert(to.of<ReportOptions>().parts.end(), value.words.begin(),
                                                     value.words.end());
             }},
        {.key = "papers",
         .value = flagValue(),
         .help = "in place of the charts, tables of the papers beside the figures of this program",
         .take = into<&ReportOptions::papers>},
        {.key = "data",
         .value = fileValue(),
         .help = "folder with real data for --papers, as docs/testing.md lists it; built-in scenes replace "
                 "what is missing",
         .rules = {{[](const Asked& asked) { return !asked.has("papers"); }, "needs --papers",
                    "add it, or name scenes with --scene"}},
         .take = into<&ReportOptions::data>},
    };
}

std::vector<Option> reportOptions() {
    std::vector<Option> all{{.key = "out",
                             .value = fileValue(),
                             .help = "folder for index.html, report.json, report.csv",
                             .fallback = "report",
                             .take = into<&ReportOptions::out>},
                            {.key = "quick",
                             .value = flagValue(),
                             .help = "make the report within a minute, with fewer frames and repeats",
                             .take = into<&ReportOptions::quick>}};
    for (const auto& part : {reportSubjects(), reportRun()}) all.insert(all.end(), part.begin(), part.end());
    return all;
}

}  // namespace

// The exit status is 1 where a figure is worse than in the earlier run.
Command reportCommand() {
    return {.name = "report",
            .help = "write a page of error against time for the program's shortcuts; up to 10 minutes",
            .command = command::kReport,
            .traits = command::kTelling,
            .chapter = Chapter::Measuring,
            .options = reportOptions,
            .start = startOf<ReportOptions, runReport>};
}

}  // namespace stereonav
