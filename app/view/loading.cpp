#include "app/view/loading.h"

#include <chrono>
#include <utility>

#include "app/command/quality.h"
#include "app/scene/colon_loading.h"
#include "app/scene/medium_loading.h"
#include "app/scene/volume_light.h"
#include "app/view/sweep.h"

namespace stereonav {
namespace {

constexpr double kUsualOpacity = 0.95;  // of a translucent wall a millimetre: that of Wan et al. 2004

// Told where a key would turn it, if it does not turn.
std::string whyLightStays(const LoadedScene& scene, const SceneOptions& options) {
    if (scene.medium) return "a lamp lights this medium: --light-from gives light that turns";
    if (scene.terrain) return "the sun stands still in this ground's colours: --light gives one that moves";
    if (options.light.empty()) return "a lamp lights this volume: --light gives a sky that turns";
    if (options.light == kLazyLight)
        return "the sky is part of this light: --light lazy-transfer has one that turns";
    return "the sky is baked into this light: bake --what transfer for one that turns";
}

ViewScene viewOf(const std::shared_ptr<LoadedScene>& loaded, const ViewOptions& options, bool measure,
                 ViewSweep* sweep, Progress& progress) {
    ViewScene scene;
    scene.owner = loaded;
    scene.frames = loaded->frames.get();
    scene.makeFlight = loaded->makeFlight;
    scene.path = loaded->path;
    scene.lens = loaded->lens;
    scene.stereo = loaded->stereo;
    // A recorded flight is looked at once, with the scene that it was given for.
    if (measure && !options.path.empty()) flightOf(*loaded, readPath(options.path), options.path);
    if (loaded->colon) addVolume(*loaded, options.scene, scene);
    scene.lightStays = whyLightStays(*loaded, options.scene);
    if (loaded->medium) {
        addMedium(*loaded, scene);
        if (sweep) sweep->use(*loaded->swept, scene);
        scene.way.method = sweepMethodFromText(options.method);
        return scene;
    }
    if (loaded->moveSun) {
        const TerrainLook& look = loaded->terrain->look;
        scene.sun = {look.sunAzimuth, look.sunElevation};
        scene.moveSun = [owner = loaded.get()](const SunPlace& sun) {
            const TerrainLook& now = owner->terrain->look;
            if (sun.azimuth != now.sunAzimuth || sun.elevation != now.sunElevation)
                owner->moveSun(sun.azimuth, sun.elevation);
        };
    }
    if (loaded->colon)
        scene.change = [loaded, options, methods = scene.ambientMethods](const SceneOptions& to,
                                                                         Progress& p) {
            ViewOptions next = options;
            next.scene = to;
            ViewScene changed =
                viewOf(std::make_shared<LoadedScene>(changedColonScene(*loaded, options.scene, to, p)), next,
                       false, nullptr, p);
            changed.changed = true;
            changed.ambientMethods = methods;  // one that was given stays among them
            return changed;
        };
    scene.way.method = nameOf(methodFromText(options.method).value_or(loaded->defaultMethod()));
    // A study is opened quickly: it gets its default.
    if (const auto plan = qualityOf(options.scene, *loaded, options.method, progress)) {
        scene.way = {nameOf(plan->setting.method), plan->setting};
    } else if (measure && options.method == "auto" && loaded->terrain) {
        progress.report(1.0, "measuring how to make the right eye");
        if (const auto measured = planScene(*loaded)) scene.way.method = nameOf(measured->method);
    }
    return scene;
}

void setTransfer(const SceneChange& change, const VolumeOptions& first, VolumeOptions& volume) {
    volume.transfer.clear();
    volume.opacity.reset();
    if (!change.translucent.value_or(false)) return;
    volume.transfer = change.transfer.value_or("");
    if (!volume.transfer.empty()) return;
    volume.transfer = first.transfer;
    volume.opacity = first.opacity;
    if (volume.transfer.empty() && !volume.opacity) volume.opacity = kUsualOpacity;
}

// What has no effect is left out, since it would be refused.
void setAmbient(const ViewAmbient& to, bool translucent, const VolumeOptions& first, VolumeOptions& volume) {
    const bool modulated = translucent && !to.modulate.empty();
    volume.ambient_mm.reset();
    volume.ambientStrength.reset();
    volume.ambientLamp.reset();
    volume.modulateRadius_mm.reset();
    volume.modulateSigma.reset();
    volume.ambientMethod = to.lit || (modulated && to.modulate == "gradient") ? to.method : "";
    volume.modulate = modulated ? to.modulate : "";
    if (to.lit) {
        volume.ambient_mm = 1000 * to.radius;
        volume.ambientStrength = first.ambientStrength;
        volume.ambientLamp = first.ambientLamp;
    }
    if (modulated) volume.modulateRadius_mm = 1000 * to.modulateRadius;
    if (modulated && to.sigma > 0) volume.modulateSigma = to.sigma;
}

// What may be refused later is what is shown now.
void noteWhatIsShown(const VolumeOptions& volume, GivenOptions& given) {
    const auto note = [&](const char* key, bool is, const std::string& text, double number) {
        given.forget(key);
        OptionValue value;
        value.text = text;
        value.numbers = {number};
        if (is) given.add(key, value, std::string("--") + key);
    };
    const auto number = [&](const char* key, const std::optional<double>& value) {
        note(key, value.has_value(), "", value.value_or(0));
    };
    number("isovalue", volume.isovalue);
    number("opacity", volume.opacity);
    number("ambient", volume.ambient_mm);
    number("ambient-strength", volume.ambientStrength);
    number("ambient-lamp", volume.ambientLamp);
    number("modulate-radius", volume.modulateRadius_mm);
    number("modulate-sigma", volume.modulateSigma);
    note("transfer", !volume.transfer.empty(), volume.transfer, 0);
    note("ambient-method", !volume.ambientMethod.empty(), volume.ambientMethod, 0);
    note("modulate", !volume.modulate.empty(), volume.modulate, 0);
}

}  // namespace

ViewScene viewSceneOf(const ViewOptions& options, bool measure, ViewSweep* sweep, Progress& progress) {
    return viewOf(std::make_shared<LoadedScene>(loadScene(options.scene, options.size, progress)), options,
                  measure, sweep, progress);
}

void applyChange(const SceneChange& change, const ViewOptions& first, SceneOptions& options) {
    VolumeOptions& volume = options.volume;
    if (change.isovalue) volume.isovalue = change.isovalue;
    if (change.translucent) setTransfer(change, first.scene.volume, volume);
    if (change.ambient)
        setAmbient(*change.ambient, change.translucent.value_or(false), first.scene.volume, volume);
    noteWhatIsShown(volume, options.given);
    if (!change.seeds) return;
    volume.seeds.clear();
    for (const glm::dvec3& seed : *change.seeds) volume.seeds.push_back(seedText(seed));
}

void SliceReading::start(std::shared_ptr<const ViewScene> scene, std::function<void()> wake) {
    if (busy() || !scene->readSlices) return;
    mReading = std::async(std::launch::async, [this, scene = std::move(scene), wake = std::move(wake)] {
        try {
            auto study = scene->readSlices(mProgress);
            wake();
            return study;
        } catch (...) {
            wake();
            throw;
        }
    });
}

std::shared_ptr<const SliceStudy> SliceReading::take() {
    if (!busy() || mReading.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return nullptr;
    return mReading.get();
}

}  // namespace stereonav
