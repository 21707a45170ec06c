// See the header; equations by their numbers in docs/volume_light.md. Shares nothing with the fast code but
// the geometry and the medium.
#include "tests/oracle/plain_sweep.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

#include "engine/base/parallel.h"
#include "engine/volume/baked_data.h"
#include "tests/oracle/sweep_formulas.h"

namespace stereonav {
namespace {

constexpr double kLeastLeft = 1.0 / 1024;

// The light's buffer, V8. Outside it light is as it set out: 1, or of scattered light beside a lamp's cone 0.
struct LightBuffer {
    int width = 0, height = 0;
    std::vector<double> direct;
    std::vector<glm::dvec3> indirect, before;  // before: while a slab is passed, what entered it

    std::vector<glm::dvec3> depths;  // tau_i at the texels of the slab; empty where V11 does not count

    std::vector<float> scattered;  // light as it set out, with a ring; empty: 1

    void start(int w, int h, std::vector<float> setsOut) {
        width = w;
        height = h;
        scattered = std::move(setsOut);
        direct.assign(static_cast<std::size_t>(w) * h, 1.0);
        for (int y = 0; y < h; ++y)
            for (int x = 0; x < w; ++x) indirect.push_back(atStart(indirect, x, y));
    }
    double atStart(const std::vector<double>&, int, int) const { return 1.0; }
    glm::dvec3 atStart(const std::vector<glm::dvec3>&, int x, int y) const {
        if (scattered.empty()) return glm::dvec3(1.0);
        const int column = std::clamp(x, -1, width) + 1, row = std::clamp(y, -1, height) + 1;
        return glm::dvec3(scattered[static_cast<std::size_t>(row) * (width + 2) + column]);
    }
    std::size_t index(int x, int y) const { return static_cast<std::size_t>(y) * width + x; }

    template <typename T>
    T texel(const std::vector<T>& plane, int x, int y) const {
        return x >= 0 && y >= 0 && x < width && y < height ? plane[index(x, y)] : atStart(plane, x, y);
    }
    // Returns a bilinear value at continuous coordinates.
    template <typename T>
    T read(const std::vector<T>& plane, double x, double y) const {
        x = std::clamp(x, -0.5, width + 0.5);
        y = std::clamp(y, -0.5, height + 0.5);
        const double left = std::floor(x - 0.5), top = std::floor(y - 0.5);
        const double fx = x - 0.5 - left, fy = y - 0.5 - top;
        const int i = static_cast<int>(left), j = static_cast<int>(top);
        return (texel(plane, i, j) * (1 - fx) + texel(plane, i + 1, j) * fx) * (1 - fy) +
               (texel(plane, i, j + 1) * (1 - fx) + texel(plane, i + 1, j + 1) * fx) * fy;
    }
    // V11: a tap that reads its ray later by a length has lost more of its light on the way. u, v:
    // continuous.
    glm::dvec3 leveled(const glm::dvec3& light, double u, double v, double later) const {
        const int x = static_cast<int>(std::floor(std::clamp(u, -1.0, static_cast<double>(width)))),
                  y = static_cast<int>(std::floor(std::clamp(v, -1.0, static_cast<double>(height))));
        if (depths.empty() || x < 0 || y < 0 || x >= width || y >= height) return light;
        return light * (1.0 + glm::clamp(depths[index(x, y)] * later, -1.0, 1.0));
    }
    glm::dvec3 blurred(int x, int y, int slab, const BlurTaps& taps, const glm::dvec2& lags) const {
        const double u = x + 0.5, v = y + 0.5;
        const auto later = [&](double right, double down) { return right * lags.x + down * lags.y; };
        glm::dvec3 sum(0.0);
        if (taps.radius > 1) {
            const double turn = tapTurn(x, y, slab);
            const double c = taps.radius * std::cos(turn), s = taps.radius * std::sin(turn);
            const auto tap = [&](double right, double down) {
                return leveled(read(before, u + right, v + down), u + right, v + down, later(right, down));
            };
            sum = tap(c, s) + tap(-s, c) + tap(-c, -s) + tap(s, -c);
        } else {
            const auto tap = [&](int right, int down) {
                return leveled(texel(before, x + right, y + down), u + right, v + down, later(right, down));
            };
            sum = tap(-1, 0) + tap(1, 0) + tap(0, -1) + tap(0, 1);
        }
        return glm::min((1 - taps.share) * before[index(x, y)] + 0.25 * taps.share * sum, 1.0);
    }
};

struct EyePixel {
    glm::dvec3 light{0.0};
    double through = 1;
    double depth = kMissDepth;
};

// The light at a place: its way, and what reaches it when nothing is between.
struct Arriving {
    bool lit = false;     // past the light
    bool inCone = false;  // whether it is in a lamp's cone
    glm::dvec3 way{0.0};
    double share = 1;   // by the falloff
    double cosine = 1;  // cosine of the way with the axis
};

class Sweep {
public:
    Sweep(const Medium& medium, const MediumLook& look, const SweepSetting& setting,
          const SweepGeometry& geometry, double time)
        : mMedium(medium), mLook(look), mGeometry(geometry), mTime(time) {
        mBlur = blurOf(medium, setting);
        mUsesLight = look.model == MediumModel::Direct || look.model == MediumModel::Indirect;
        if (mUsesLight)
            mBuffer.start(geometry.light.width, geometry.light.height, scatteredAtStart(geometry));
        for (const RayFan& eye : geometry.eyes)
            mEyes.emplace_back(static_cast<std::size_t>(eye.width) * eye.height);
    }

