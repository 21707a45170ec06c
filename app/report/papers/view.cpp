#include "app/report/papers/view.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <random>

#include "colon/scene/isosurface_scene.h"
#include "engine/light/skies/spherical_harmonics.h"
#include "engine/light/transfer/bake_texels.h"
#include "engine/light/transfer/seen_bricks.h"
#include "engine/light/transfer/transfer_volume.h"
#include "engine/volume/volume_renderer.h"

namespace stereonav {
namespace {

EyeView viewOf(const ColonScene& scene, int side) {
    Lens lens = scene.lens;
    lens.width = lens.height = side;
    return makeEyeView(scene.startPose, lens);
}

GreyVolume copyOf(const GreyVolume& volume) {
    GreyVolume copy(volume.frame);
    std::copy_n(volume.values.data(), volume.values.size(), copy.values.data());
    copy.scale = volume.scale;
    copy.offset = volume.offset;
    return copy;
}

// One way of lighting a frame, with its image.
class Frame {
public:
    Frame(const VolumeScene& scene, const EyeView& view) : mRenderer(scene), mView(view) {
        mImage.resize(view.width, view.height, mRenderer.viewDependence());
    }
    void run() {
        const Stopwatch watch;
        renderEye(mRenderer, mView, mImage);
        mTimes_ms.push_back(watch.elapsed_ms());
    }
    const std::vector<double>& times_ms() const { return mTimes_ms; }
    const EyeImage& image() const { return mImage; }

private:
    VolumeRenderer mRenderer;
    EyeView mView;
    EyeImage mImage;
    std::vector<double> mTimes_ms;
};

struct Transfer {
    TransferVolume volume;
    std::shared_ptr<IlluminationVolume> light;
    std::vector<glm::vec3> sky = std::vector<glm::vec3>(harmonicsCount(kPaperOrder), glm::vec3(0.5f));
};

// Returns transfer with arbitrary numbers: the time of the products does not depend on them.
Transfer madeTransfer(const VolumeScene& scene) {
    const VolumeFrame texels = texelFrame(scene.field.frame, 1);
    const float isovalue = scene.cells.isovalue;
    Progress quiet;
    const std::vector<TexelBrick> bricks =
        wantedBricks(scene.field, texels, {isovalue, isovalue, nullptr, false}, quiet);
    Transfer transfer{TransferVolume(texels, kPaperOrder, 1, bricks),
                      std::make_shared<IlluminationVolume>(texels)};
    std::vector<float> numbers;
    for (std::size_t n = 0; n < bricks.size(); ++n) {
        numbers.assign(static_cast<std::size_t>(countTexels(bricks[n].wanted)) * harmonicsCount(kPaperOrder),
                       0.1f);
        transfer.volume.setBrick(n, numbers);
    }
    transfer.volume.relightAll(transfer.sky, *transfer.light);
    return transfer;
}

}  // namespace

EngineView::EngineView(const PaperEngine& engine) {
    Progress quiet;
    mScene = isosurfaceScene(copyOf(engine.volume), {}, quiet);
    VolumeLook& look = mScene.volume.look;
    look.specular = look.falloff = 0;
    const double across =
        glm::length(glm::dvec3(mScene.volume.field.frame.size) * mScene.volume.field.frame.spacing);
    look.lampAt = mScene.startPose.position + across * glm::dvec3(0.15, -0.3, 0.9);
}

EngineView::Seen EngineView::seen(int side) const {
    constexpr std::size_t kTogether = 64;
    const EyeView view = viewOf(mScene, side);
    Frame frame(mScene.volume, view);
    frame.run();
    const GreyVolume& field = mScene.volume.field;
    const float isovalue = mScene.volume.cells.isovalue;
    const TexelChooser chooser(field, field.frame, {isovalue, isovalue, nullptr, false});
    const TexelLayout layout(field.frame.size);
    Seen seen;
    for (const std::uint32_t number : bricksSeen(view, frame.image(), IlluminationVolume(field.frame))) {
        seen.texels.push_back(texelsIn(layout, {number, chooser.brick(number)}));
        seen.texelCount += seen.texels.back().size();
    }
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const auto depth = static_cast<double>(frame.image().viewDepth.at(x, y));
            if (!(depth < static_cast<double>(kMissDepth))) continue;
            const glm::dvec3 ray = view.rayDirection(x + 0.5, y + 0.5);
            if (seen.pixelCount++ % kTogether == 0) seen.pixels.emplace_back();
            seen.pixels.back().push_back({field.frame.voxelFromWorld(view.eye + depth * ray),
                                          static_cast<double>(isovalue), -glm::normalize(ray),
                                          static_cast<std::uint64_t>(y) * side + x});
        }
    seen.texels = inSmallPieces(seen.texels);
    std::shuffle(seen.pixels.begin(), seen.pixels.end(), std::mt19937(1));
    return seen;
}

EngineView::FrameTimes EngineView::frameTimes(ReportRun& run, int side, int frames) {
    VolumeScene& scene = mScene.volume;
    VolumeLook& look = scene.look;
    const EyeView view = viewOf(mScene, side);
    Frame diffuse(scene, view);
    look.shadows = true;
    Frame shadowed(scene, view);
    look.specular = 0.3f;
    Frame phong(scene, view);
    look.specular = 0;
    look.shadows = false;
    Transfer transfer = madeTransfer(scene);
    look.baked.light = transfer.light;
    Frame irradiance(scene, view);
    std::vector<double> harmonics;
    for (int n = 0; n < frames; ++n) {
        run.tell("light, frames");
        for (Frame* frame : {&diffuse, &shadowed, &phong, &irradiance}) frame->run();
        const Stopwatch watch;
        const auto held = transfer.volume.heldAmong(bricksSeen(view, irradiance.image(), *transfer.light));
        transfer.volume.relight(transfer.sky, held, *transfer.light);
        harmonics.push_back(irradiance.times_ms().back() + watch.elapsed_ms());
    }
    look.baked = {};
    return {spreadOf(diffuse.times_ms()), spreadOf(shadowed.times_ms()), spreadOf(phong.times_ms()),
            spreadOf(irradiance.times_ms()), spreadOf(harmonics)};
}

EngineView::Memory EngineView::memory() const {
    const Transfer transfer = madeTransfer(mScene.volume);
    return {transfer.volume.texels(), transfer.light->bytesHeld(), transfer.volume.bytesHeld()};
}

}  // namespace stereonav
