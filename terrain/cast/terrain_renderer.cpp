// Chooses the kernels, hands them bands and batches, and adds what only some scenes have: landmarks and
// view-dependent highlights.
#include "terrain/cast/terrain_renderer.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <utility>
#include <vector>

#include "engine/base/error.h"
#include "terrain/cast/caster_scene.h"
#include "terrain/cast/caster_types.h"
#include "terrain/cast/fog_row.h"
#include "terrain/cast/ground_detail.h"
#include "terrain/cast/hole_rays.h"
#include "terrain/cast/ring_scenes.h"
#include "terrain/cast/specular.h"
#include "terrain/cast/terrain_view.h"
#include "terrain/ground/height_pyramid.h"
#include "terrain/light/fog.h"
#include "terrain/scene/landmark.h"
#include "terrain/scene/terrain_illumination.h"

namespace stereonav {
namespace {

constexpr float kUnseen = 1e-7f;  // a tenth of the first step of a packed channel, linear

const CasterKernels& kernelsFor(SimdTarget target) {
    return kernelsOf(target, plain::kCasterKernels, avx2::kCasterKernels, avx512::kCasterKernels);
}

CasterTarget targetOf(EyeImage& image) {
    return {image.color.row(0), image.viewDepth.row(0), image.color.stride(), image.viewDepth.stride()};
}

std::vector<PixelIndex> pixelsOf(const CasterView& view, const CasterBand& band) {
    std::vector<PixelIndex> pixels;
    for (int q = band.firstStep; q < band.endStep; ++q) {
        const int end = bandEdge(band.right, band.rightSlope, q, view.lanes);
        for (int a = bandEdge(band.left, band.leftSlope, q, view.lanes); a < end; ++a)
            pixels.push_back({static_cast<std::uint16_t>(view.firstX + a * view.laneX + q * view.stepX),
                              static_cast<std::uint16_t>(view.firstY + a * view.laneY + q * view.stepY)});
    }
    return pixels;
}

// The highlights of a scene under the light that it has now.
Specular specularOf(const TerrainScene& terrain, const TerrainIllumination* light) {
    if (!light) return Specular(terrain.look);
    return Specular(terrain.look, light->highlightLight());
}

}  // namespace

struct TerrainRenderer::State {
    HeightPyramid pyramid;
    CasterScene scene, clear;  // clear: without its fog
    const CasterKernels* kernels;
    FogRowFunction changeFog;
    Specular specular;
    Fog fog;
    SkyMap sky;  // a physical sky whose sun has moved
    SimdTarget target;
    GroundFilter filter;
    const TerrainIllumination* light;      // null: the plain sun's
    std::unique_ptr<GroundDetail> detail;  // null: none
    std::unique_ptr<RingScenes> rings;     // null: the ground itself is cast
    PartColors parts;                      // colours of tiled ground, under `light` without it

    State(const TerrainScene& terrain, SimdTarget wanted, const GroundFilter& read)
        : pyramid(terrain.ground),
          specular(specularOf(terrain, terrain.illumination.get())),
          fog(terrain.look),
          target(availableTarget(wanted)),
          filter(read),
          light(terrain.illumination.get()) {
        kernels = &kernelsFor(target);
        changeFog = kernelsOf<FogRowFunction>(target, plain::changeFog, avx2::changeFog, avx512::changeFog);
        scene.ground = groundData(terrain.ground, pyramid);
        scene.texture = textureData(terrain.color, terrain.ground.spacing(), filter);
        scene.sky = {terrain.sky.map().row(0), terrain.sky.map().width(), terrain.sky.map().stride()};
        if (terrain.detail) {
            detail = std::make_unique<GroundDetail>(terrain.ground, terrain.weathered
                                                                        ? GroundDetail::Kind::Weathered
                                                                        : GroundDetail::Kind::Rough);
            scene.detail = detail->forKernels(terrain.look);
        }
        clear = scene;
        const glm::vec3& color = terrain.look.fogColor;
        if (fog.air())
            scene.air = fog.air()->data();
        else if (terrain.look.fogDistance > 0)
            scene.fog = {static_cast<float>(1 / terrain.look.fogDistance), {color.x, color.y, color.z}};
    }

