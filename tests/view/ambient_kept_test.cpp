// Openness and modulation are kept while their inputs are the same: with any other setting they equal those
// of a volume that was opened with it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "app/scene/volume/ambient.h"
#include "engine/volume/transfer_function.h"

namespace stereonav {
namespace {

TransferFunction rampFrom(double from) {
    return TransferFunction({{from, {1, 1, 1}, 0}, {from + 300, {1, 1, 1}, 0.8}}, 0.001, "ramp");
}

// Settings of the user, and the function that they give.
struct AmbientAsked {
    VolumeOptions options;
    double rampStart = 100;
};

struct AmbientMade {
    std::vector<std::uint8_t> openness, modulation;
    std::optional<double> sigma;
    bool operator==(const AmbientMade&) const = default;
};

std::vector<std::uint8_t> bytesOf(const std::shared_ptr<const Volume<std::uint8_t>>& volume) {
    if (!volume) return {};
    return {volume->values.data(), volume->values.data() + volume->frame.count()};
}

class AmbientKept : public testing::Test {
protected:
    AmbientKept() {
        VolumeFrame frame;
        frame.size = {21, 19, 17};
        frame.spacing = {0.001, 0.0011, 0.0012};
        mScene.volume.field = GreyVolume(frame);
        for (int k = 0; k < frame.size.z; ++k)
            for (int j = 0; j < frame.size.y; ++j)
                for (int i = 0; i < frame.size.x; ++i)
                    mScene.volume.field.at(i, j, k) = static_cast<std::int16_t>(
                        200 + 150 * std::sin(0.5 * i) * std::cos(0.4 * j + 0.3 * k));
        mBase.options.ambient_mm = 3;
        mBase.options.modulate = Modulation::Gradient;
        mBase.options.modulateRadius_mm = 2.5;
    }
    // before: what mScene shows; null: nothing yet.
    AmbientMade make(const AmbientAsked& asked, const AmbientAsked* before,
                     std::optional<double> sigma = {}) {
        Progress quiet;
        VolumeLook& look = mScene.volume.look;
        if (!before) look = {};
        look.transfer = rampFrom(asked.rampStart);
        applyAmbient(asked.options, before ? &before->options : nullptr, mScene, quiet);
        const auto chosen =
            applyModulation(asked.options, before ? &before->options : nullptr, sigma, mScene, quiet);
        return {bytesOf(look.occlusion.openness), bytesOf(look.modulation), chosen};
    }
    void expectAsMadeAnew(const std::string& what, const AmbientAsked& asked) {
        const AmbientMade expected = make(asked, nullptr);
        const AmbientMade first = make(mBase, nullptr);
        EXPECT_FALSE(expected == first) << what << " changes nothing";
        EXPECT_TRUE(make(asked, &mBase, first.sigma) == expected) << what;
        // The way back gives the first result.
        EXPECT_TRUE(make(mBase, &asked, expected.sigma) == first) << "back from " << what;
    }

    ColonScene mScene;
    AmbientAsked mBase;
};

TEST_F(AmbientKept, WithAnyOtherSettingItIsMadeAnew) {
    for (const Modulation modulated : {Modulation::Gradient, Modulation::Variance}) {
        mBase.options.modulate = modulated;
        const auto with = [&](const std::string& what, const auto& change) {
            AmbientAsked asked = mBase;
            change(asked);
            expectAsMadeAnew(what, asked);
        };
        with("the radius", [](AmbientAsked& a) { a.options.ambient_mm = 4.5; });
        with("the method", [](AmbientAsked& a) { a.options.ambientMethod = OcclusionMethod::DrawnIn; });
        with("a number of the method", [](AmbientAsked& a) {
            a.options.ambientMethod = OcclusionMethod::DrawnIn;
            a.options.ambientMethod.deviations = 1.5;
        });
        with("no ambient light", [](AmbientAsked& a) { a.options.ambient_mm.reset(); });
        with("what it is modulated by", [&](AmbientAsked& a) {
            a.options.modulate =
                modulated == Modulation::Gradient ? Modulation::Variance : Modulation::Gradient;
        });
        with("no modulation", [](AmbientAsked& a) { a.options.modulate = Modulation::None; });
        with("its radius", [](AmbientAsked& a) { a.options.modulateRadius_mm = 5; });
        with("its sigma", [&](AmbientAsked& a) {
            a.options.modulateSigma = modulated == Modulation::Gradient ? 0.2 : 20;
        });
        // A chosen sigma depends on what the function shows.
        with("the function", [](AmbientAsked& a) {
            a.options.transfer = "another";
            a.rampStart = 300;
        });
        with("the opacity", [](AmbientAsked& a) {
            a.options.opacity = 0.5;
            a.rampStart = 250;
        });
        AmbientAsked usual = mBase;
        mBase.options.opacity = 0.5;
        with("the isovalue of the opacity", [](AmbientAsked& a) {
            a.options.isovalue = 300;
            a.rampStart = 300;
        });
        mBase = usual;
    }
}

TEST_F(AmbientKept, WithoutAnotherSettingItStays) {
    make(mBase, nullptr);
    const auto openness = mScene.volume.look.occlusion.openness;
    const auto modulation = mScene.volume.look.modulation;
    AmbientAsked same = mBase;
    same.options.ambientStrength = 2;
    same.options.ambientLamp = 0.5;
    make(same, &mBase, 1.0);
    EXPECT_EQ(mScene.volume.look.occlusion.openness, openness);
    EXPECT_EQ(mScene.volume.look.modulation, modulation);
}

}  // namespace
}  // namespace stereonav
