// Options of `compare` and of `report`.
#include "app/options/option_table.h"
#include "app/options/typed_values.h"
#include "app/options/usual_words.h"

namespace stereonav {
namespace {

using namespace command;

std::vector<Option> reportSubjects() {
    return {
        {.key = "scene",
         .value = fileValue(),
         .help = "a scene beside the built-in ones; may be given several times",
         .commands = kReport,
         .rules = {{[](const Asked& asked) { return asked.has("papers"); },
                    "expected without --papers, which has scenes of its own", "name --data"}},
         .repeated = true,
         .take = [](OptionTargets& to,
                    const OptionValue& value) { to.report->scenes.push_back(value.text); }},
        {.key = "up",
         .value = wordValue({"x", "-x", "y", "-y", "z", "-z"}),
         .help = kUpHelp,
         .advice = kUpAdvice,
         .fallback = "z",
         .commands = kReport,
         .take = [](OptionTargets& to, const OptionValue& value) { to.report->up = upAxisOf(value); }},
        {.key = "compare",
         .value = fileValue(),
         .help = "an earlier run's report.json: shows what moved, exit status 1 where something got worse",
         .commands = kReport,
         .take = [](OptionTargets& to, const OptionValue& value) { to.report->compare = value.text; }},
        {.key = "stability",
         .value = fileValue(),
         .help = "rows that the stability tests wrote, as JSON lines",
         .commands = kReport,
         .take = [](OptionTargets& to, const OptionValue& value) { to.report->stability = value.text; }},
    };
}

std::vector<Option> reportRun() {
    return {
        {.key = "threads",
         .value = wholeValue(kThreadsRange),
         .help = kThreadsHelp,
         .advice = kThreadsAdvice,
         .fallback = "0",
         .commands = kReport,
         .take = [](OptionTargets& to,
                    const OptionValue& value) { to.report->threads = static_cast<int>(value.whole); }},
        {.key = "seed",
         .value = wholeValue(within(0, 9e18)),
         .help = "of everything random",
         .advice = "1 is the default",
         .fallback = "1",
         .commands = kReport,
         .take = [](OptionTargets& to,
                    const OptionValue& value) { to.report->seed = static_cast<std::uint64_t>(value.whole); }},
        {.key = "minutes",
         .value = numberValue(above(0, 1440, "minutes")),
         .help = "for all of it",
         .advice = "a fraction is fine",
         .fallback = "about 9; 1 with --quick",
         .commands = kReport,
         .take = [](OptionTargets& to, const OptionValue& value) { to.report->minutes = value.number(); }},
        {.key = "parts",
         .value = wordsValue(),
         .help = "some of it, as in right-eye,light",
         .fallback = "all",
         .commands = kReport,
         .repeated = true,
         .take =
             [](OptionTargets& to, const OptionValue& value) {
                 to.report->parts.insert(to.report->parts.end(), value.words.begin(), value.words.end());
             }},
        {.key = "papers",
         .value = flagValue(),
         .help = "the papers' own tables beside what this program does, in the place of the charts",
         .commands = kReport,
         .take = [](OptionTargets& to, const OptionValue&) { to.report->papers = true; }},
        {.key = "data",
         .value = fileValue(),
         .help = "folder with real data for --papers, as docs/testing.md lists it; built-in scenes stand in",
         .commands = kReport,
         .rules = {{[](const Asked& asked) { return !asked.has("papers"); }, "expected with --papers",
                    "add it, or name scenes with --scene"}},
         .take = [](OptionTargets& to, const OptionValue& value) { to.report->data = value.text; }},
    };
}

}  // namespace

std::vector<Option> compareOptions() {
    return {
        {.key = "frames",
         .value = wholeValue(within(1, 100'000, "frames")),
         .help = "evenly over the path",
         .advice = "24 is the default",
         .fallback = "24",
         .commands = kCompare,
         .take = [](OptionTargets& to,
                    const OptionValue& value) { to.compare->frames = static_cast<int>(value.whole); }},
        {.key = "methods",
         .value = wordsValue(),
         .help = "some of them, as in full,paper,linear",
         .fallback = "all",
         .commands = kCompare,
         .repeated = true,
         .take =
             [](OptionTargets& to, const OptionValue& value) {
                 to.compare->methods.insert(to.compare->methods.end(), value.words.begin(),
                                            value.words.end());
             }},
        {.key = "relative-separation",
         .value = fractionValue(within(0, 10)),
         .help = "separation as a share of the zero-parallax distance, as in 1/30",
         .advice = "try 1/30",
         .commands = kCompare,
         .take = [](OptionTargets& to,
                    const OptionValue& value) { to.compare->relativeSeparation = value.number(); }},
        {.key = "json",
         .value = fileValue(),
         .help = "figures as JSON; -: to standard output",
         .commands = kCompare,
         .take = [](OptionTargets& to, const OptionValue& value) { to.compare->json = value.text; }},
        {.key = "csv",
         .value = fileValue(),
         .help = "figures as CSV; -: to standard output",
         .commands = kCompare,
         .take = [](OptionTargets& to, const OptionValue& value) { to.compare->csv = value.text; }},
        {.key = "images",
         .value = fileValue(),
         .help = "folder for pictures of the flight's middle frame",
         .commands = kCompare,
         .take = [](OptionTargets& to, const OptionValue& value) { to.compare->images = value.text; }},
        {.key = "plot",
         .value = fileValue(),
         .help = "error against time as a picture",
         .commands = kCompare,
         .take = [](OptionTargets& to, const OptionValue& value) { to.compare->plot = value.text; }},
        {.key = "repeats",
         .value = wholeValue(within(1, 1000, "runs")),
         .help = "timed ones of a frame, the fastest counts",
         .advice = "3 is the default",
         .fallback = "3",
         .commands = kCompare,
         .take = [](OptionTargets& to,
                    const OptionValue& value) { to.compare->repeats = static_cast<int>(value.whole); }},
        {.key = "butteraugli",
         .value = flagValue(),
         .help =
             "how much of the error a person would notice, and a map of it among the pictures of --images",
         .commands = kCompare,
         .take = [](OptionTargets& to, const OptionValue&) { to.compare->butteraugli = true; }},
        {.key = "truth-rays",
         .value = wordValue({"4", "16", "64", "256"}),
         .help = "rays a pixel of the finer truths",
         .advice = "fewer take less time",
         .fallback = "64",
         .commands = kCompare,
         .scenes = scene_type::kCast,
         .elsewhere = {nullptr, "does not go with a medium, which has no finer truth",
                       "leave it out: errors are those from two sweeps"},
         .take = [](OptionTargets& to,
                    const OptionValue& value) { to.compare->truthRays = std::stoi(value.text); }},
    };
}

std::vector<Option> reportOptions() {
    std::vector<Option> all{
        {.key = "out",
         .value = fileValue(),
         .help = "folder for index.html, report.json, report.csv",
         .fallback = "report",
         .commands = kReport,
         .take = [](OptionTargets& to, const OptionValue& value) { to.report->out = value.text; }},
        {.key = "quick",
         .value = flagValue(),
         .help = "within a minute: fewer frames and repeats",
         .commands = kReport,
         .take = [](OptionTargets& to, const OptionValue&) { to.report->quick = true; }}};
    for (const auto& part : {reportSubjects(), reportRun()}) all.insert(all.end(), part.begin(), part.end());
    return all;
}

}  // namespace stereonav
