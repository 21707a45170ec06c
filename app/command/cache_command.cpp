// `stereonav cache`: lists what is kept between runs to save time, with its sources, and clears it.
#include "app/command/cache_command.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <filesystem>
#include <utility>
#include <vector>

#include "app/options/command.h"
#include "app/options/option_take.h"
#include "app/output/command_result.h"
#include "app/scene/scene_type_table.h"
#include "engine/base/cache.h"
#include "engine/base/error.h"
#include "engine/base/file.h"

namespace stereonav {
namespace {
namespace fs = std::filesystem;

struct CacheOptions {
    Telling telling;
    bool clear = false;
    std::optional<double> olderThan_h;  // least age of what is removed, since its last use; empty: any age
    std::string of;  // study, file, or folder of sources whose results are removed; "": any source
};

// Kinds of files by the beginnings of their names.
constexpr std::array<std::pair<const char*, const char*>, 9> kKeptKinds{
    {{"colon-", "colon"},
     {"lumen-", "lumen"},
     {"light-", "light of a volume"},
     {"terrain_light_", "light of a terrain"},
     {"window_", "light of a window's scene"},
     {"terrain-sky-", "openness of a terrain"},
     {"terrain-bake-", "light, not finished"},
     {"terrain-v", "built-in terrain"},
     {"ground_", "tiles of ground"}}};

std::string kindOf(const Kept& kept) {
    const std::string name = kept.file.filename().string();
    for (const auto& [start, kind] : kKeptKinds)
        if (name.starts_with(start)) return kind;
    return "something else";
}

double hoursSince(fs::file_time_type time) {
    return std::chrono::duration<double, std::ratio<3600>>(fs::file_time_type::clock::now() - time).count();
}

std::string keptSizeText(double bytes) {
    return bytes < 1e9 ? fmt::format("{:.1f} MB", bytes / 1e6) : fmt::format("{:.1f} GB", bytes / 1e9);
}

std::string timeText(fs::file_time_type time) {
    const auto at = std::chrono::floor<std::chrono::seconds>(std::chrono::file_clock::to_sys(time));
    return fmt::format("{:%Y-%m-%dT%H:%M:%S}", fmt::gmtime(at.time_since_epoch().count()));
}

// Returns whether the source is this file or folder, or lies in it.
bool isOf(const Kept& kept, const fs::path& source) {
    if (kept.source.empty()) return false;
    const auto [end, differs] =
        std::mismatch(source.begin(), source.end(), kept.source.begin(), kept.source.end());
    return end == source.end();
}

// Returns the source in the form of noteSource().
fs::path sourceNamed(const std::string& text) {
    std::error_code code;
    fs::path whole = fs::canonical(text, code);
    if (!code) return whole;
    whole = fs::absolute(text).lexically_normal();  // gone, while its results are still kept
    return whole.has_filename() ? whole : whole.parent_path();
}

// Returns the hours of "12h", "30d" or "4w"; empty for any other text.
std::optional<double> hoursOfAge(const std::string& text) {
    constexpr double kMost = 1e6;
    double number = 0;
    const char* const end = text.data() + text.size();
    const auto [at, failed] = std::from_chars(text.data(), end, number);
    if (failed != std::errc() || end - at != 1 || !(number >= 0 && number <= kMost)) return std::nullopt;
    switch (*at) {
        case 'h':
            return number;
        case 'd':
            return 24 * number;
        case 'w':
            return 7 * 24 * number;
        default:
            return std::nullopt;
    }
}

std::vector<Kept> chosen(std::vector<Kept> all, const CacheOptions& options) {
    if (!options.of.empty()) {
        const fs::path source = sourceNamed(options.of);
        std::erase_if(all, [&](const Kept& kept) { return !isOf(kept, source); });
    }
    if (options.olderThan_h)
        std::erase_if(all, [&](const Kept& kept) { return hoursSince(kept.used) <= *options.olderThan_h; });
    return all;
}

double bytesOf(const std::vector<Kept>& all, bool limitedAlone) {
    double bytes = 0;
    for (const Kept& kept : all)
        if (kept.limited || !limitedAlone) bytes += static_cast<double>(kept.bytes);
    return bytes;
}

Facts factsOf(const Kept& kept) {
    return {factForJson("file", kept.file.filename().string()),
            factForJson("kind", kindOf(kept)),
            factForJson("bytes", static_cast<std::int64_t>(kept.bytes)),
            factForJson("used_utc", timeText(kept.used)),
            factForJson("of", kept.source.empty() ? FactValue() : FactValue(kept.source.string())),
            factForJson("limited", kept.limited)};
}

std::string lineOf(const Kept& kept) {
    return fmt::format("  {:>8}  {}  {:26}{}\n", keptSizeText(static_cast<double>(kept.bytes)),
                       timeText(kept.used), kindOf(kept),
                       kept.source.empty() ? "" : "of " + kept.source.string());
}

void tellAll(const std::vector<Kept>& all, CommandResult& result) {
    std::vector<Facts> files;
    for (const Kept& kept : all) {
        files.push_back(factsOf(kept));
        result.answer(lineOf(kept));
    }
    result.add("files", std::move(files));
}

int runCache(const CacheOptions& options) {
    CommandResult result("cache", options.telling, {});
    const fs::path folder = cacheFolder();
    const int leftovers = removeLeftovers(folder);
    const std::vector<Kept> all = allKept(folder);
    const bool removes = options.clear || options.olderThan_h || !options.of.empty();
    result.add("folder", folder.string());
    const std::vector<Kept> picked = removes ? chosen(all, options) : all;
    if (removes) {
        fs::path stays;
        for (const Kept& kept : picked)
            if (!removeKept(kept.file)) stays = kept.file;
        if (!stays.empty())
            throw Error(stays.string(), "", "can not be removed", "check the permissions of its folder");
    }
    tellAll(picked, result);
    const std::vector<Kept> left = removes ? allKept(folder) : all;
    const double kept = bytesOf(left, false), limited = bytesOf(left, true);
    result.answer(fmt::format(
        "{}{} files of {} in {}; {} of them count in the limit of {}, beyond which the least recently used "
        "go\n",
        removes ? fmt::format("removed {} files of {}; kept: ", picked.size(),
                              keptSizeText(bytesOf(picked, false)))
                : "",
        left.size(), keptSizeText(kept), folder.string(), keptSizeText(limited), keptSizeText(kMostKept)));
    if (leftovers > 0)
        result.say(fmt::format("removed {} files that crashed runs left half-written\n", leftovers));
    result.add("removed", removes);
    result.add("left_over_files_removed", static_cast<std::int64_t>(leftovers));
    result.add("kept_files", static_cast<std::int64_t>(left.size()));
    result.add("kept_bytes", static_cast<std::int64_t>(kept));
    result.add("limited_bytes", static_cast<std::int64_t>(limited));
    result.add("limit_bytes", static_cast<std::int64_t>(kMostKept));
    result.finish();
    return 0;
}

std::optional<ValueProblem> problemOfAge(const std::string& text) {
    if (hoursOfAge(text)) return std::nullopt;
    return ValueProblem{"expected a number of hours, days or weeks, got \"" + text + "\"",
                        "write 12h, 30d or 4w"};
}

std::vector<Option> cacheOptions() {
    return {
        {.key = "clear",
         .value = flagValue(),
         .help = "remove all files, or those that --older and --of name",
         .take = into<&CacheOptions::clear>},
        {.key = "older",
         .value = textValue().checked(problemOfAge),
         .help = "remove files that were not used for this time: 12h, 30d, 4w",
         .advice = "write 12h, 30d or 4w",
         .take =
             [](OptionTargets& to, const OptionValue& value) {
                 to.of<CacheOptions>().olderThan_h = hoursOfAge(value.text);
             }},
        {.key = "of",
         .value = fileValue(),
         .help = "remove what was made from a study, a file, or all in a folder; with --older both must hold",
         .take = into<&CacheOptions::of>}};
}

}  // namespace

void noteSceneAsSource(const fs::path& file, const std::string& scene) {
    if (!scene.empty() && !isBuiltIn(scene)) noteSource(file, scene);
}

Command cacheCommand() {
    return {.name = "cache",
            .help = "list or clear the files that are kept between runs to save time",
            .traits = command::kTelling,
            .chapter = Chapter::Kept,
            .options = cacheOptions,
            .start = startOf<CacheOptions, runCache>};
}

}  // namespace stereonav
