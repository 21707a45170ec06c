// Numbers that stay sound, for the plain sweep and for the fast one: optical depths of a slab from 1e-6 to
// 1e6, glow from 1e-6 to 1e6, 1 to 10,000 slices, media of which the answer is known in closed form; bounds
// that light can not leave; orders of convergence; what the blur keeps. The names of the cases are the rows
// of a table; the figures are in the XML report (--gtest_output=xml).
#include <numeric>
#include <random>

#include "sweep_subjects.h"
#include "tests/oracle/sweep_formulas.h"

namespace stereonav {
namespace {

using test::ball;
using test::makeField;
using test::nameOfWay;
using test::pictureOf;
using test::rootMeanSquare;
using test::Slab;
using test::slabGeometry;
using test::slabOf;
using test::sun;
using test::Uniform;
using test::viewFrom;
using test::Way;

MediumLight sunAtCosine(double cosine) {
    return sun({std::sqrt(std::max(0.0, 1 - cosine * cosine)), 0, cosine});
}
Slab slab(const std::vector<Uniform>& layers, double thick, MediumModel model, double eyeCosine,
          double lightCosine, bool forward, int slices) {
    Slab s{slabOf(layers, thick), {}, {}, {}};
    s.look.model = model;
    s.look.light = sunAtCosine(lightCosine);
    s.setting.slices = slices;
    s.geometry = slabGeometry(s.medium, s.look, s.setting, eyeCosine, forward, thick);
    return s;
}
glm::dvec4 seen(const Slab& s, Way way) {
    return glm::dvec4(pictureOf(s, way).light.at(1, 1));
}

double meanOfExp(double z) {
    return z == 0 ? 1 : -std::expm1(-z) / z;
}
double slabShareOf(double x, double y, bool forward) {
    if (forward) return x * meanOfExp(x + y);
    return y > x ? x * std::exp(-x) * meanOfExp(y - x) : x * std::exp(-y) * meanOfExp(x - y);
}

std::string number(double v) {
    char text[32];
    std::snprintf(text, sizeof text, "%g", v);
    std::string s = text;
    for (char& c : s)
        if (c == '.')
            c = 'p';
        else if (c == '-')
            c = 'm';
        else if (c == '+')
            c = '_';
    return s;
}

// ---- Homogeneous slabs, direct light

struct SlabCase {
    Way way;
    bool forward;
    double lightCosine;  // 1: exactly along (or against) the view
    double depth;        // tau d of one slab
    int slices;
};
std::string nameOfSlab(const testing::TestParamInfo<SlabCase>& info) {
    const SlabCase& c = info.param;
    return std::string(c.way == Way::Plain ? "Plain" : "Fast") + (c.forward ? "Forward" : "Backward") +
           "Cosine" + number(c.lightCosine) + "Depth" + number(c.depth) + "Slices" + std::to_string(c.slices);
}
std::vector<SlabCase> slabCases() {
    std::vector<SlabCase> all;
    for (const Way way : {Way::Plain, Way::Fast})
        for (const bool forward : {true, false})
            for (const double cosine : {1.0, 0.4})
                for (const double depth : {1e-6, 1e-3, 0.1, 1.0, 10.0, 1e3, 1e6})
                    for (const int slices : {1, 10, 600, 10000})
                        if (slices < 10000 ||
                            (cosine == 1 && depth < 1))  // a slab this deep is black by then
                            all.push_back({way, forward, cosine, depth, slices});
    return all;
}
class HomogeneousSlab : public testing::TestWithParam<SlabCase> {};

TEST_P(HomogeneousSlab, isTheClosedForm) {
    const SlabCase& c = GetParam();
    const double thick = 1, tau = c.depth * c.slices / thick;
    const Slab s = slab({{tau}}, thick, MediumModel::Direct, 1, c.lightCosine, c.forward, c.slices);
    const glm::dvec4 light = seen(s, c.way);
    const double x = tau * thick, y = tau * thick / c.lightCosine, expected = slabShareOf(x, y, c.forward);
    RecordProperty("error", std::to_string(std::abs(light.x - expected)));
    // Forward rays stop where less than 1/1024 is left. The fast sweep keeps light in 15 bits for the eyes
    // and adds floats: a relative rounding a slab.
    const double stop = c.forward ? std::min(expected, 1.0 / 1024) : 0;
    const double rounding = 1e-6 + (c.way == Way::Fast ? 4e-5 + 2e-7 * c.slices * expected : 0);
    EXPECT_LE(light.x, expected + rounding);
    EXPECT_GE(light.x, expected - stop - rounding);
    EXPECT_NEAR(light.w, std::exp(-x), 1.0 / 1024 + rounding);
    EXPECT_EQ(light.x, light.y);
}
INSTANTIATE_TEST_SUITE_P(All, HomogeneousSlab, testing::ValuesIn(slabCases()), nameOfSlab);

// ---- Glow

struct GlowCase {
    Way way;
    double glow, depth;
    int slices;
};
std::string nameOfGlow(const testing::TestParamInfo<GlowCase>& info) {
    const GlowCase& c = info.param;
    return std::string(c.way == Way::Plain ? "Plain" : "Fast") + "Glow" + number(c.glow) + "Depth" +
           number(c.depth) + "Slices" + std::to_string(c.slices);
}
std::vector<GlowCase> glowCases() {
    std::vector<GlowCase> all;
    for (const Way way : {Way::Plain, Way::Fast})
        for (const double glow : {1e-6, 1.0, 1e6})
            for (const double depth : {1e-6, 1.0, 1e6})
                for (const int slices : {1, 100}) all.push_back({way, glow, depth, slices});
    return all;
}
class GlowingSlab : public testing::TestWithParam<GlowCase> {};

TEST_P(GlowingSlab, isTheClosedForm) {
    const GlowCase& c = GetParam();
    Uniform u{c.depth * c.slices};
    u.color = glm::vec3(0);
    u.glow = glm::vec3(static_cast<float>(c.glow));
    for (const bool forward : {true, false}) {
        const Slab s = slab({u}, 1, MediumModel::Indirect, 1, 0.8, forward, c.slices);
        const double expected = c.glow * -std::expm1(-c.depth * c.slices);
        const double light = seen(s, c.way).x;
        EXPECT_LE(light, expected * (1 + 1e-5));
        EXPECT_GE(light, expected * (1 - 1e-5) - (forward && c.depth >= 1 ? c.glow / 1024 : 0));
    }
}
INSTANTIATE_TEST_SUITE_P(All, GlowingSlab, testing::ValuesIn(glowCases()), nameOfGlow);

// ---- Two layers

class TwoLayers : public testing::TestWithParam<Way> {};

TEST_P(TwoLayers, areTheClosedForm) {
    for (const double thin : {1e-6, 0.3})
        for (const double dense : {2.0, 1e4, 1e6})
            for (const bool denseFirst : {true, false})
                for (const int slices : {2, 50, 500})
                    for (const bool forward : {true, false}) {
                        const double a = denseFirst ? dense : thin, b = denseFirst ? thin : dense;
                        const Slab s = slab({{a}, {b}}, 1, MediumModel::Direct, 0.7, 0.9, forward, slices);
                        const double x1 = 0.5 * a / 0.7, y1 = 0.5 * a / 0.9, x2 = 0.5 * b / 0.7,
                                     y2 = 0.5 * b / 0.9;
                        const double expected = forward ? slabShareOf(x1, y1, true) +
                                                              std::exp(-x1 - y1) * slabShareOf(x2, y2, true)
                                                        : std::exp(-y1) * slabShareOf(x2, y2, false) +
                                                              std::exp(-x2) * slabShareOf(x1, y1, false);
                        const double light = seen(s, GetParam()).x;
                        EXPECT_LE(light, expected + 6e-5) << a << " " << b << " " << slices << forward;
                        EXPECT_GE(light, expected - 6e-5 - (forward ? 1.0 / 1024 : 0))
                            << a << " " << b << " " << slices << forward;
                    }
}
INSTANTIATE_TEST_SUITE_P(All, TwoLayers, testing::Values(Way::Plain, Way::Fast), nameOfWay);

// ---- What light can not do

class Bounds : public testing::TestWithParam<Way> {};

// Random densities over twelve orders, colour up to 1, light of radiance 1 by one way alone: what is seen is
// between 0 and 1 and no more than is not let through, and a number.
TEST_P(Bounds, lightIsNeverNegativeNorMoreThanWasPutIn) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> u(0, 1);
    for (int n = 0; n < 20; ++n) {
        auto field = makeField({6, 7, 5}, 1, {0, 0, 0}, [&](const glm::ivec3&) { return 1024 * u(random); });
        const double densest = std::pow(10.0, 12 * u(random) - 6);
        Uniform thin{densest * 1e-6}, dense{densest};
        thin.tauIndirect = glm::dvec3(thin.tau);
        dense.tauIndirect = glm::dvec3(dense.tau * u(random), 0, dense.tau);
        const double reference = test::referenceFor(dense.tau);
        std::vector<MediumPoint> points{{300, test::materialOf(thin, reference)},
                                        {1024, test::materialOf(dense, reference)}};
        Slab s{Medium(field, MediumTransfer(points, reference, "test")), {}, {}, {}};
        s.look.light = sun({u(random) - 0.5, u(random) - 0.5, u(random) - 0.5});
        s.look.model = n % 2 ? MediumModel::Direct : MediumModel::Indirect;
        if (n % 2 == 0) s.look.phase = PhaseFunction();
        s.look.indirectShare = n % 2 ? 0.0f : 1.0f;
        s.setting.slices = 1 + static_cast<int>(40 * u(random));
        s.setting.lightSize = 8 + static_cast<int>(20 * u(random));
        s.setting.coneAngle = 2.5 * u(random);
        const EyeView eye[] = {
            viewFrom({3 * u(random) - 1.5, 3 * u(random) - 1.5, 2 * u(random)}, {0, 0, 0}, 0.6, 9, 9)};
        s.geometry = makeSweepGeometry(s.medium, s.look, s.setting, eye, eye[0].eye);
        const MediumPicture picture = pictureOf(s, GetParam());
        // Direct and scattered light are both 1 where nothing is in the way.
        const double most = n % 2 ? 1 : 2;
        for (int y = 0; y < 9; ++y)
            for (int x = 0; x < 9; ++x) {
                const glm::vec4 p = picture.light.at(x, y);
                ASSERT_GE(p.w, 0);
                ASSERT_LE(p.w, 1);
                for (int k = 0; k < 3; ++k) {
                    ASSERT_GE(p[k], 0) << n;
                    ASSERT_LE(p[k], most * (1 - p.w) + 2e-5) << n;
                }
            }
    }
}

// More of the same medium sends more light back (backward), and lets less through.
TEST_P(Bounds, aThickerSlabSendsBackMoreAndLetsLessThrough) {
    for (const bool forward : {true, false}) {
        double sent = -1, through = 2;
        for (const double depth : {1e-6, 1e-4, 0.01, 0.1, 0.5, 1.0, 2.0, 5.0, 20.0, 1e3, 1e6}) {
            const Slab s = slab({{depth}}, 1, MediumModel::Direct, 0.8, 0.9, forward, 32);
            const glm::dvec4 light = seen(s, GetParam());
            // Forward the eye sees the lit face: that grows. Backward the eye is on the dark side.
            if (forward) {
                EXPECT_GE(light.x, sent - 1.0 / 1024) << depth;
            }
            EXPECT_LE(light.w, through + 1e-7) << depth;
            sent = std::max(sent, light.x);
            through = light.w;
        }
    }
}

TEST_P(Bounds, opacityExactly0And1AreSound) {
    const auto at = [&](double opacity, float transport) {
        MediumMaterial m;
        m.opacity = opacity;
        m.transport = glm::vec3(transport);
        std::vector<MediumPoint> points{{0, m}, {1024, m}};
        auto field = makeField({3, 3, 3}, 1, {0, 0, 0}, [](const glm::ivec3& v) { return 512 * v.z; });
        Slab s{Medium(field, MediumTransfer(points, 1e-3, "test")), {}, {}, {}};
        s.look.light = sun({0, 0, 1});
        s.setting.slices = 20;
        const EyeView eye[] = {viewFrom({0, 0, -5}, {0, 0, 0}, 0.01, 3, 3)};
        s.geometry = makeSweepGeometry(s.medium, s.look, s.setting, eye, eye[0].eye);
        return seen(s, GetParam());
    };
    EXPECT_EQ(at(0, 1), glm::dvec4(0, 0, 0, 1));
    const glm::dvec4 opaque = at(1, 0);
    EXPECT_NEAR(opaque.x, 1, 1e-3);  // half of direct, half of scattered light: both 1 at the lit face
    EXPECT_LE(opaque.w, 1.0 / 1024);
    const glm::dvec4 clear = at(1, 1);  // scattered light is not weakened at all
    EXPECT_NEAR(clear.x, 1.5, 1e-3);
}

// Eye in the middle of a slab: what it sees is the half before it.
TEST_P(Bounds, anEyeInsideSeesWhatIsBeforeIt) {
    for (const bool forward : {true, false}) {
        Slab s = slab({{2.0}}, 1, MediumModel::Direct, 1, 1, forward, 64);
        s.geometry.eyes[0].origin = -s.geometry.anchor;
        const glm::dvec4 light = seen(s, GetParam());
        EXPECT_NEAR(light.w, std::exp(-1.0), 1e-5);
        const double expected = forward ? std::exp(-1.0) * slabShareOf(1, 1, true) : slabShareOf(1, 1, false);
        EXPECT_NEAR(light.x, expected, 1e-4);
    }
}
INSTANTIATE_TEST_SUITE_P(All, Bounds, testing::Values(Way::Plain, Way::Fast), nameOfWay);

// ---- Order of convergence

// How fast the difference to twice as many slices falls from n to 4 n: its logarithm to 2, an octave.
double orderOf(MediumModel model, double cone, int n) {
    const auto step = [&](int slices) {
        const auto picture = [&](int k) {
            return pictureOf(ball(model, k, {0.5, -3, 0.7}, cone), Way::Plain);
        };
        return rootMeanSquare(picture(slices), picture(2 * slices));
    };
    return 0.5 * std::log2(step(n) / step(4 * n));
}

TEST(Convergence, directLightIsOfTheSecondOrder) {
    const double order = orderOf(MediumModel::Direct, 0, 24);
    RecordProperty("order", std::to_string(order));
    EXPECT_NEAR(order, 2, 0.25);
}
TEST(Convergence, blurredLightIsOfTheFirstOrderAtLeast) {
    const double order = orderOf(MediumModel::Indirect, 0.6, 24);
    RecordProperty("order", std::to_string(order));
    EXPECT_GT(order, 0.9);
}

// ---- The blur

// Runs the taps alone over a plane with one bright texel.
// `shift`: of the texels' numbers, for other turns.
std::vector<double> blurredPoint(double offset, int slabs, int size, int shift = 0) {
    std::vector<double> plane(static_cast<std::size_t>(size) * size, 0.0), next = plane;
    plane[static_cast<std::size_t>(size / 2) * size + size / 2] = 1;
    const auto at = [&](int x, int y) {
        return x >= 0 && y >= 0 && x < size && y < size ? plane[static_cast<std::size_t>(y) * size + x] : 0.0;
    };
    const auto bilinear = [&](double x, double y) {
        const double i = std::floor(x), j = std::floor(y), s = x - i, t = y - j;
        const int c = static_cast<int>(i), r = static_cast<int>(j);
        return (at(c, r) * (1 - s) + at(c + 1, r) * s) * (1 - t) +
               (at(c, r + 1) * (1 - s) + at(c + 1, r + 1) * s) * t;
    };
    const BlurTaps taps = blurTaps(offset);
    for (int n = 0; n < slabs; ++n) {
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x) {
                double sum = 0;
                const double turn = taps.radius > 1 ? tapTurn(x + shift, y, n) : 0;
                const double c = taps.radius * std::cos(turn), s = taps.radius * std::sin(turn);
                sum = bilinear(x + c, y + s) + bilinear(x - s, y + c) + bilinear(x - c, y - s) +
                      bilinear(x + s, y - c);
                next[static_cast<std::size_t>(y) * size + x] =
                    (1 - taps.share) * at(x, y) + 0.25 * taps.share * sum;
            }
        std::swap(plane, next);
    }
    return plane;
}
struct Moments {
    double sum = 0, variance = 0, least = 1, most = 0;
};
Moments momentsOf(const std::vector<double>& plane, int size) {
    Moments m;
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const double v = plane[static_cast<std::size_t>(y) * size + x];
            m.sum += v;
            m.variance += v * (x - size / 2) * (x - size / 2);
            m.least = std::min(m.least, v);
            m.most = std::max(m.most, v);
        }
    m.variance /= m.sum;
    return m;
}

