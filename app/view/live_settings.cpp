#include "app/view/live_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "app/options/option_value.h"
#include "app/view/sun_clock.h"
#include "engine/scene/live_paint.h"
#include "engine/scene/shown_values.h"
#include "engine/text/number.h"
#include "engine/volume/transfer_text.h"
#include "terrain/scene/terrain_scene.h"

namespace stereonav {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr const char* kPaintKeys[] = {"contours", "paint", "tracks"};

// The option that sets a scene's turning light.
enum class LightKey { None, Sun, LightFrom, Sky };
LightKey lightKeyOf(const ViewSession& session) {
    const Scene& scene = *session.open().scene;
    const auto* const light = scene.offered<TurningLight>();
    if (!light) return LightKey::None;
    if (light->isSky()) return LightKey::Sky;
    return scene.offered<LightModels>() ? LightKey::LightFrom : LightKey::Sun;
}

std::string sunText(const SunPlace& sun) {
    return sunOptionText({std::remainder(sun.azimuth, 2 * std::numbers::pi), sun.elevation});
}

std::string sunNow(const ViewSession& s) {
    return sunText(s.light().sun());
}
bool sunAsBegun(const ViewSession& s) {
    return sunNow(s) == sunText(s.open().sun);
}
void setSun(ViewSession& s, const OptionValue& value) {
    s.light().place({value.numbers[0] * kDegree, value.numbers[1] * kDegree});
}
void resetSun(ViewSession& s) {
    s.light().place(s.open().sun);
}

std::string turnText(const SunPlace& sky) {
    return degreeText(std::remainder(-sky.azimuth, 2 * std::numbers::pi));
}

struct Live {
    const char* key;
    bool (*has)(const ViewSession&);
    std::string (*now)(const ViewSession&);
    // Whether the option can be left out. Light that was turned away and back differs by rounding: its texts
    // are compared.
    bool (*asBegun)(const ViewSession&);
    void (*set)(ViewSession&, const OptionValue&);
    void (*reset)(ViewSession&);
};

bool always(const ViewSession&) {
    return true;
}
const SurfaceChoices* surfaceOf(const ViewSession& session) {
    return session.open().scene->offered<SurfaceChoices>();
}
// Returns null where the scene does not know.
const BegunSurface* begunOf(const ViewSession& session) {
    const auto* const shown = session.open().scene->offered<ShownValues>();
    return shown && surfaceOf(session) ? &shown->begun : nullptr;
}
bool takesByName(const ViewSession& session, const std::string& text) {
    const auto& names = surfaceOf(session)->transfers;
    return std::find(names.begin(), names.end(), text) != names.end();
}
// Returns the transfer function in use; "" where the surface is opaque or has an opacity instead.
std::string transferText(const ViewSession& session) {
    const SurfaceChange now = session.surface().now();
    if (!*now.translucent) return "";
    const BegunSurface* const begun = begunOf(session);
    return now.transfer->empty() && begun ? begun->transfer : *now.transfer;
}
std::string opacityText(const ViewSession& session) {
    const BegunSurface* const begun = begunOf(session);
    const bool by = begun && *session.surface().now().translucent && transferText(session).empty();
    return by ? fmt::format("{}", begun->opacity) : "";
}
void showThrough(ViewSession& session, const std::string& transfer) {
    SurfaceChange change;
    change.translucent = true;
    change.transfer = transfer;
    session.surface().set(change);
}
void showOpaque(ViewSession& session) {
    SurfaceChange change;
    change.translucent = false;
    session.surface().set(change);
}
// For values that tellFunction() adds.
bool saidApart(const ViewSession&) {
    return true;
}
// Returns whether the eyes are set by hand: they neither follow the room nor were fitted to the first
// picture.
bool eyesAreSet(const ViewSession& session) {
    return !session.followsClearance() && !session.eyes().fits() && !session.eyes().fitted();
}
const StereoSetting& begunEyes(const ViewSession& session) {
    return session.eyes().begun(*session.open().scene);
}
// Returns whether a part of the eyes' setting can be left out: nothing was set, or it is as the window began.
// Where one part is given the other is given, too, unless it is the scene's own: both are fitted, or none.
bool eyesAsBegun(const ViewSession& session, double StereoSetting::*part) {
    if (!eyesAreSet(session)) return true;
    const StereoSetting &wanted = session.eyesWanted(), &begun = begunEyes(session);
    const bool both = wanted.separation == begun.separation && wanted.zeroParallax == begun.zeroParallax;
    return both || wanted.*part == session.open().scene->stereo.*part;
}

// One eye is the left one's mode where the window begins so, and no setting where key 3 came to it.
std::string modeText(const ViewSession& s) {
    const bool two = s.shownMode().stereo || s.firstMode().stereo;
    return std::string(infoOf(two ? s.mode() : OutputMode::Left).shortName);
}
bool modeAsBegun(const ViewSession& s) {
    return s.firstMode().stereo ? s.mode() == s.firstMode().mode : !s.shownMode().stereo;
}

constexpr Live kLive[] = {
    {"mode", always, modeText, modeAsBegun,
     [](ViewSession& s, const OptionValue& value) {
         s.chooseMode(outputModeFromName(value.text).value_or(s.mode()));
     },
     [](ViewSession& s) { s.show(s.firstMode()); }},
    {"method", always, [](const ViewSession& s) { return std::string(s.method()); },
     [](const ViewSession& s) { return s.method() == s.open().way.method; },
     [](ViewSession& s, const OptionValue& value) {
         s.chooseMethod(value.text == "auto" ? s.open().way.method : std::string_view(value.text));
     },
     [](ViewSession& s) { s.chooseMethod(s.open().way.method); }},
    {"separation", always,
     [](const ViewSession& s) { return fmt::format("{:.4g}", s.eyesWanted().separation); },
     [](const ViewSession& s) { return eyesAsBegun(s, &StereoSetting::separation); },
     [](ViewSession& s, const OptionValue& value) {
         s.setEyes({value.number(), s.eyesWanted().zeroParallax});
     },
     [](ViewSession& s) {
         s.setEyes({begunEyes(s).separation, s.eyesWanted().zeroParallax});
     }},
    {"zero-parallax", always,
     [](const ViewSession& s) { return fmt::format("{:.4g}", s.eyesWanted().zeroParallax); },
     [](const ViewSession& s) { return eyesAsBegun(s, &StereoSetting::zeroParallax); },
     [](ViewSession& s, const OptionValue& value) {
         s.setEyes({s.eyesWanted().separation, value.number()});
     },
     [](ViewSession& s) {
         s.setEyes({s.eyesWanted().separation, begunEyes(s).zeroParallax});
     }},
    {"fov", always, [](const ViewSession& s) { return degreeText(s.lens().verticalFov); },
     [](const ViewSession& s) { return s.lens().verticalFov == s.open().scene->lens.verticalFov; },
     [](ViewSession& s, const OptionValue& value) { s.setFov(value.number() * kDegree); },
     [](ViewSession& s) { s.setFov(std::nullopt); }},
    {"sun", [](const ViewSession& s) { return lightKeyOf(s) == LightKey::Sun; }, sunNow, sunAsBegun, setSun,
     resetSun},
    {"light-from", [](const ViewSession& s) { return lightKeyOf(s) == LightKey::LightFrom; }, sunNow,
     sunAsBegun, setSun, resetSun},
    {"turn", [](const ViewSession& s) { return lightKeyOf(s) == LightKey::Sky; },
     [](const ViewSession& s) { return turnText(s.light().sun()); },
     [](const ViewSession& s) { return turnText(s.light().sun()) == turnText(s.open().sun); },
     [](ViewSession& s, const OptionValue& value) {
         s.light().place({-value.number() * kDegree, s.light().sun().elevation});
     },
     [](ViewSession& s) {
         s.light().place({s.open().sun.azimuth, s.light().sun().elevation});
     }},
    {"tilt", [](const ViewSession& s) { return lightKeyOf(s) == LightKey::Sky; },
     [](const ViewSession& s) { return degreeText(s.light().sun().elevation); },
     [](const ViewSession& s) {
         return degreeText(s.light().sun().elevation) == degreeText(s.open().sun.elevation);
     },
     [](ViewSession& s, const OptionValue& value) {
         s.light().place({s.light().sun().azimuth, value.number() * kDegree});
     },
     [](ViewSession& s) {
         s.light().place({s.light().sun().azimuth, s.open().sun.elevation});
     }},
    {"model",
     [](const ViewSession& s) {
         const auto* const models = s.open().scene->offered<LightModels>();
         return models && !models->names().empty();
     },
     [](const ViewSession& s) {
         return s.open().scene->offered<LightModels>()->names()[static_cast<std::size_t>(s.light().model())];
     },
     [](const ViewSession& s) { return s.light().model() == s.open().model; },
     [](ViewSession& s, const OptionValue& value) {
         const auto& names = s.open().scene->offered<LightModels>()->names();
         s.light().choose(
             static_cast<int>(std::find(names.begin(), names.end(), value.text) - names.begin()));
     },
     [](ViewSession& s) { s.light().choose(s.open().model); }},
    {"isovalue", [](const ViewSession& s) { return surfaceOf(s) && s.surface().now().isovalue.has_value(); },
     [](const ViewSession& s) { return fmt::format("{:.6g}", *s.surface().now().isovalue); },
     [](const ViewSession& s) {
         if (const auto* const begun = begunOf(s)) return s.surface().now().isovalue == begun->isovalue;
         return s.surface().now().isovalue == surfaceOf(s)->isovalue && !s.open().changed;
     },
     [](ViewSession& s, const OptionValue& value) {
         SurfaceChange change;
         change.isovalue = value.number();
         s.surface().set(change);
     },
     [](ViewSession& s) {
         SurfaceChange change;
         if (const auto* const begun = begunOf(s)) change.isovalue = begun->isovalue;
         s.surface().set(change);
     }},
    {"transfer", [](const ViewSession& s) { return surfaceOf(s) != nullptr; }, transferText, saidApart,
     [](ViewSession& s, const OptionValue& value) {
         const BegunSurface* const begun = begunOf(s);
         // A file is that of the options.
         const bool own = begun && begun->transfer == value.text && !takesByName(s, value.text);
         showThrough(s, own ? "" : value.text);
     },
     [](ViewSession& s) {
         if (!transferText(s).empty()) showOpaque(s);
     }},
    {"opacity", [](const ViewSession& s) { return begunOf(s) != nullptr; }, opacityText, saidApart,
     [](ViewSession& s, const OptionValue&) { showThrough(s, ""); },
     [](ViewSession& s) {
         if (!opacityText(s).empty()) showOpaque(s);
     }},
};

const Live* liveNamed(const ViewSession& session, const std::string& key) {
    for (const Live& live : kLive)
        if (key == live.key && live.has(session)) return &live;
    return nullptr;
}

// Returns whether the scene takes this function at once: a name or a curve, or the file that it was opened
// with.
bool takesTransfer(const ViewSession& session, const std::string& text) {
    const BegunSurface* const begun = begunOf(session);
    return takesByName(session, text) || isCurveText(text) ||
           (begun && !text.empty() && begun->transfer == text);
}

// Returns whether the opacity is the one that the scene was opened with, or its default.
bool takesOpacity(const ViewSession& session, const std::string& text) {
    const BegunSurface* const begun = begunOf(session);
    return begun && begun->transfer.empty() && numberOf(text) == begun->opacity;
}

// Returns the paint that the key exchanges; null for other keys, and where the scene has to be made again.
LivePaint* paintOf(const ViewSession& session, const std::string& key) {
    const auto is = [&](const char* one) { return key == one; };
    return std::any_of(std::begin(kPaintKeys), std::end(kPaintKeys), is)
               ? session.open().scene->offered<LivePaint>()
               : nullptr;
}

// Adds the paint in use. Paint that the scene does not take is for another scene, which is being made.
void tellPaint(const ViewSession& session, SettingTexts& given) {
    for (const char* const key : kPaintKeys) {
        const LivePaint* const paint = paintOf(session, key);
        const auto said = given.find(key);
        if (!paint || !paint->takes(key, said == given.end() ? "" : said->second.back())) continue;
        given.erase(key);
        if (const std::string text = paint->now(key); !text.empty()) given[key] = {text};
    }
}

// Adds the function or the opacity in use: two ways to set one thing.
void tellFunction(const ViewSession& session, SettingTexts& given) {
    if (!begunOf(session)) {
        if (surfaceOf(session) && !transferText(session).empty()) given["transfer"] = {transferText(session)};
        return;
    }
    given.erase("transfer");
    given.erase("opacity");
    if (const std::string text = transferText(session); !text.empty()) given["transfer"] = {text};
    if (const std::string text = opacityText(session); !text.empty()) given["opacity"] = {text};
}

}  // namespace