    std::vector<MediumPicture> run() {
        for (int slab = 0; slab < mGeometry.slabs(); ++slab) {
            for (std::size_t eye = 0; eye < mEyes.size(); ++eye) seeSlab(eye, slab);
            if (mUsesLight && middleOf(slab) > mGeometry.lightStart) lightSlab(slab);
        }
        std::vector<MediumPicture> pictures;
        for (std::size_t eye = 0; eye < mEyes.size(); ++eye) pictures.push_back(pictureOf(eye));
        return pictures;
    }

private:
    double middleOf(int slab) const { return 0.5 * (mGeometry.faces[slab] + mGeometry.faces[slab + 1]); }
    double thicknessOf(int slab) const { return mGeometry.faces[slab + 1] - mGeometry.faces[slab]; }

    // Where a ray crosses the middle of a slab. cosine: to the axis, positive; 0: it does not.
    struct Crossing {
        glm::dvec3 place{0.0}, way{0.0};
        double cosine = 0;
    };
    Crossing crossingOf(const RayFan& fan, double x, double y, int slab, bool forward) const {
        const glm::dvec3 start = fan.start(x, y), way = fan.direction(x, y);
        const double along = glm::dot(way, mGeometry.axis), cosine = forward ? along : -along;
        if (!(cosine > kLeastCosine)) return {};
        const double s = (middleOf(slab) - glm::dot(start, mGeometry.axis)) / along;
        if (!fan.parallel && !(s > 0)) return {};
        return {start + s * way, way, cosine};
    }
    OpticalProperties propertiesAt(const glm::dvec3& place, const RayFan& fan) const {
        return mMedium.at(mGeometry.anchor + place, mTime, fan.pixelSize(place));
    }

    void seeSlab(std::size_t eye, int slab) {
        const RayFan& fan = mGeometry.eyes[eye];
        parallelFor(fan.height, [&](int y) {
            for (int x = 0; x < fan.width; ++x) {
                EyePixel& pixel = mEyes[eye][static_cast<std::size_t>(y) * fan.width + x];
                if (mGeometry.forward && pixel.through < kLeastLeft) continue;
                const Crossing at = crossingOf(fan, x + 0.5, y + 0.5, slab, mGeometry.forward);
                if (at.cosine > 0) addSample(pixel, fan, at, slab);
            }
        });
    }

    // V7
    void addSample(EyePixel& pixel, const RayFan& fan, const Crossing& at, int slab) const {
        const OpticalProperties medium = propertiesAt(at.place, fan);
        if (!(medium.extinction > 0)) return;
        const double x = medium.extinction * thicknessOf(slab) / at.cosine, passes = std::exp(-x);
        const glm::dvec3 sent =
            scattered(medium, at, slab, x) + glm::dvec3(medium.glow) * slabShare(x, 0, true);
        const double depth = fan.depthOf(at.place);
        if (mGeometry.forward) {
            pixel.light += pixel.through * sent;
            pixel.depth = std::min(pixel.depth, depth);
        } else {
            pixel.light = sent + passes * pixel.light;
            pixel.depth = depth;
        }
        pixel.through *= passes;
    }