// The same way through 1, 4, .. 64 times as many slabs: the offset falls with the root of the number (V9),
// the spread stays that of the heat kernel. Below a texel exactly; on circles turned by a hash within 8 %.
TEST(Blur, spreadsTheSameForAnyNumberOfSlabs) {
    constexpr int kSize = 81;
    const double expected = 0.5 * 4 * 0.9 * 0.9;  // four slabs with an offset of 0.9 texels
    for (const int finer : {1, 4, 16, 64}) {
        const Moments m = momentsOf(blurredPoint(0.9 / std::sqrt(finer), 4 * finer, kSize), kSize);
        EXPECT_NEAR(m.variance, expected, 1e-9) << finer;
        EXPECT_NEAR(m.sum, 1, 1e-12) << finer;
        EXPECT_GE(m.least, 0) << finer;
        EXPECT_LE(m.most, 1) << finer;
    }
    // On circles each texel gathers by its own turn: what is kept of one point differs, the meanOfExp of many
    // does not.
    for (const int finer : {1, 2, 4}) {
        constexpr int kPoints = 24;
        double sum = 0, variance = 0;
        for (int point = 0; point < kPoints; ++point) {
            const Moments m = momentsOf(blurredPoint(4 / std::sqrt(finer), 4 * finer, 49, 1000 * point), 49);
            EXPECT_GE(m.least, 0) << finer;
            EXPECT_LE(m.most, 1) << finer;
            sum += m.sum / kPoints;
            variance += m.sum * m.variance / kPoints;
        }
        EXPECT_NEAR(sum, 1, 0.1) << finer;
        EXPECT_NEAR(variance / sum / (0.5 * 4 * 16), 1, 0.08) << finer;
    }
}

// Many slabs of small offsets make the Gaussian of that variance.
TEST(Blur, tendsToTheHeatKernel) {
    constexpr int kSize = 61;
    const std::vector<double> plane = blurredPoint(0.5, 200, kSize);
    const double variance = 0.5 * 200 * 0.25;
    for (int x = 0; x < kSize; ++x) {
        const double d = x - kSize / 2;
        const double gauss = std::exp(-d * d / (2 * variance)) / (2 * std::acos(-1.0) * variance);
        const double highest = 1 / (2 * std::acos(-1.0) * variance);
        EXPECT_NEAR(plane[static_cast<std::size_t>(kSize / 2) * kSize + x], gauss, 0.01 * highest) << x;
    }
}

}  // namespace
}  // namespace stereonav