bool isLive(const ViewSession& session, const std::string& key) {
    if (const LivePaint* const paint = paintOf(session, key)) return paint->takes(key, "");
    return key != "opacity" && liveNamed(session, key) != nullptr;
}

bool isLive(const ViewSession& session, const std::string& key, const std::optional<std::string>& text) {
    if (const LivePaint* const paint = paintOf(session, key)) return paint->takes(key, text.value_or(""));
    const Live* const live = liveNamed(session, key);
    if (!live) return false;
    if (key == "isovalue" && !text) return begunOf(session) && begunOf(session)->isovalueChosen;
    if (key == "transfer") return !text || takesTransfer(session, *text);
    if (key == "opacity") return !text || takesOpacity(session, *text);
    return true;
}

SettingTexts withLive(const ViewSession& session, SettingTexts given) {
    for (const Live& live : kLive) {
        if (!live.has(session)) continue;
        if (!live.asBegun(session)) given[live.key] = {live.now(session)};
    }
    tellFunction(session, given);
    tellPaint(session, given);
    return given;
}

std::optional<std::string> valueNow(const ViewSession& session, const std::string& key) {
    if (const LivePaint* const paint = paintOf(session, key)) return paint->now(key);
    if (const auto* const terrain = session.open().scene->offered<const TerrainScene>();
        terrain && key == "vertical-scale")
        return fmt::format("{:.6g}", terrain->verticalScale);
    const Live* const live = liveNamed(session, key);
    return live ? std::optional(live->now(session)) : std::nullopt;
}

void keepPaint(const Scene& before, const Scene& after) {
    const auto* const old = before.offered<LivePaint>();
    auto* const fresh = after.offered<LivePaint>();
    if (!old || !fresh) return;
    for (const char* const key : kPaintKeys)
        if (const std::string text = old->now(key); fresh->takes(key, text)) fresh->ask(key, text);
}

void setLive(ViewSession& session, const std::string& key, const std::optional<std::string>& text) {
    LivePaint* const paint = paintOf(session, key);
    const Live* const live = liveNamed(session, key);
    if (!live && !paint) return;
    if (!text) return paint ? paint->ask(key, "") : live->reset(session);
    const Option& option = *viewOption(key);
    const OptionValue value = readValue(option.name(), option.value, option.advice, *text);
    if (paint) return paint->ask(key, *text);
    live->set(session, value);
}

}  // namespace stereonav