    glm::dvec3 scattered(const OpticalProperties& medium, const Crossing& at, int slab, double x) const {
        const glm::dvec3 color(medium.color);
        if (mLook.model == MediumModel::Emission) return color * slabShare(x, 0, true);
        const Arriving light = arrivingAt(at.place, slab);
        if (!light.lit || (mLook.model != MediumModel::Indirect && !light.inCone)) return glm::dvec3(0.0);
        const glm::dvec3 radiance = light.share * glm::dvec3(mGeometry.radiance);
        const glm::dvec3 c = color * surfaceFactor(medium, at, light);  // C of V3
        if (mLook.model == MediumModel::Surface) return c * radiance * slabShare(x, 0, true);
        return c * radiance * reaching(medium, at, light, slab, x);
    }

    // D V(x, y) P + q I V(x, y_i): V4 with the slab's own shares.
    glm::dvec3 reaching(const OpticalProperties& medium, const Crossing& at, const Arriving& light, int slab,
                        double x) const {
        const glm::dvec2 texel = mGeometry.light.project(at.place);
        const double way = thicknessOf(slab) / light.cosine;
        const double direct = light.inCone ? mBuffer.read(mBuffer.direct, texel.x, texel.y) : 0.0;
        const glm::dvec3 phase(mLook.phase.at(static_cast<float>(-glm::dot(light.way, at.way))));
        glm::dvec3 sum = direct * slabShare(x, medium.extinction * way, mGeometry.forward) * phase;
        if (mLook.model != MediumModel::Indirect) return sum;
        const glm::dvec3 indirect = mBuffer.read(mBuffer.indirect, texel.x, texel.y);
        for (int k = 0; k < 3; ++k)
            sum[k] += static_cast<double>(mLook.indirectShare) * indirect[k] *
                      slabShare(x, medium.indirectExtinction[k] * way, mGeometry.forward);
        return sum;
    }

    Arriving arrivingAt(const glm::dvec3& place, int slab) const {
        const RayFan& fan = mGeometry.light;
        Arriving light;
        light.way = fan.forward;
        light.lit = light.inCone = true;
        if (!fan.parallel) {
            const double distance = glm::length(place - fan.origin);
            if (!(distance > 0)) return {};
            light.way = (place - fan.origin) / distance;
            const double ahead = glm::dot(light.way, fan.forward);
            light.lit = middleOf(slab) > mGeometry.lightStart && ahead > 0;
            light.inCone = ahead >= mGeometry.lampCosine;
            if (mGeometry.falloff > 0) light.share = 1 / (1 + std::pow(distance / mGeometry.falloff, 2));
        }
        light.cosine = glm::dot(light.way, mGeometry.axis);
        light.lit = light.lit && light.cosine > kLeastCosine;
        return light;
    }

    // (1 - S) + f_s S of V3.
    glm::dvec3 surfaceFactor(const OpticalProperties& medium, const Crossing& at,
                             const Arriving& light) const {
        const double s = medium.surface;
        if (!(s > 0)) return glm::dvec3(1.0);
        return glm::dvec3(1 - s) + s * surfaceLight(at, light);
    }
    glm::dvec3 surfaceLight(const Crossing& at, const Arriving& light) const {
        const glm::dvec3 world = mGeometry.anchor + at.place;
        const glm::dvec3 shaded(blinnPhong(world, at, light));
        const BakedLook& baked = mLook.baked;
        if (!baked.light) return shaded;
        const IlluminationVolume::Light known = bakedLightAt(baked, world);
        if (!(known.weight > 0)) return shaded;
        if (baked.use == BakedLook::Use::Openness) return shaded * static_cast<double>(known.value.x);
        return glm::dvec3(known.value) * static_cast<double>(shownExposure(baked)) +
               static_cast<double>(baked.lampShare) * shaded;
    }
    // The highlight is the same on both sides, since which of them the gradient points to depends on the
    // data: the highlight is seen where eye and light are on the same side.
    double blinnPhong(const glm::dvec3& world, const Crossing& at, const Arriving& light) const {
        const glm::dvec3 gradient = mMedium.gradientAt(world, mTime);
        const double length = glm::length(gradient);
        if (!(length > 0)) return 0;
        const glm::dvec3 normal = gradient / length;
        const double toLight = -glm::dot(normal, light.way), toEye = -glm::dot(normal, at.way);
        double sum = mLook.ambient + mLook.diffuse * std::abs(toLight);
        const glm::dvec3 half = -light.way - at.way;
        const double halfLength = glm::length(half);
        if (toLight * toEye > 0 && halfLength > 0)
            sum += mLook.specular * std::pow(std::abs(glm::dot(normal, half)) / halfLength,
                                             static_cast<double>(mLook.shininess));
        return sum;
    }

