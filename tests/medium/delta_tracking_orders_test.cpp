// Every order of scattering: conservation of light, Chandrasekhar's half space, van de Hulst's slab, and
// colours that are scattered differently in one picture.
#include <gtest/gtest.h>

#include "tests/medium/delta_tracking_scenes.h"

namespace stereonav {
namespace {

const glm::dvec3 kDown{0, 0, -1};

// Flux through the upper and the lower face for light straight down, as shares of what comes in; the way of
// the light in every direction by Gauss and Legendre's rule over the cosine.
struct Fluxes {
    double up = 0, down = 0, error = 0;
};
Fluxes fluxesOf(const Medium& slab, double thickness, double opticalDepth, const PhaseFunction& phase,
                int nodes, int samples) {
    MediumLook look = litLook(kDown, MediumModel::Indirect);
    look.phase = phase;
    Fluxes sum;
    double variance = 0;
    std::uint32_t seed = 1;
    for (const Node& node : gaussNodes(nodes)) {
        const double mu = node.at, sine = std::sqrt(1 - mu * mu);
        // Incoming: 4 pi R across the way. Out: 2 pi integral of L mu.
        const double factor = node.weight * mu / 2;
        const Estimate above = track(slab, look, narrowView({sine, 0, -mu}), samples, 100000, seed++);
        const Estimate below =
            track(slab, look, narrowView({sine, 0, mu}, 1, {0, 0, -thickness}), samples, 100000, seed++);
        sum.up += factor * above.light.x;
        sum.down += factor * below.light.x;
        variance += factor * factor * (above.error.x * above.error.x + below.error.x * below.error.x);
    }
    sum.down += std::exp(-opticalDepth);
    sum.error = std::sqrt(variance);
    return sum;
}

TEST(DeltaTrackingOrders, ConservativeSlabLosesNoLight) {
    for (const float g : {0.0f, 0.8f}) {
        const PhaseFunction phase = g == 0 ? PhaseFunction() : PhaseFunction::henyeyGreenstein(glm::vec3(g));
        const Medium slab = homogeneousSlab(3, 1, glm::vec3(1.0f));
        const Fluxes flux = fluxesOf(slab, 1, 3, phase, 10, 60);
        EXPECT_LT(flux.error, 0.01) << g;
        EXPECT_NEAR(flux.up + flux.down, 1, kStated_z * flux.error) << g;
    }
}

// van de Hulst, Multiple Light Scattering (1980), table 35: optical depth 2, albedo 0.9, Henyey-Greenstein
// 0.75: reflectance 0.09739, transmittance 0.66096.
TEST(DeltaTrackingOrders, VanDeHulstsSlab) {
    const PhaseFunction phase = PhaseFunction::henyeyGreenstein(glm::vec3(0.75f));
    const Fluxes flux = fluxesOf(homogeneousSlab(2, 1, glm::vec3(0.9f)), 1, 2, phase, 12, 100);
    EXPECT_LT(flux.error, 0.006);
    EXPECT_NEAR(flux.up, 0.09739, kStated_z * flux.error);
    EXPECT_NEAR(flux.down, 0.66096, kStated_z * flux.error);
}

// Chandrasekhar's H-function for isotropic scattering: 1 / H(mu) = sqrt(1 - a) + a/2 integral of
// x H(x) / (mu + x), iterated (Radiative Transfer, 1950, section 40).
struct HalfSpace {
    explicit HalfSpace(double albedo) : mAlbedo(albedo), mH(mNodes.size(), 1.0) {
        for (int step = 0; step < 2000; ++step) {
            std::vector<double> next;
            for (const Node& node : mNodes) next.push_back(h(node.at));
            for (std::size_t n = 0; n < next.size(); ++n) mH[n] = 0.5 * (mH[n] + next[n]);
        }
    }
    double h(double mu) const {
        double sum = std::sqrt(1 - mAlbedo);
        for (std::size_t n = 0; n < mNodes.size(); ++n)
            sum += mAlbedo / 2 * mNodes[n].weight * mNodes[n].at * mH[n] / (mu + mNodes[n].at);
        return 1 / sum;
    }
    // Radiance sent back for R = 1: pi F = 4 pi R.
    double reflected(double mu, double mu0) const { return mAlbedo * mu0 / (mu + mu0) * h(mu) * h(mu0); }

private:
    double mAlbedo;
    std::vector<Node> mNodes = gaussNodes(40);
    std::vector<double> mH;
};

TEST(DeltaTrackingOrders, TheHalfSpaceOfTheseTestsIsTheTabulatedOne) {
    EXPECT_NEAR(HalfSpace(1).h(1), 2.9078, 2e-3);
    EXPECT_NEAR(HalfSpace(1).h(0.5), 2.0128, 2e-3);
}

TEST(DeltaTrackingOrders, HalfSpaceReflectsAsChandrasekharSays) {
    struct Case {
        double albedo, mu, mu0;
        int samples;
    };
    for (const Case& c : {Case{0.5, 1, 1, 400}, Case{0.9, 1, 1, 400}, Case{0.9, 0.5, 1, 400},
                          Case{0.99, 0.3, 0.7, 400}, Case{0.999, 1, 1, 200}}) {
        const Medium slab = homogeneousSlab(100, 100, glm::vec3(static_cast<float>(c.albedo)));
        const MediumLook look = litLook({0, std::sqrt(1 - c.mu0 * c.mu0), -c.mu0}, MediumModel::Indirect);
        const EyeView view = narrowView({std::sqrt(1 - c.mu * c.mu), 0, -c.mu});
        const Estimate seen = track(slab, look, view, c.samples, 1000000);
        const double truth = HalfSpace(c.albedo).reflected(c.mu, c.mu0);
        EXPECT_LT(seen.error.x, 0.02 * truth) << c.albedo;
        EXPECT_LT(std::abs(seen.z(0, truth)), kStated_z) << c.albedo << ' ' << seen.light.x << ' ' << truth;
    }
}

// The second order of an isotropic half space, light and eye along its normal: with E1 the exponential
// integral, R a^2 / 2 integral of exp(-t - u) E1(|t - u|) = R a^2 ln(2) / 2; the half of it comes from light
// that went on downwards, the other half from light that had turned back.
TEST(DeltaTrackingOrders, HalfOfTheSecondOrderTurnsBack) {
    const double albedo = 0.8;
    const Medium slab = homogeneousSlab(50, 1, glm::vec3(0.8f));
    const MediumLook look = litLook(kDown, MediumModel::Indirect);
    TrackingSetting setting;
    setting.samples = 1500;
    setting.mostScatters = 2;
    for (const bool onlyForward : {false, true}) {
        setting.onlyForward = onlyForward;
        const Estimate seen = meanOf(trackPicture(slab, look, narrowView(kDown), setting));
        const double second = albedo * albedo * std::log(2.0) / (onlyForward ? 4 : 2);
        EXPECT_LT(std::abs(seen.z(0, albedo / 2 + second)), kStated_z) << onlyForward;
        EXPECT_LT(seen.error.x, 0.05 * second) << onlyForward;
    }
}

// Three colours that are scattered each in its own way, in one picture and each alone.
TEST(DeltaTrackingOrders, ColoursOfOnePathAreEachRight) {
    const glm::vec3 g{0.8f, 0.0f, -0.5f}, color{0.95f, 0.8f, 0.99f};
    const Medium slab = homogeneousSlab(4, 1, color);
    const EyeView view = narrowView({0.6, 0, -0.8});
    MediumLook look = litLook({0, 0.6, -0.8}, MediumModel::Indirect);
    look.phase = PhaseFunction::henyeyGreenstein(g);
    const Estimate all = track(slab, look, view, 400, 100000);
    for (int c = 0; c < 3; ++c) {
        const Medium grey = homogeneousSlab(4, 1, glm::vec3(color[c]));
        look.phase = PhaseFunction::henyeyGreenstein(glm::vec3(g[c]));
        const Estimate one = track(grey, look, view, 400, 100000, 9);
        const double error = std::hypot(all.error[c], one.error[c]);
        EXPECT_LT(error, 0.05 * one.light[c]) << c;
        EXPECT_LT(std::abs(all.light[c] - one.light[c]), kStated_z * error) << c;
    }
}

TEST(DeltaTrackingOrders, MoreOrdersBringMoreLightAndShareScalesThem) {
    const Medium slab = homogeneousSlab(5, 1, glm::vec3(0.9f));
    const EyeView view = narrowView(kDown);
    MediumLook look = litLook(kDown, MediumModel::Indirect);
    std::vector<Estimate> seen;
    for (const int scatters : {1, 2, 8, 64}) seen.push_back(track(slab, look, view, 400, scatters));
    for (std::size_t n = 1; n < seen.size(); ++n) EXPECT_GT(seen[n].light.x, 1.02 * seen[n - 1].light.x) << n;
    look.indirectShare = 0.25f;
    const Estimate part = track(slab, look, view, 400, 64);
    EXPECT_NEAR(part.light.x, seen[0].light.x + 0.25 * (seen[3].light.x - seen[0].light.x),
                kStated_z * seen[3].error.x);
    look.model = MediumModel::Direct;
    EXPECT_EQ(track(slab, look, view, 400, 64).light.x, seen[0].light.x);
}

}  // namespace
}  // namespace stereonav
