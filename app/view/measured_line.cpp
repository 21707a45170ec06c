#include "app/view/measured_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "app/view/kept_file.h"
#include "engine/base/error.h"
#include "engine/text/json_text.h"
#include "engine/text/length_text.h"
#include "terrain/scene/terrain_scene.h"

namespace stereonav {
namespace {

constexpr int kMeasuredVersion = 1;

// Returns the place at the present height of the ground: heights may have been exaggerated differently when
// it was added.
glm::dvec3 onGround(const TerrainScene& terrain, const glm::dvec3& place) {
    const glm::dvec2 at(place);
    const double height = terrain.ground.contains(at) ? terrain.ground.heightAt(at) : std::nan("");
    return std::isfinite(height) ? glm::dvec3(at, height) : place;
}

bool isMeasuredLine(const nlohmann::json& file) {
    if (!file.is_object() ||
        file.value("stereonav_line", nlohmann::json()) != nlohmann::json(kMeasuredVersion) ||
        !file.contains("places_m") || !file["places_m"].is_array() ||
        file["places_m"].size() > MeasuredLine::kMost || !file.contains("closed") ||
        !file["closed"].is_boolean())
        return false;
    for (const nlohmann::json& place : file["places_m"]) {
        if (!place.is_array() || place.size() != 3) return false;
        for (const nlohmann::json& number : place)
            if (!number.is_number() || !(std::abs(number.get<double>()) <= 1e9)) return false;
    }
    return true;
}

}  // namespace

MeasuredSurface straightMeasure(const std::vector<glm::dvec3>& places, bool closed) {
    MeasuredSurface measured;
    measured.places = places;
    if (closed) measured.places.push_back(places.front());
    double length = 0;
    for (std::size_t n = 1; n < measured.places.size(); ++n)
        length += glm::distance(measured.places[n - 1], measured.places[n]);
    FactList list;
    list.both("straight_m", length, closed ? "straight, around" : "straight", lengthText(length), "m");
    if (places.size() > 2 && !closed) {
        const double ends = glm::distance(places.front(), places.back());
        list.both("ends_m", ends, "from end to end", lengthText(ends), "m");
    }
    measured.facts = std::move(list.facts());
    return measured;
}

void MeasuredLine::open(std::shared_ptr<const Scene> scene, const std::filesystem::path& file) {
    mFile = file;
    mPlaces.clear();
    mClosed = false;
    std::string problem;
    if (!file.empty())
        if (const auto kept = readKeptJson(file, isMeasuredLine, problem)) {
            for (const nlohmann::json& place : (*kept)["places_m"])
                mPlaces.emplace_back(place[0].get<double>(), place[1].get<double>(), place[2].get<double>());
            mClosed = (*kept)["closed"].get<bool>();
        }
    replaceScene(std::move(scene));
    mProblem = problem;
}

void MeasuredLine::replaceScene(std::shared_ptr<const Scene> scene) {
    mScene = std::move(scene);
    if (const auto* const terrain = mScene ? mScene->offered<const TerrainScene>() : nullptr)
        for (glm::dvec3& place : mPlaces) place = onGround(*terrain, place);
    mMeasured.reset();
    mProblem.clear();
    measureAgain();
}

bool MeasuredLine::add(const glm::dvec3& place) {
    if (mPlaces.size() == kMost || (!mPlaces.empty() && mPlaces.back() == place)) return false;
    mPlaces.push_back(place);
    changed();
    return true;
}

void MeasuredLine::removeLast() {
    if (mPlaces.empty()) return;
    mPlaces.pop_back();
    changed();
}

void MeasuredLine::clear() {
    if (mPlaces.empty()) return;
    mPlaces.clear();
    mClosed = false;
    changed();
}

void MeasuredLine::setClosed(bool closed) {
    if (closed == mClosed) return;
    mClosed = closed;
    changed();
}

bool MeasuredLine::take(const std::vector<glm::dvec3>& places, bool closed) {
    const std::size_t count = std::min(places.size(), kMost);
    std::vector<glm::dvec3> taken;
    for (std::size_t n = 0; n < count; ++n) {
        const glm::dvec3& place = places[count < 2 ? n : n * (places.size() - 1) / (count - 1)];
        if (taken.empty() || taken.back() != place) taken.push_back(place);
    }
    if (taken.size() < 2) return false;
    mPlaces = std::move(taken);
    mClosed = closed && mPlaces.size() > 2;
    changed();
    return true;
}

void MeasuredLine::setEyeHeight(double height) {
    if (height == mEyeHeight) return;
    mEyeHeight = height;
    measureAgain();
}

// Measures again; work that is under way is for the line before, and ends soon.
void MeasuredLine::measureAgain() {
    mDue = mPlaces.size() > 1;
    mWork.cancel();
}

void MeasuredLine::changed() {
    measureAgain();
    mProblem.clear();
    if (!mDue) mMeasured.reset();
    write();
}

// Writes the line; a failure must not stop measuring.
void MeasuredLine::write() {
    if (mFile.empty()) return;
    nlohmann::json places = nlohmann::json::array();
    for (const glm::dvec3& place : mPlaces) places.push_back({place.x, place.y, place.z});
    try {
        const nlohmann::json line{
            {"stereonav_line", kMeasuredVersion}, {"closed", mClosed}, {"places_m", places}};
        writeKept(mFile, jsonText(line, 1) + "\n");
    } catch (const Error& error) {
        mProblem = error.what();
    }
}

MeasuredLine::Outcome MeasuredLine::outcomeOf(const Scene& scene, const std::vector<glm::dvec3>& places,
                                              bool closed, double eyeHeight, Progress& progress) {
    try {
        if (const auto* const measurer = scene.offered<LineMeasurer>()) {
            Outcome outcome{measurer->measure(places, closed, progress), ""};
            if (closed) return outcome;
            for (Fact& fact : measurer->sight(places[places.size() - 2], places.back(), eyeHeight))
                outcome.measured.facts.push_back(std::move(fact));
            return outcome;
        }
        return {straightMeasure(places, closed), ""};
    } catch (const std::exception& error) {
        return {{}, error.what()};
    }
}

// Takes a finished measurement. One that was begun before a change was cancelled by it.
bool MeasuredLine::takeMeasured() {
    try {
        std::optional<Outcome> outcome = mWork.take();
        if (!outcome) return false;
        mProblem = outcome->problem;
        mMeasured.reset();
        if (mProblem.empty()) mMeasured = std::move(outcome->measured);
        return true;
    } catch (const Cancelled&) {
        return false;
    }
}

bool MeasuredLine::poll() {
    const bool isNew = takeMeasured();
    if (!mDue || mWork.busy() || !mScene) return isNew;
    mDue = false;
    mWork.start(
        [scene = mScene, places = mPlaces, closed = mClosed && mPlaces.size() > 2, height = mEyeHeight](
            Progress& progress) { return outcomeOf(*scene, places, closed, height, progress); },
        mWake);
    return isNew;
}

}  // namespace stereonav