    // V8, with the offset of V9 in texels.
    void lightSlab(int slab) {
        const RayFan& fan = mGeometry.light;
        mBuffer.before = mBuffer.indirect;
        if (mLook.model == MediumModel::Indirect && mGeometry.leaning > 0) findDepths(slab);
        parallelFor(fan.height, [&](int y) {
            for (int x = 0; x < fan.width; ++x) {
                const Crossing at = crossingOf(fan, x + 0.5, y + 0.5, slab, true);
                if (at.cosine > 0) passTexel(x, y, at, slab);
            }
        });
    }
    void findDepths(int slab) {
        const RayFan& fan = mGeometry.light;
        mBuffer.depths.assign(mBuffer.indirect.size(), glm::dvec3(0.0));
        parallelFor(fan.height, [&](int y) {
            for (int x = 0; x < fan.width; ++x)
                if (const Crossing at = crossingOf(fan, x + 0.5, y + 0.5, slab, true); at.cosine > 0)
                    mBuffer.depths[mBuffer.index(x, y)] =
                        glm::dvec3(propertiesAt(at.place, fan).indirectExtinction);
        });
    }
    void passTexel(int x, int y, const Crossing& at, int slab) {
        const OpticalProperties medium = propertiesAt(at.place, mGeometry.light);
        const double way = thicknessOf(slab) / at.cosine;
        const std::size_t index = mBuffer.index(x, y);
        mBuffer.direct[index] *= std::exp(-medium.extinction * way);
        if (mLook.model != MediumModel::Indirect) return;
        const double offset = std::sqrt(way) * mBlur / mGeometry.light.pixelSize(at.place);
        const glm::dvec2 lags =
            mBuffer.depths.empty() ? glm::dvec2(0.0) : tapLags(mGeometry, x + 0.5, y + 0.5, middleOf(slab));
        mBuffer.indirect[index] = mBuffer.blurred(x, y, slab, blurTaps(offset), lags) *
                                  glm::exp(-glm::dvec3(medium.indirectExtinction) * way);
    }

    MediumPicture pictureOf(std::size_t eye) const {
        const RayFan& fan = mGeometry.eyes[eye];
        MediumPicture picture;
        picture.light.resize(fan.width, fan.height);
        picture.viewDepth.resize(fan.width, fan.height);
        for (int y = 0; y < fan.height; ++y)
            for (int x = 0; x < fan.width; ++x) {
                const EyePixel& pixel = mEyes[eye][static_cast<std::size_t>(y) * fan.width + x];
                picture.light.at(x, y) = glm::vec4(glm::dvec4(pixel.light, pixel.through));
                picture.viewDepth.at(x, y) = static_cast<float>(pixel.depth);
            }
        return picture;
    }

    const Medium& mMedium;
    const MediumLook& mLook;
    const SweepGeometry& mGeometry;
    double mTime;
    double mBlur = 0;  // sqrt(blurLength) tan(theta / 2)
    bool mUsesLight = false;
    LightBuffer mBuffer;
    std::vector<std::vector<EyePixel>> mEyes;
};

}  // namespace

std::vector<MediumPicture> plainSweep(const Medium& medium, const MediumLook& look,
                                      const SweepSetting& setting, const SweepGeometry& geometry,
                                      double time) {
    return Sweep(medium, look, setting, geometry, time).run();
}

}  // namespace stereonav
