#include "terrain/light/atmosphere.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

#include "engine/base/parallel.h"
#include "engine/math/constants.h"
#include "engine/math/luminance.h"
#include "terrain/light/air_numbers.h"
#include "terrain/light/sun_and_sky.h"

namespace stereonav {
namespace {

constexpr double kScaleHeight[2] = {8000, 1200};  // molecules, haze
constexpr double kRed = 13.5e-6 / kGreenOfRed;    // molecules' extinction at the sea, per metre
constexpr double kHazeAlbedo = 0.9, kForward = 0.76;
constexpr double kContrastLeft = 3.912;  // -ln 0.02
constexpr double kLeastVisibility = 10;  // metres
constexpr double kGlobeRadius = 6371e3;
constexpr double kSpace = 80e3;  // metres up: air above it is left out of the sky
constexpr double kSunOfWhite = 45 * kPi / 180;
constexpr double kLeastLevelLight = 0.02;       // below it the exposure no longer follows
constexpr double kBrighter = 1.5;               // factor on the exposure: in pictures of ground white is rare
constexpr double kNightSky = 0.002;             // share of level light that never goes
constexpr double kScatteredAgain = 0.25;        // share of the light that was scattered once, at least
constexpr glm::vec3 kPlain{0.2f, 0.2f, 0.17f};  // albedo of the plain below the horizon
constexpr int kHeights = 96, kElevations = 512;
const glm::dvec3 kPowers(1, kGreenOfRed, kBlueOfRed);

// Densities by height. Below the sea they grow no further than single precision holds.
glm::dvec2 densityAt(double height) {
    return {airExp(AirNumber(height / kScaleHeight[0])).v, airExp(AirNumber(height / kScaleHeight[1])).v};
}

// Height above the sea of a point `way` along a ray that starts at a height with a sine of its elevation. By
// the difference of squares: heights are small beside the Earth.
double heightAlong(double height, double sine, double way) {
    const double r = kGlobeRadius + height;
    const double square = way * (way + 2 * r * sine);
    return height + square / (r + std::sqrt(std::max(0.0, r * r + square)));
}
// How far a ray goes until it is at a height; negative: it never is. From below upwards the far meeting, and
// the near one from above.
double wayTo(double height, double sine, double target) {
    const double r = kGlobeRadius + height;
    const double c = (height - target) * (2 * kGlobeRadius + height + target), b = r * sine;
    const double discriminant = b * b - c;
    if (discriminant < 0) return -1;
    const double root = std::sqrt(discriminant);
    if (c <= 0) return b > 0 ? -c / (b + root) : root - b;
    return b < 0 ? c / (root - b) : -1;
}

double phaseOfMolecules(double cosine) {
    return 3 / (16 * kPi) * (1 + cosine * cosine);
}
double phaseOfHaze(double cosine) {
    const double g = kForward;
    return 3 / (8 * kPi) * (1 - g * g) * (1 + cosine * cosine) /
           ((2 + g * g) * std::pow(1 + g * g - 2 * g * cosine, 1.5));
}

// Returns the share of sunlight on a level surface that arrives below a layer that absorbs nothing:
// two-stream (Eddington's), of a depth that is scaled by what is not scattered forward.
glm::dvec3 twoStream(const glm::dvec3& scaledDepth, double sine) {
    const double up = std::max(sine, 0.0);
    return ((1 + 1.5 * up) + (1 - 1.5 * up) * glm::exp(-scaledDepth / std::max(up, 0.02))) /
           (2.0 + 1.5 * scaledDepth);
}

}  // namespace

// Share of the sun's light, by colour, that comes down to a height: the disc's middle, over the round Earth.
void Atmosphere::makeSunlight(double elevation) {
    mThroughToSun.assign(kHeights, glm::dvec3(0.0));
    const double sine = std::sin(elevation);
    parallelFor(kHeights, [&](int k) {
        const double height = kSpace * std::pow(k / (kHeights - 1.0), 2.0);
        const double dip = std::acos(kGlobeRadius / (kGlobeRadius + height));
        const double share = sunUp(std::sin(std::clamp(elevation + dip, -kPi / 2, kPi / 2)));
        if (share <= 0) return;
        constexpr int kSteps = 200;
        // The lowest point of a ray that comes from below the level lies behind it.
        const double end = wayTo(height, std::max(sine, -std::sin(dip)), kSpace);
        const double start = std::max(sine, -std::sin(dip));
        glm::dvec2 depth(0.0);
        for (int n = 0; n < kSteps; ++n) {
            const double a = end * std::pow(n / double(kSteps), 2.0),
                         b = end * std::pow((n + 1) / double(kSteps), 2.0);
            depth += (b - a) * densityAt(std::max(0.0, heightAlong(height, start, 0.5 * (a + b))));
        }
        const glm::dvec3 tau = double(mAir.molecules) * depth.x * kPowers + double(mAir.haze) * depth.y;
        mThroughToSun[k] = share * glm::exp(-tau);
        if (k == 0) {
            mAir.sunDepth[0] = static_cast<float>(mAir.molecules * depth.x);
            mAir.sunDepth[1] = static_cast<float>(mAir.haze * depth.y);
        }
    });
}

double Atmosphere::sunlightAt(double height, int channel) const {
    const double place = std::sqrt(std::clamp(height / kSpace, 0.0, 1.0)) * (kHeights - 1);
    const int k = std::min(static_cast<int>(place), kHeights - 2);
    return glm::mix(mThroughToSun[k][channel], mThroughToSun[k + 1][channel], place - k);
}

// Elevations are closer together near the horizon: sine = +-(k / half)^3.
void Atmosphere::makeElevations() {
    mElevations.resize(kElevations + 1);
    parallelFor(kElevations + 1, [&](int k) {
        const double u = 2.0 * k / kElevations - 1, sine = u * u * u;
        const double down = wayTo(mSeenFrom, sine, 0);
        const bool toGround = sine < 0 && mSeenFrom > 0 && down >= 0;
        const bool atSea = sine < 0 && mSeenFrom <= 0;
        double from = 0, end = atSea ? 0 : toGround ? down : wayTo(mSeenFrom, sine, kSpace);
        if (mSeenFrom > kSpace) from = std::max(wayTo(mSeenFrom, sine, kSpace), 0.0);
        if (mSeenFrom > kSpace && !toGround)
            end = from > 0 ? -2 * (kGlobeRadius + mSeenFrom) * sine - from : from;
        constexpr int kSteps = 160;
        glm::dvec3 tau(0.0), molecules(0.0), haze(0.0), ambient(0.0);
        for (int n = 0; n < kSteps; ++n) {
            const double a = from + (end - from) * std::pow(n / double(kSteps), 2.0),
                         b = from + (end - from) * std::pow((n + 1) / double(kSteps), 2.0);
            const double height = heightAlong(mSeenFrom, sine, 0.5 * (a + b));
            const glm::dvec2 density = densityAt(height);
            const glm::dvec3 own = double(mAir.molecules) * density.x * kPowers;
            const double grey = mAir.haze * density.y;
            const glm::dvec3 step = (b - a) * (own + grey);
            // Share of the step's light that is seen, by unit of depth.
            const glm::dvec3 seen = glm::exp(-tau) * (1.0 - glm::exp(-step)) / glm::max(own + grey, 1e-30);
            for (int c = 0; c < 3; ++c) {
                const double sun = mSunlight[c] * sunlightAt(height, c) * seen[c];
                molecules[c] += sun * own[c];
                haze[c] += sun * grey * kHazeAlbedo;
            }
            ambient += seen * (own + grey * kHazeAlbedo);
            tau += step;
        }
        const bool plain = toGround || atSea;
        mElevations[k] = {glm::vec3(molecules), glm::vec3(haze), glm::vec3(ambient),
                          plain ? glm::vec3(glm::exp(-tau)) : glm::vec3(0.0f)};
    });
}

Atmosphere::Elevation Atmosphere::elevation(double sine) const {
    const double place =
        std::clamp(0.5 * (std::cbrt(sine) + 1) * kElevations, 0.0, static_cast<double>(kElevations));
    const int k = std::min(static_cast<int>(place), kElevations - 1);
    const auto u = static_cast<float>(place - k);
    const Elevation &a = mElevations[k], &b = mElevations[k + 1];
    return {glm::mix(a.molecules, b.molecules, u), glm::mix(a.haze, b.haze, u),
            glm::mix(a.ambient, b.ambient, u), glm::mix(a.ground, b.ground, u)};
}

Atmosphere::Atmosphere(const TerrainLook& look)
    : mSeenFrom(std::max(look.skySeenFrom - look.seaLevel, 1.0)),
      mHazyBelow(look.hazyBelow),
      mToSun(directionToSun(look.sunAzimuth, look.sunElevation)) {
    mAir.any = true;
    mAir.seaLevel = static_cast<float>(look.seaLevel);
    const double green = kContrastLeft / std::max(look.visibility, kLeastVisibility);
    mAir.molecules = static_cast<float>(kRed);
    mAir.haze = static_cast<float>(std::max(0.0, green - kRed * kGreenOfRed));
    mAir.hazeScatters = kHazeAlbedo;
    for (int k = 0; k < 2; ++k) mAir.perHeight[k] = static_cast<float>(1 / kScaleHeight[k]);
    const glm::dvec3 depth =
        mAir.molecules * kScaleHeight[0] * kPowers + mAir.haze * kScaleHeight[1] * (1 - kForward);

    // White on level ground at the reference, and as bright until the sun is low.
    const glm::dvec3 above = 1.0 / (std::sin(kSunOfWhite) * twoStream(depth, std::sin(kSunOfWhite)));
    const double sine = std::sin(look.sunElevation);
    const glm::dvec3 total = above * std::max(sine, 0.0) * twoStream(depth, sine);
    makeSunlight(look.sunElevation);
    mSunUp = sunUp(sine);
    mSunlight = above;
    makeElevations();
    glm::dvec3 once(0.0);  // from the sky on level ground
    constexpr int kRings = 24, kAround = 48;
    for (int r = 0; r < kRings; ++r)
        for (int a = 0; a < kAround; ++a) {
            const double z = std::sqrt((r + 0.5) / kRings), across = std::sqrt(1 - z * z);
            const double phi = (a + 0.5) * 2 * kPi / kAround;
            const Elevation e = elevation(z);
            const double cosine =
                glm::dot(mToSun, glm::dvec3(across * std::cos(phi), across * std::sin(phi), z));
            once += (kPi * phaseOfMolecules(cosine) * glm::dvec3(e.molecules) +
                     kPi * phaseOfHaze(cosine) * glm::dvec3(e.haze)) /
                    double(kRings * kAround);
        }
    const glm::dvec3 direct =
        above * std::max(sine, 0.0) * glm::dvec3(sunlightAt(0, 0), sunlightAt(0, 1), sunlightAt(0, 2));
    const glm::dvec3 ambient =
        glm::max(total - direct - once, kScatteredAgain * once + kNightSky * glm::dvec3(0.5, 0.7, 1.0));
    const glm::dvec3 level = direct + once + ambient;
    const double exposure = kBrighter / std::sqrt(std::max(kLeastLevelLight, luminance(level)));
    mSunlight *= exposure;
    mGround = kPlain * glm::vec3(level / std::max(kLeastLevelLight, luminance(level)));
    for (Elevation& e : mElevations) {
        e.molecules *= static_cast<float>(exposure * kPi);
        e.haze *= static_cast<float>(exposure * kPi);
        e.ambient *= glm::vec3(exposure * ambient);
    }
    for (int c = 0; c < 3; ++c) {
        mAir.sunlight[c] = static_cast<float>(mSunUp * mSunlight[c] * kPi);
        mAir.ambient[c] = static_cast<float>(exposure * ambient[c]);
        mAir.toSun[c] = static_cast<float>(mToSun[c]);
    }
    const double g = kForward;
    mAir.phaseMolecules = static_cast<float>(3 / (16 * kPi));
    mAir.phaseHaze = static_cast<float>(3 / (8 * kPi) * (1 - g * g) / (2 + g * g));
    mAir.hazeTop = static_cast<float>(1 + g * g);
    mAir.hazePerCosine = static_cast<float>(2 * g);
}

AirEye Atmosphere::eyeAt(double worldHeight) const {
    AirEye eye;
    const double height = worldHeight - mAir.seaLevel, inside = std::min(height, double(kTopOfAir));
    eye.height = static_cast<float>(inside);
    eye.above = static_cast<float>(height - inside);
    const glm::dvec2 density = densityAt(inside);
    for (int k = 0; k < 2; ++k) eye.density[k] = static_cast<float>(density[k]);
    for (int c = 0; c < 3; ++c) {
        const double own = kPowers[c] * mAir.molecules * density.x;
        eye.share[c] = static_cast<float>(own / std::max(own + mAir.haze * density.y, 1e-30));
    }
    for (int k = 0; k < 2; ++k) {
        eye.sunDepth[k] = static_cast<float>(mAir.sunDepth[k] * density[k]);
        eye.sunLeft[k] = std::exp(-eye.sunDepth[k]);
    }
    return eye;
}

AirSeen Atmosphere::along(const glm::dvec3& eye, const glm::dvec3& direction, double t) const {
    const double length = glm::length(direction);
    const AirAlong<AirNumber> along =
        airAlong(mAir, eyeAt(eye.z), AirNumber(t * length), AirNumber(direction.z / length),
                 AirNumber(glm::dot(direction, mToSun) / length));
    AirSeen seen;
    for (int c = 0; c < 3; ++c) {
        seen.through[c] = along.through[c].v;
        seen.light[c] = along.light[c].v;
    }
    return seen;
}

glm::vec3 Atmosphere::sky(const glm::vec3& direction) const {
    const double cosine = glm::dot(glm::dvec3(direction), mToSun);
    Elevation e = elevation(direction.z);
    if (mHazyBelow && direction.z < 0) {
        const Elevation horizon = elevation(0);
        const float plain = glm::smoothstep(0.03f, 0.5f, -direction.z);
        e = {glm::mix(horizon.molecules, e.molecules, plain), glm::mix(horizon.haze, e.haze, plain),
             glm::mix(horizon.ambient, e.ambient, plain), glm::mix(horizon.ground, e.ground, plain)};
    }
    glm::vec3 light = static_cast<float>(phaseOfMolecules(cosine)) * e.molecules +
                      static_cast<float>(phaseOfHaze(cosine)) * e.haze + e.ambient + mGround * e.ground;
    // The disc, blurred over a tenth of a degree.
    const double beside = std::acos(std::clamp(cosine, -1.0, 1.0)) - kSunRadius;
    const double share = std::clamp(0.5 - beside / 0.0017, 0.0, 1.0);
    if (share > 0 && e.ground == glm::vec3(0.0f)) {
        const double perSolidAngle = 1 / (kSunRadius * kSunRadius);  // pi over the sun's solid angle
        for (int c = 0; c < 3; ++c)
            light[c] += static_cast<float>(share * mSunlight[c] * sunlightAt(mSeenFrom, c) * perSolidAngle);
    }
    return light;
}

SkyMap skyMapOf(const Atmosphere& air) {
    constexpr int kSize = 1024;  // a texel is 0.2 degrees, the sun's disc 0.53
    return SkyMap(kSize, [&](const glm::vec3& direction) { return air.sky(direction); });
}

}  // namespace stereonav
