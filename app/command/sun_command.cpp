// `stereonav sun`: where the sun stands over ground at a time, and how long it shines there that day.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include "app/options/command.h"
#include "app/options/option_take.h"
#include "app/options/output_place.h"
#include "app/options/usual_words.h"
#include "app/options/utc_text.h"
#include "app/output/command_result.h"
#include "app/output/progress_bar.h"
#include "app/scene/scene_loading.h"
#include "app/scene/terrain/survey_part.h"
#include "app/scene/terrain/survey_sun.h"
#include "engine/base/error.h"
#include "engine/base/file.h"
#include "engine/base/stopwatch.h"
#include "engine/image/image_file.h"
#include "engine/light/skies/sun_position.h"

namespace stereonav {
namespace {

struct SunOptions {
    SceneOptions scene;
    Telling telling;
    std::string at;        // "2026-06-21T19:30": UTC
    double step_min = 20;  // time step for the hours of sun
    std::string out;       // GeoTIFF of the hours; "": none
    std::string picture;   // picture of the hours; "": none
};

constexpr double kDegree = std::numbers::pi / 180;

void checkSunOptions(const SunOptions& options) {
    if (!options.out.empty() && !options.out.ends_with(".tif") && !options.out.ends_with(".tiff"))
        throw Error("--out", "", "expected a file named .tif, got \"" + options.out + "\"",
                    "name it sun.tif");
    if (!options.picture.empty()) checkOutputPicture("--picture", options.picture);
    for (const NamedPlace& output :
         {NamedPlace{"--out", options.out}, NamedPlace{"--picture", options.picture}}) {
        if (output.place.empty()) continue;
        checkNoInput(output, inputsOf(options.scene));
        checkOutputFile(output.option, output.place);
    }
}

// Returns "2026-06-21 19:30" for seconds since 1970.
std::string utcText(double seconds) {
    const std::chrono::sys_seconds time{std::chrono::seconds(std::llround(seconds))};
    const auto day = std::chrono::floor<std::chrono::days>(time);
    const std::chrono::year_month_day date(day);
    const std::chrono::hh_mm_ss clock(time - day);
    return fmt::format("{:04}-{:02}-{:02} {:02}:{:02}", int(date.year()), unsigned(date.month()),
                       unsigned(date.day()), clock.hours().count(), clock.minutes().count());
}

// Writes hours from black, none, to white, the most of any sample; missing ground is red.
void writePicture(const std::string& file, const Plane<float>& hours, double most) {
    Plane<PackedColor> picture(hours.width(), hours.height());
    for (int y = 0; y < hours.height(); ++y)
        for (int x = 0; x < hours.width(); ++x) {
            const float value = hours.row(hours.height() - 1 - y)[x];
            const float share = most > 0 ? static_cast<float>(value / most) : 0.0f;
            const glm::vec3 color = std::isfinite(value) ? glm::vec3(share * share) : glm::vec3(0.5f, 0, 0);
            picture.at(x, y) = packColor(color);
        }
    writeColorImage(file, picture);
}

void writeHours(const SunOptions& options, const SurveyGround& survey, const SunPlaceOnGround& place,
                double time, Progress& progress, CommandResult& result) {
    progress.report(0, "reading ground");
    const SurveyPart part(survey, glm::dvec2(0.0), 0);
    const HeightPyramid maxima(part.ground());
    const SightLines lines(part.ground(), maxima, 0);
    const Stopwatch watch;
    const Plane<float> hours = hoursOfSun(lines, sunsOfDay(place, time, 60 * options.step_min), 24, progress);
    const double time_ms = watch.elapsed_ms();
    double least = 24, most = 0, sum = 0;
    long long count = 0;
    for (int j = 0; j < hours.height(); ++j)
        for (int i = 0; i < hours.width(); ++i) {
            const double value = hours.row(j)[i];
            if (!std::isfinite(value)) continue;
            least = std::min(least, value), most = std::max(most, value), sum += value, ++count;
        }
    if (!options.out.empty()) {
        WrittenRaster raster;
        raster.floats = &hours;
        raster.missing = std::nan("");
        raster.description = "hours of sun";
        raster.unit = "h";
        writeFileAtomically(
            options.out, [&](const std::filesystem::path& file) { writeGeoTiff(file, part.grid(), raster); });
        result.addFile("hours", options.out);
    }
    if (!options.picture.empty()) {
        writePicture(options.picture, hours, most);
        result.addFile("picture", options.picture);
    }
    const double mean = count > 0 ? sum / count : 0;
    result.say(fmt::format("hours of sun: {:.2f} to {:.2f}, mean {:.2f}; {}, {:.3g} s\n", least, most, mean,
                           part.words(), 1e-3 * time_ms));
    for (Fact& fact : part.facts()) result.add(fact.key, std::move(fact.value));
    result.add("least_hours", least);
    result.add("most_hours", most);
    result.add("mean_hours", mean);
    result.add("step_min", options.step_min);
    result.add("time_ms", time_ms);
}

int runSun(const SunOptions& options) {
    checkSunOptions(options);
    CommandResult result("sun", options.telling, {});
    ProgressBar bar(!options.telling.quiet);
    const SurveyGround survey = loadSurveyGround(options.scene, bar.progress());
    checkNotRead({{"--out", options.out}, {"--picture", options.picture}});
    const double time = secondsFromText(options.at).value_or(0);
    const SunPlaceOnGround place = sunPlaceOf(survey);
    const double latitude = place.earth.latitude, longitude = place.earth.longitude;
    const SunSeen seen = sunSeenAt(time, latitude, longitude);
    const auto rise = nextSunrise(time, latitude, longitude), set = nextSunset(time, latitude, longitude);
    result.addScene(survey.name);
    result.add("utc", utcText(time));
    result.add("place_deg", FactNumbers{latitude / kDegree, longitude / kDegree});
    result.add("azimuth_deg", seen.azimuth / kDegree);
    result.add("elevation_deg", seen.elevation / kDegree);
    result.add("error_deg", 0.02);
    result.add("next_sunrise_utc", rise ? FactValue(utcText(*rise)) : FactValue(std::monostate()));
    result.add("next_sunset_utc", set ? FactValue(utcText(*set)) : FactValue(std::monostate()));
    if (!options.out.empty() || !options.picture.empty())
        writeHours(options, survey, place, time, bar.progress(), result);
    bar.clear();
    result.answer(
        fmt::format("{} UTC at {:.4f}, {:.4f}: the sun stands at azimuth {:.2f}, elevation {:.2f} degrees; "
                    "next sunrise {}, next sunset {}\n",
                    utcText(time), latitude / kDegree, longitude / kDegree, seen.azimuth / kDegree,
                    seen.elevation / kDegree, rise ? utcText(*rise) : "none within a day",
                    set ? utcText(*set) : "none within a day"));
    result.finish();
    return 0;
}

std::optional<ValueProblem> problemOfTime(const std::string& text) {
    if (secondsFromText(text)) return std::nullopt;
    return ValueProblem{"expected a date and a time in UTC, got " + shownText(text),
                        "as in 2026-06-21T19:30"};
}

std::vector<Option> sunOptions() {
    return {
        {.key = "at",
         .value = textValue().checked(problemOfTime),
         .help = "date and time in UTC, 2026-06-21T19:30",
         .required = true,
         .take = into<&SunOptions::at>},
        {.key = "step",
         .value = numberValue(within(1, 60, "minutes")),
         .help = "time between the positions of the sun from which hours are counted",
         .fallback = "20",
         .rules = {{[](const Asked& asked) { return !asked.has("out") && !asked.has("picture"); },
                    "applies to --out and --picture only", kLeaveItOut}},
         .take = into<&SunOptions::step_min>},
        {.key = "out",
         .value = fileValue(),
         .help = "hours of sun on that day as a GeoTIFF over the ground's samples, .tif",
         .take = into<&SunOptions::out>},
        {.key = "picture",
         .value = fileValue(),
         .help = "the hours as a picture, from black to white, north up",
         .take = into<&SunOptions::picture>},
    };
}

}  // namespace

Command sunCommand() {
    return {.name = "sun",
            .help = "tell where the sun stands at a time, and how long it shines on the ground",
            .scenes = scene_type::kTerrains,
            .traits = command::kOfGround | command::kTelling,
            .chapter = Chapter::Ground,
            .options = sunOptions,
            .start = startOf<SunOptions, runSun>};
}

}  // namespace stereonav