    void colorParts(const TerrainScene& terrain) {
        if (rings) rings->colorParts(light ? litParts(parts, terrain, *light) : parts);
    }

    void sunMoved(const TerrainLook& look) {
        if (detail) scene.detail = clear.detail = detail->forKernels(look);
        if (!fog.air()) return;
        fog = Fog(look);
        scene.air = fog.air()->data();
        sky = skyMapOf(*fog.air());
        scene.sky = clear.sky = {sky.map().row(0), sky.map().width(), sky.map().stride()};
    }

    // Returns what is cast now, with its fog or without.
    const CasterScene& shown(bool withoutFog) const {
        if (rings && rings->any()) return rings->first(withoutFog);
        return withoutFog ? clear : scene;
    }
    void ringsChanged() {
        if (rings) rings->dress(scene, clear, filter);
    }

    // Returns the finest ground that is cast at a place.
    const Heightfield& groundAt(const glm::dvec2& place, const Heightfield& whole) const {
        if (rings && rings->any())
            for (const auto& ring : rings->rings().rings)
                if (ring->ground.contains(place)) return ring->ground;
        return whole;
    }

    CasterView viewOver(const EyeView& view, const Heightfield& ground) const {
        CasterView caster = makeCasterView(view, ground);
        if (fog.air()) caster.air = fog.air()->eyeAt(view.eye.z);
        return caster;
    }
    CasterView viewOf(const EyeView& view, const Heightfield& whole) const {
        return viewOver(view, rings && rings->any() ? rings->ground() : whole);
    }
};

TerrainRenderer::TerrainRenderer(const TerrainScene& scene, SimdTarget target, const GroundFilter& filter)
    : mScene(scene), mState(std::make_unique<State>(scene, target, filter)) {
    takeCoarser(scene.levelOfDetail);
}
TerrainRenderer::~TerrainRenderer() = default;

std::size_t TerrainRenderer::byteCount() const {
    return mState->pyramid.byteCount() + (mState->detail ? mState->detail->byteCount() : 0) +
           (mState->rings ? mState->rings->byteCount() : 0);
}

void TerrainRenderer::takeCoarser(double share) {
    if (!mScene.tiled) {
        mState->rings = share > 0 ? std::make_unique<RingScenes>(mScene.ground, share) : nullptr;
        return;
    }
    mState->rings = std::make_unique<RingScenes>(mScene.tiled->levels, mScene.tiled->level,
                                                 share > 0 ? share : TerrainScene::kTiledShare);
    mState->rings->mayBeLate(mScene.ringsMayBeLate);
    mState->parts = partColorsOf(mScene);
    mState->colorParts(mScene);
}

void TerrainRenderer::ringsMayBeLate(bool may) {
    if (mState->rings) mState->rings->mayBeLate(may);
}

std::uint64_t TerrainRenderer::arrivals() const {
    return mState->rings ? mState->rings->arrivals() : 0;
}

TerrainRenderer::Detail TerrainRenderer::ringDetail() const {
    if (!rings()) return {};
    return {mState->rings->share(), mState->rings->late()};
}

const GroundRings* TerrainRenderer::rings() const {
    return mState->rings && mState->rings->any() ? &mState->rings->rings() : nullptr;
}

void TerrainRenderer::lookFrom(const EyeView& left, const EyeView& right) const {
    if (!mState->rings) return;
    mState->rings->lookFrom(left, right);
    mState->ringsChanged();
}

int TerrainRenderer::tileCount(const EyeView& view) const {
    return bandCount(mState->viewOf(view, mScene.ground));
}

void TerrainRenderer::renderTile(const EyeView& view, int tile, EyeImage& image) const {
    const CasterView caster = mState->viewOf(view, mScene.ground);
    const CasterBand band = bandOf(caster, tile);
    thread_local std::vector<float> scratch;
    scratch.resize(8 * (static_cast<std::size_t>(caster.lanes) + 128));
    const CasterScene& scene = mState->shown(keepsBase(image));
    mState->kernels->castBand(scene, caster, band, targetOf(image), scratch.data());
    if (mScene.landmarks || viewDependent()) finish(view, pixelsOf(caster, band), image);
}

void TerrainRenderer::finish(const EyeView& view, std::span<const PixelIndex> pixels, EyeImage& image) const {
    std::vector<bool> onLandmark(pixels.size(), false);
    if (mScene.landmarks) castLandmarks(view, pixels, image, onLandmark);
    if (!keepsBase(image)) return;
    for (std::size_t k = 0; k < pixels.size(); ++k) {
        const PixelIndex p = pixels[k];
        const float depth = image.viewDepth.at(p.x, p.y);
        image.baseColor.at(p.x, p.y) = image.color.at(p.x, p.y);
        const glm::dvec3 point = view.pointAt(p.x + 0.5, p.y + 0.5, std::isfinite(depth) ? depth : 0.0);
        // Landmarks are matt: a normal turned from the sun has no highlight.
        const glm::dvec3 normal = onLandmark[k] ? -mState->specular.toSun()
                                                : mState->groundAt(point, mScene.ground).normalAt(point);
        image.normal.at(p.x, p.y) = packNormal(normal);
        shadeAgain(view, p.y, p.x, p.x + 1, image);
    }
}

void TerrainRenderer::castLandmarks(const EyeView& view, std::span<const PixelIndex> pixels, EyeImage& image,
                                    std::vector<bool>& hit) const {
    constexpr int kChunk = 256;
    glm::dvec3 direction[kChunk];
    float depth[kChunk];
    PackedColor color[kChunk];
    for (std::size_t first = 0; first < pixels.size(); first += kChunk) {
        const int count = static_cast<int>(std::min<std::size_t>(kChunk, pixels.size() - first));
        for (int k = 0; k < count; ++k) {
            const PixelIndex p = pixels[first + k];
            direction[k] = view.rayDirection(p.x + 0.5, p.y + 0.5);
            depth[k] = image.viewDepth.at(p.x, p.y);
            color[k] = image.color.at(p.x, p.y);
        }
        mScene.landmarks->cast(view, count, direction, depth, color, !keepsBase(image));
        for (int k = 0; k < count; ++k) {
            const PixelIndex p = pixels[first + k];
            hit[first + k] = depth[k] < image.viewDepth.at(p.x, p.y);
            image.viewDepth.at(p.x, p.y) = depth[k];
            image.color.at(p.x, p.y) = color[k];
        }
    }
}

void TerrainRenderer::shadeAgain(const EyeView& view, int y, int x0, int x1, EyeImage& image) const {
    for (int x = x0; x < x1; ++x) {
        const double depth = image.viewDepth.at(x, y);
        const PackedColor base = image.baseColor.at(x, y);
        image.color.at(x, y) = base;
        if (!std::isfinite(depth)) continue;
        const glm::dvec3 ray = view.rayDirection(x + 0.5, y + 0.5);
        const double length = glm::length(ray);
        glm::vec3 highlight = mState->specular.highlight(unpackNormal(image.normal.at(x, y)), -ray / length);
        if (glm::all(glm::lessThan(highlight, glm::vec3(kUnseen)))) {
            if (!mState->fog.any()) continue;
            highlight = glm::vec3(0.0f);
        } else {
            highlight *= sunShownAt(view.eye + depth * ray);
        }
        image.color.at(x, y) = packColor(mState->fog.seen(
            unpackColor(base) + highlight, view.eye, view.bend().wayToPlace(view.eye, ray, depth), depth));
    }
}

float TerrainRenderer::sunShownAt(const glm::dvec3& place) const {
    if (!mState->light) return 1;
    return mState->light->sunShownAt(mScene.ground.gridFromWorld(glm::dvec2(place)));
}

void TerrainRenderer::shadeRows(const EyeView& view, int y0, int y1, EyeImage& image) const {
    const CasterView caster = mState->viewOver(view, mScene.ground);
    for (int y = y0; y < y1; ++y) mState->kernels->shadeRow(mState->scene, caster, y, targetOf(image));
}

ViewDependence TerrainRenderer::viewDependence() const {
    return mState->specular.active() ? ViewDependence::Highlight : ViewDependence::None;
}
// A way that is shorter by a separation of that share of the fog's distance lets 0.2 % more light arrive: at
// most one step of a packed channel, where the fog is black and what is seen white.
bool TerrainRenderer::airDiffers(double separation) const {
    constexpr double kUnseenShare = 1.0 / 500;
    return static_cast<double>(mState->scene.fog.perMetre) * separation > kUnseenShare;
}

void TerrainRenderer::changeAir(const EyeView& from, const EyeView& view, int y, EyeImage& image) const {
    const FogData& fog = mState->scene.fog;
    FogRow row;
    row.color = image.color.row(y);
    row.depth = image.viewDepth.row(y);
    row.width = image.width();
    row.firstX = static_cast<float>(view.xMin + 0.5 * view.pixelWidth());
    row.perX = static_cast<float>(view.pixelWidth());
    row.y = static_cast<float>(view.yMax - (y + 0.5) * view.pixelHeight());
    const glm::dvec3 offset = view.eye - from.eye;
    row.offset[0] = static_cast<float>(glm::dot(offset, view.right));
    row.offset[1] = static_cast<float>(glm::dot(offset, view.up));
    row.offset[2] = static_cast<float>(glm::dot(offset, view.forward));
    row.perMetre = fog.perMetre;
    std::copy_n(fog.linear, 3, row.linear);
    mState->changeFog(row);
}
void TerrainRenderer::sunMoved() {
    mState->specular = specularOf(mScene, mState->light);
    mState->sunMoved(mScene.look);
    if (mState->light && mState->parts) mState->colorParts(mScene);
    mState->ringsChanged();
}

void TerrainRenderer::showColors(const ColorTexture& lit, const TerrainIllumination* light,
                                 PartColors parts) {
    mState->parts = std::move(parts);
    mState->light = light;
    if (!light || !mState->parts) mState->colorParts(mScene);  // else as the sun moves, below
    mState->scene.texture = mState->clear.texture = textureData(lit, mScene.ground.spacing(), mState->filter);
    sunMoved();
}

const Fog& TerrainRenderer::fog() const {
    return mState->fog;
}

SimdTarget TerrainRenderer::target() const {
    return mState->target;
}

void TerrainRenderer::renderPixels(const EyeView& view, PixelRect bounds, std::span<const PixelIndex> pixels,
                                   EyeImage& image) const {
    const CasterView caster = mState->viewOf(view, mScene.ground);
    thread_local HoleSort holes;
    holes.sort(caster, bounds, pixels);
    const CasterTarget target = targetOf(image);
    const CasterScene& scene = mState->shown(keepsBase(image));
    thread_local std::vector<float> scratch;
    scratch.resize(8 * (static_cast<std::size_t>(caster.lanes) + 128));
    for (const CasterBand& band : holes.dense()) {
        mState->kernels->castBand(scene, caster, band, target, scratch.data());
        if (mScene.landmarks || viewDependent()) finish(view, pixelsOf(caster, band), image);
    }
    castSparse(
        view, caster, holes.sparse(),
        [&](PixelIndex p) {
            return startInFront(caster, mState->shown(false).ground, bounds, image.viewDepth, p);
        },
        image);
}

// startOf is asked in turn, a chunk of rays ahead of those that are cast.
void TerrainRenderer::castSparse(const EyeView& view, const CasterView& caster,
                                 std::span<const PixelIndex> pixels,
                                 const std::function<float(PixelIndex)>& startOf, EyeImage& image) const {
    const CasterTarget target = targetOf(image);
    const CasterScene& scene = mState->shown(keepsBase(image));
    // Long enough to keep all lanes busy, short enough for later pixels to start from earlier ones.
    constexpr std::size_t kChunk = 128;
    CasterPixel chunk[kChunk];
    float start[kChunk];
    for (std::size_t first = 0; first < pixels.size(); first += kChunk) {
        const int count = static_cast<int>(std::min(kChunk, pixels.size() - first));
        for (int k = 0; k < count; ++k) {
            const PixelIndex p = pixels[first + k];
            chunk[k] = {p.x, p.y};
            start[k] = startOf(p);
        }
        mState->kernels->castPixels(scene, caster, {chunk, start, count}, target);
    }
    if (mScene.landmarks || viewDependent()) finish(view, pixels, image);
}

void TerrainRenderer::renderMoreRays(const EyeView& view, const EyeView& known, const Plane<float>& depths,
                                     PixelRect, std::span<const PixelIndex> pixels, EyeImage& image) const {
    const CasterView caster = mState->viewOf(view, mScene.ground),
                     cast = mState->viewOf(known, mScene.ground);
    const StartBeside starts(caster, cast, mState->shown(false).ground, depths);
    castSparse(
        view, caster, pixels, [&](PixelIndex p) { return starts.of(p); }, image);
}

namespace {

struct Box {
    glm::dvec3 low, high;
};

// The box of the rectangle's corners at unit view depth, from the eye.
Box cornerBox(const EyeView& view, PixelRect rect) {
    Box box{glm::dvec3(HUGE_VAL), glm::dvec3(-HUGE_VAL)};
    for (const double x : {double(rect.x0), double(rect.x1)})
        for (const double y : {double(rect.y0), double(rect.y1)}) {
            const glm::dvec3 direction = view.rayDirection(x, y);
            box.low = glm::min(box.low, direction);
            box.high = glm::max(box.high, direction);
        }
    return box;
}

// Bounds of the part of a frustum between two depths.
Box frustumBox(const glm::dvec3& eye, const Box& corners, double from, double to) {
    return {eye + glm::min(from * corners.low, to * corners.low),
            eye + glm::max(from * corners.high, to * corners.high)};
}

// Returns whether any ground below the box's footprint reaches up to its lower side.
bool reachesGround(const Heightfield& ground, const HeightPyramid& pyramid, const Box& box) {
    if (box.low.z > ground.maxHeight()) return false;
    const glm::dvec2 low = ground.gridFromWorld(glm::dvec2(box.low)),
                     high = ground.gridFromWorld(glm::dvec2(box.high));
    const int lastI = ground.width() - 2, lastJ = ground.height() - 2;
    if (high.x < 0 || high.y < 0 || low.x > lastI + 1 || low.y > lastJ + 1) return false;
    const auto cell = [](double g, int last) {
        return std::min(static_cast<int>(std::clamp(g, 0.0, 1e9)), last);
    };
    const int i0 = cell(low.x, lastI), i1 = cell(high.x, lastI), j0 = cell(low.y, lastJ),
              j1 = cell(high.y, lastJ);
    int level = 0;
    while (level + 1 < pyramid.levelCount() &&
           std::max((i1 >> level) - (i0 >> level), (j1 >> level) - (j0 >> level)) > 3)
        ++level;
    for (int j = j0 >> level; j <= j1 >> level; ++j)
        for (int i = i0 >> level; i <= i1 >> level; ++i)
            if (pyramid.at(level, i, j) >= box.low.z) return true;
    return false;
}

}  // namespace

bool TerrainRenderer::mayHitBeyondEdge(const EyeView& view, PixelRect rect, double column,
                                       double parallaxScale) const {
    double freeDepth = 0;
    return mayHitBeyondEdgeFrom(view, rect, column, parallaxScale, freeDepth);
}

bool TerrainRenderer::mayHitBeyondEdgeFrom(const EyeView& view, PixelRect rect, double column,
                                           double parallaxScale, double& freeDepth) const {
    if (rect.x1 >= column) return true;
    const double end = parallaxScale / (column - rect.x1);
    // Both the rings that are cast and the ground tested here may differ from the real ground by their error
    // bounds. Over a round Earth the ground appears even lower.
    double coarser = rings() ? rings()->errorBound : 0;
    if (mScene.tiled) coarser += mScene.tiled->levels->errorBound(mScene.tiled->level);
    const Box corners = cornerBox(view, rect);
    double& from = freeDepth;
    from = std::max(from, view.nearDepth);
    while (from < end) {
        const double to = std::min(end, from * 2);
        Box box = frustumBox(view.eye, corners, from, to);
        box.low.z -= coarser;
        if (reachesGround(mScene.ground, mState->pyramid, box)) return true;
        if (mScene.landmarks) {
            const glm::dvec3 low = mScene.landmarks->boundsMin(), high = mScene.landmarks->boundsMax();
            if (glm::all(glm::lessThanEqual(low, box.high)) && glm::all(glm::lessThanEqual(box.low, high)))
                return true;
        }
        from = to;
    }
    return false;
}

}  // namespace stereonav
