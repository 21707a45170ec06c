#include "app/view/window_jobs.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include "app/options/command.h"
#include "app/scene/shown_as.h"
#include "app/view/measured_command.h"
#include "app/view/notices.h"
#include "engine/base/cache.h"
#include "engine/base/error.h"
#include "engine/base/file.h"
#include "engine/image/stereo_picture_file.h"
#include "engine/scene/capabilities.h"

namespace stereonav {
namespace {

const Command* commandNamed(const std::string& name) {
    for (const Command& command : commands())
        if (name == command.name) return &command;
    return nullptr;
}

}  // namespace

void WindowJobs::checkNone() const {
    if (busy()) throw Error("", mJob->what(), "is still being made", "wait for it, or cancel it");
}

void WindowJobs::start(const std::string& what, const std::vector<std::string>& words,
                       std::unique_ptr<HeldPlace> place) {
    mJob = std::make_unique<Job>(what, words);
    mPlace = std::move(place);
}

void WindowJobs::cancel() {
    if (mJob) mJob->cancel();
}

// Returns the mode for files; swapped eyes are another mode of the same layout, where there is one. Throws
// Error for modes that no file can have.
std::string WindowJobs::modeOfFiles() const {
    const OutputModeInfo& shown = infoOf(mSession->shownMode().shown());
    if (!fitsInPicture(shown.mode))
        throw Error("", shown.longName.data(), "is a mode of windows alone", "choose another mode for files");
    if (mSession->swapped() && shown.layout != OutputLayout::Anaglyph)
        for (const OutputModeInfo& mode : outputModes())
            if (mode.layout == shown.layout && mode.half == shown.half && mode.rightFirst != shown.rightFirst)
                return std::string(mode.shortName);
    return std::string(shown.shortName);
}

void WindowJobs::savePicture(const PictureWish& picture) {
    mNotices.tryTo([&] {
        checkNone();
        auto held = std::make_unique<HeldPlace>(std::filesystem::absolute(picture.file).lexically_normal(),
                                                HeldPlace::Kind::File);
        const std::filesystem::path place = held->path();
        const bool both = isJps(place) || isMpo(place);
        SettingTexts settings =
            withEyes(mSettings.now(), mSession->stereo(), !both && !mSession->shownMode().stereo);
        settings["size"] = {fmt::format("{}x{}", picture.width, picture.height)};
        // Movies are not made in flight, so time does not matter.
        settings.try_emplace("method",
                             std::vector{std::string(mSession->open().scene->frames().exactMethod())});
        settings.erase("mode");  // files of both eyes have an arrangement of their own
        if (!both) settings["mode"] = {modeOfFiles()};
        std::vector<std::string> words = commandWords(command::kRender, settings);
        words.push_back("--pose=" + poseText(mSession->pose()));
        words.push_back("--out=" + place.string());
        start("the picture " + place.string(), words, std::move(held));
    });
}

void WindowJobs::makeMovie(const MovieWish& movie) {
    mNotices.tryTo([&] {
        checkNone();
        if (mSession->paths().path().samples().size() < 2)
            throw Error("", "movie", "there is no flight", "record one with z");
        SettingTexts settings = mSettings.now();
        if (!mSession->shownMode().stereo) settings = withEyes(settings, mSession->stereo(), true);
        settings["size"] = {fmt::format("{}x{}", movie.width, movie.height)};
        settings["mode"] = {modeOfFiles()};
        std::vector<std::string> words = commandWords(command::kPlay, settings);
        // The full path, so that the notice says where the movie is.
        const std::filesystem::path wanted = std::filesystem::absolute(movie.file).lexically_normal();
        const bool video = wanted.has_extension();
        auto held =
            std::make_unique<HeldPlace>(wanted, video ? HeldPlace::Kind::File : HeldPlace::Kind::Folder);
        const std::filesystem::path place = held->path();
        // Named like temporary files, so that it is removed even after a crash (removeLeftovers()).
        mPath = std::make_unique<JobFile>(keptFile(fmt::format(".flight.{}.window.part.gltf", getpid())));
        writePath(mPath->path(), mSession->paths().path());
        words.push_back("--path=" + mPath->path().string());
        words.push_back((video ? "--video=" : "--out=") + place.string());
        if (video) words.push_back(fmt::format("--fps={:.6g}", movie.fps));
        start("the movie " + place.string(), words, std::move(held));
    });
}

bool WindowJobs::bakes() const {
    const auto type = sceneTypeOf(mSettings.options().scene);
    return type && (*type & scene_type::kCast) != 0 && (commandOf(command::kBake).scenes & *type) != 0;
}

bool WindowJobs::bakeTakes(const std::string& key, const std::string& value) const {
    const Option* const option = findOption(command::kBake, key);
    const auto type = sceneTypeOf(mSettings.options().scene);
    if (!option || !type || (option->scenes & *type) == 0) return false;
    GivenOptions given;
    given.command = command::kBake;
    given.add(key, readValue(option->name(), option->value, option->advice, value), option->name());
    const Asked asked{given, *type};
    return std::none_of(option->rules.begin(), option->rules.end(),
                        [&](const OptionRule& rule) { return rule.broken(asked); });
}

void WindowJobs::bakeLight(const std::string& what, double minutes) {
    mNotices.tryTo([&] {
        checkNone();
        const SettingTexts settings = mSettings.now();
        std::vector<std::string> words = commandWords(command::kBake, settings);
        words.push_back("--what=" + what);
        const std::string time = fmt::format("{:.6g}", minutes);
        if (bakeTakes("minutes", time)) words.push_back("--minutes=" + time);
        const std::string baked = placeOfBake(words).string();
        words.push_back("--out=" + baked);
        start("baked light", words);
        mBaked = baked;
        mBakedScene = mSettings.options().scene.scene;
    });
}

bool WindowJobs::exports(const std::string& command) const {
    const auto type = sceneTypeOf(mSettings.options().scene);
    const Command* const made = commandNamed(command);
    if (!type || !made) return false;
    if ((made->traits & command::kOfColon) != 0)
        return mSession && mSession->open().scene->offered<LineThrough>();
    return (*type & scene_type::kTerrain) != 0;
}

void WindowJobs::exportFile(const std::string& command, const std::string& file) {
    mNotices.tryTo([&] {
        checkNone();
        const Command* const made = commandNamed(command);
        if (!made) return;
        std::vector<std::string> words = commandWords(made->command, mSettings.now());
        auto held = std::make_unique<HeldPlace>(std::filesystem::absolute(file).lexically_normal(),
                                                HeldPlace::Kind::File);
        const std::filesystem::path place = held->path();
        words.push_back("--out=" + place.string());
        start(place.string(), words, std::move(held));
    });
}

std::optional<std::string> WindowJobs::look() {
    if (!busy()) return std::nullopt;
    mJob->look();
    if (mJob->running()) return std::nullopt;
    mPath.reset();
    mPlace.reset();
    const std::string baked = std::exchange(mBaked, "");
    if (mJob->failed()) {
        mNotices.fail(mJob->lastLine().empty() ? mJob->what() + " was not made" : mJob->lastLine());
    } else if (mJob->cancelled()) {
        mSession->notify(mJob->what() + ": cancelled");
    } else {
        mSession->notify(fmt::format("{}: done in {:.0f} s", mJob->what(), mJob->seconds()));
        if (!baked.empty() && mBakedScene == mSettings.options().scene.scene) return baked;
    }
    return std::nullopt;
}

std::string WindowJobs::atWork() const {
    if (!busy()) return "";
    return mJob->what() + (mBaked.empty() ? ", which is lost" : ", which goes on the next time");
}

void WindowJobs::saveMeasured(const MeasuredLine& line, const std::string& file) {
    mNotices.tryTo([&] {
        checkNone();
        const std::filesystem::path wanted = std::filesystem::absolute(file).lexically_normal();
        const std::string kind = wanted.extension();
        const bool profile = kind == ".svg" || kind == ".csv";
        if (!profile && kind != ".geojson")
            throw Error(file, "", "expected a name that ends in .svg, .csv or .geojson", "as in profile.svg");
        if (profile && line.closed())
            throw Error(file, "", "an area has no profile", "name a .geojson, or take Area away");
        SettingTexts settings;
        for (const char* const key : {"SCENE", "open-holes"})
            if (const auto said = mSettings.now().find(key); said != mSettings.now().end())
                settings.insert(*said);
        std::vector<std::string> words =
            commandWords(profile ? command::kProfile : command::kMeasure, settings);
        words.push_back(measuredWords(*mSession->open().scene, line));
        auto held = std::make_unique<HeldPlace>(wanted, HeldPlace::Kind::File);
        const std::filesystem::path place = held->path();
        words.push_back(fmt::format("--{}={}", kind.substr(1), place.string()));
        start(place.string(), words, std::move(held));
    });
}

}  // namespace stereonav
