// The viewer's part that makes movies and bakes light, by the program's own commands beside the window.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include "app/options/command.h"
#include "app/scene/shown_as.h"
#include "app/view/viewer.h"
#include "engine/base/cache.h"
#include "engine/base/error.h"
#include "engine/base/file.h"
#include "engine/image/stereo_picture_file.h"

namespace stereonav {

void Viewer::checkNoJob() const {
    if (mJob && mJob->running())
        throw Error("", mJob->what(), "is still being made", "wait for it, or cancel it");
}

void Viewer::startJob(const std::string& what, const std::vector<std::string>& words,
                      std::unique_ptr<HeldPlace> place) {
    mJob = std::make_unique<Job>(what, words);
    mJobPlace = std::move(place);
}

void Viewer::cancelJob() {
    if (mJob) mJob->cancel();
}

// Swapped eyes are another mode of the same layout, where there is one. Throws Error for modes that no file
// can have.
std::string Viewer::modeOfFiles() const {
    const OutputModeInfo& shown = infoOf(mSession->mode());
    if (!fitsInPicture(shown.mode))
        throw Error("", shown.longName.data(), "is a mode of windows alone", "choose another mode for files");
    if (mSession->swapped() && shown.layout != OutputLayout::Anaglyph)
        for (const OutputModeInfo& mode : outputModes())
            if (mode.layout == shown.layout && mode.half == shown.half && mode.rightFirst != shown.rightFirst)
                return std::string(mode.shortName);
    return std::string(shown.shortName);
}

void Viewer::savePicture(const PictureWish& picture) {
    tryTo([&] {
        checkNoJob();
        auto held = std::make_unique<HeldPlace>(std::filesystem::absolute(picture.file).lexically_normal(),
                                                HeldPlace::Kind::File);
        const std::filesystem::path place = held->path();
        SettingTexts settings = withEyes(this->settings(), mSession->stereo());
        settings["size"] = {fmt::format("{}x{}", picture.width, picture.height)};
        // Nobody waits for it in flight.
        settings.try_emplace("method",
                             std::vector{std::string(mSession->open().scene->frames().exactMethod())});
        settings.erase("mode");  // files of both eyes have their own
        if (!isJps(place) && !isMpo(place)) settings["mode"] = {modeOfFiles()};
        std::vector<std::string> words = commandWords(command::kRender, settings);
        words.push_back("--pose=" + poseText(mSession->pose()));
        words.push_back("--out=" + place.string());
        startJob("the picture " + place.string(), words, std::move(held));
    });
}

void Viewer::makeMovie(const MovieWish& movie) {
    tryTo([&] {
        checkNoJob();
        if (mSession->path().samples().size() < 2)
            throw Error("", "movie", "there is no flight", "record one with z");
        SettingTexts settings = this->settings();
        settings["size"] = {fmt::format("{}x{}", movie.width, movie.height)};
        settings["mode"] = {modeOfFiles()};
        std::vector<std::string> words = commandWords(command::kPlay, settings);
        // Whole, so that it is told where the movie is.
        const std::filesystem::path wanted = std::filesystem::absolute(movie.file).lexically_normal();
        const bool video = wanted.has_extension();
        auto held =
            std::make_unique<HeldPlace>(wanted, video ? HeldPlace::Kind::File : HeldPlace::Kind::Folder);
        const std::filesystem::path place = held->path();
        // Named as temporaries are, so that it goes though the window crashes (removeLeftovers()).
        mJobPath = std::make_unique<JobFile>(keptFile(fmt::format(".flight.{}.window.part.gltf", getpid())));
        writePath(mJobPath->path(), mSession->path());
        words.push_back("--path=" + mJobPath->path().string());
        words.push_back((video ? "--video=" : "--out=") + place.string());
        if (video) words.push_back(fmt::format("--fps={:.6g}", movie.fps));
        startJob("the movie " + place.string(), words, std::move(held));
    });
}

bool Viewer::bakes() const {
    const auto type = sceneTypeOf(mOptions.scene);
    return type && (*type & scene_type::kCast) != 0 && (commandOf(command::kBake).scenes & *type) != 0;
}

bool Viewer::bakeTakes(const std::string& key, const std::string& value) const {
    const Option* const option = findOption(command::kBake, key);
    const auto type = sceneTypeOf(mOptions.scene);
    if (!option || !type || (option->scenes & *type) == 0) return false;
    GivenOptions given;
    given.command = command::kBake;
    given.add(key, readValue(option->name(), option->value, option->advice, value), option->name());
    const Asked asked{given, *type};
    return std::none_of(option->rules.begin(), option->rules.end(),
                        [&](const OptionRule& rule) { return rule.broken(asked); });
}

void Viewer::bakeLight(const std::string& what, double minutes) {
    tryTo([&] {
        checkNoJob();
        const SettingTexts settings = this->settings();
        std::vector<std::string> words = commandWords(command::kBake, settings);
        words.push_back("--what=" + what);
        const std::string time = fmt::format("{:.6g}", minutes);
        if (bakeTakes("minutes", time)) words.push_back("--minutes=" + time);
        const std::string baked = placeOfBake(words).string();
        words.push_back("--out=" + baked);
        startJob("baked light", words);
        mBaked = baked;
        mBakedScene = mOptions.scene.scene;
    });
}

void Viewer::lookAtJob() {
    if (!mJob || !mJob->running()) return;
    mJob->look();
    if (mJob->running()) return;
    mJobPath.reset();
    mJobPlace.reset();
    const std::string baked = std::exchange(mBaked, "");
    if (mJob->failed()) {
        mFailure = mJob->lastLine().empty() ? mJob->what() + " was not made" : mJob->lastLine();
    } else if (mJob->cancelled()) {
        mSession->notify(mJob->what() + ": cancelled");
    } else {
        mSession->notify(fmt::format("{}: done in {:.0f} s", mJob->what(), mJob->seconds()));
        if (!baked.empty() && mBakedScene == mOptions.scene.scene) set("light", baked);
    }
}

}  // namespace stereonav
