// Pictures warped to where the eye is now, against a scene of closed forms cast there, and against the plain
// form.
#include "engine/late/late_warp.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <string>
#include <vector>

#include "tests/oracle/late_oracle.h"

namespace stereonav {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180;

// Ground at height 0, three balls, and a sky that is infinitely far; smooth colours.
struct LateScene {
    struct Ball {
        glm::dvec3 middle;
        double radius;
    };
    std::vector<Ball> balls{{{0, 12, 1.5}, 1.5}, {{-4, 20, 2.5}, 2.0}, {{5, 30, 3}, 3.0}};

    PackedColor colorAt(const glm::dvec3& p, int kind) const {
        // Fainter far away, so that no pixel has more than one wave in it.
        const double strength = 0.3 * std::exp(-std::pow(glm::length(p) / 25, 2));
        const auto wave = [&](double x) { return static_cast<float>(0.45 + strength * std::sin(x)); };
        if (kind == 0) return packColor({wave(p.x * 0.9), wave(p.y * 0.7), 0.3f});
        return packColor({0.2f, wave(2 * p.z), wave(p.x + p.y)});
    }
    EyeImage cast(const EyeView& view) const {
        EyeImage image;
        image.resize(view.width, view.height);
        for (int y = 0; y < view.height; ++y)
            for (int x = 0; x < view.width; ++x) {
                const glm::dvec3 d = view.rayDirection(x + 0.5, y + 0.5);
                double depth = std::numeric_limits<double>::infinity();
                int kind = -1;
                if (d.z < 0) depth = -view.eye.z / d.z, kind = 0;
                for (const Ball& ball : balls) {
                    const glm::dvec3 away = view.eye - ball.middle;
                    const double a = glm::dot(d, d), b = glm::dot(d, away),
                                 c = glm::dot(away, away) - ball.radius * ball.radius, root = b * b - a * c;
                    if (root < 0) continue;
                    const double t = (-b - std::sqrt(root)) / a;
                    if (t > 0 && t < depth) depth = t, kind = 1;
                }
                image.viewDepth.at(x, y) = static_cast<float>(depth);
                image.color.at(x, y) =
                    kind < 0 ? packColor({0.3f, 0.4f, static_cast<float>(0.6 + 0.3 * glm::normalize(d).z)})
                             : colorAt(view.eye + depth * d, kind);
            }
        return image;
    }
};

EyeView lateView(const glm::dvec3& eye, double yaw, double pitch, int width, int height) {
    EyeView view;
    view.eye = view.head = eye;
    const double cy = std::cos(yaw), sy = std::sin(yaw), cp = std::cos(pitch), sp = std::sin(pitch);
    view.right = {cy, -sy, 0};
    view.forward = {sy * cp, cy * cp, sp};
    view.up = glm::cross(view.right, view.forward);
    view.xMax = 0.7, view.xMin = -0.7;
    view.yMax = 0.7 * height / width, view.yMin = -view.yMax;
    view.width = width, view.height = height;
    view.nearDepth = 0.1;
    return view;
}

int apartOf(PackedColor a, PackedColor b) {
    int most = 0;
    for (int k = 0; k < 30; k += 10)
        most = std::max(most, std::abs(static_cast<int>(a >> k & 1023u) - static_cast<int>(b >> k & 1023u)));
    return most;
}

struct Apart {
    double psnr_db = 0, wrong = 0;  // for 10-bit channels; share of pixels that differ by over 16 steps
};
// mask: pixels where it is set are left out; null: none is.
Apart apart(const Plane<PackedColor>& a, const Plane<PackedColor>& b,
            const Plane<std::uint8_t>* mask = nullptr) {
    double squares = 0, wrong = 0, count = 0;
    for (int y = 0; y < a.height(); ++y)
        for (int x = 0; x < a.width(); ++x) {
            if (mask && mask->at(x, y)) continue;
            const int most = apartOf(a.at(x, y), b.at(x, y));
            squares += most * most;
            wrong += most > 16;
            ++count;
        }
    return {10 * std::log10(1023.0 * 1023.0 * count / std::max(squares, 1e-9)), wrong / count};
}

double shareOf(const Plane<std::uint8_t>& mask) {
    double set = 0;
    for (int y = 0; y < mask.height(); ++y)
        for (int x = 0; x < mask.width(); ++x) set += mask.at(x, y) ? 1 : 0;
    return set / (static_cast<double>(mask.width()) * mask.height());
}

struct LateMotion {
    const char* name;
    glm::dvec3 move;
    double yaw, pitch;  // degrees
};

const LateMotion kMotions[] = {
    {"turns", {0, 0, 0}, 2, 1},   {"ahead", {0, 0.4, 0}, 0, 0}, {"aside", {0.3, 0, 0}, 0, 0},
    {"rises", {0, 0, 0.3}, 0, 0}, {"back", {0, -0.5, 0}, 0, 0}, {"all", {0.2, 0.4, 0.1}, 1.5, -1},
};

EyeView startView(int width = 320, int height = 200) {
    return lateView({0, 0, 1.8}, 0, -5 * kDegree, width, height);
}
EyeView movedBy(const EyeView& from, const LateMotion& motion, int width = 320, int height = 200) {
    return lateView(from.eye + motion.move, motion.yaw * kDegree, (motion.pitch - 5) * kDegree, width,
                    height);
}

// The bounds are a tenth of a pixel of the steepest colours (6 % of their range a pixel, 44 dB) and one pixel
// of the three balls' edges, 1 % of the picture.
TEST(LateWarp, ShowsWhatIsSeenFromThere) {
    const LateScene scene;
    const EyeView from = startView();
    const EyeImage seen = scene.cast(from);
    for (const SimdTarget target : simdTargets()) {
        LateEye late;
        late.prepare(seen.viewDepth, from, target);
        for (const LateMotion& motion : kMotions) {
            SCOPED_TRACE(std::string(motion.name) + " " + std::string(nameOf(target)));
            const EyeView to = movedBy(from, motion);
            const EyeImage truth = scene.cast(to);
            Plane<PackedColor> image;
            Plane<std::uint8_t> uncovered;
            late.warp(seen.color, to, image, &uncovered);
            const Apart known = apart(truth.color, image, &uncovered);
            EXPECT_GT(known.psnr_db, 38);
            EXPECT_LT(known.wrong, 0.01);
            EXPECT_GT(apart(truth.color, image).psnr_db, 36);
            // The same picture not warped.
            EXPECT_LT(apart(truth.color, seen.color).psnr_db, 32);
        }
    }
}

TEST(LateWarp, IsAsThePlainForm) {
    const LateScene scene;
    const EyeView from = startView(160, 100);
    const EyeImage seen = scene.cast(from);
    for (const LateMotion& motion : kMotions) {
        const EyeView to = movedBy(from, motion, 160, 100);
        Plane<PackedColor> plain;
        Plane<std::uint8_t> plainUncovered;
        warpLatePlainly(seen.color, seen.viewDepth, from, to, plain, plainUncovered);
        for (const SimdTarget target : simdTargets()) {
            SCOPED_TRACE(std::string(motion.name) + " " + std::string(nameOf(target)));
            LateEye late;
            late.prepare(seen.viewDepth, from, target);
            Plane<PackedColor> image;
            Plane<std::uint8_t> uncovered;
            late.warp(seen.color, to, image, &uncovered);
            const Apart against = apart(plain, image);
            EXPECT_GT(against.psnr_db, 38);
            EXPECT_LT(against.wrong, 0.01);
            EXPECT_NEAR(shareOf(uncovered), shareOf(plainUncovered), 0.01);
        }
    }
}

TEST(LateWarp, OfTheSameViewIsThePicture) {
    const LateScene scene;
    const EyeView from = startView(101, 67);  // a size of no whole vectors and tiles
    const EyeImage seen = scene.cast(from);
    for (const SimdTarget target : simdTargets()) {
        LateEye late;
        late.prepare(seen.viewDepth, from, target);
        Plane<PackedColor> image;
        Plane<std::uint8_t> uncovered;
        late.warp(seen.color, from, image, &uncovered);
        EXPECT_EQ(shareOf(uncovered), 0);
        for (int y = 0; y < image.height(); ++y)
            for (int x = 0; x < image.width(); ++x)
                ASSERT_LE(apartOf(image.at(x, y), seen.color.at(x, y)), 1) << x << " " << y;
    }
}

TEST(LateWarp, ThreadsAndSetsAgree) {
    const LateScene scene;
    const EyeView from = startView();
    const EyeImage seen = scene.cast(from);
    const EyeView to = movedBy(from, kMotions[5]);
    LateEye late;
    late.prepare(seen.viewDepth, from);
    Plane<PackedColor> alone, together;
    late.warp(seen.color, to, alone);
    late.warp(seen.color, to, together, nullptr, true);
    for (int y = 0; y < alone.height(); ++y)
        for (int x = 0; x < alone.width(); ++x) ASSERT_EQ(alone.at(x, y), together.at(x, y));
    for (const SimdTarget target : simdTargets()) {
        LateEye other;
        other.prepare(seen.viewDepth, from, target);
        other.warp(seen.color, to, together);
        EXPECT_GT(apart(alone, together).psnr_db, 55) << nameOf(target);
    }
}

// The new picture may have more pixels than the one that was cast.
TEST(LateWarp, EnlargesSmallerPictures) {
    const LateScene scene;
    const EyeView from = startView(240, 150);
    const EyeImage seen = scene.cast(from);
    LateEye late;
    late.prepare(seen.viewDepth, from);
    for (const LateMotion& motion : kMotions) {
        const EyeView to = movedBy(from, motion);
        const EyeImage truth = scene.cast(to);
        Plane<PackedColor> image;
        Plane<std::uint8_t> uncovered;
        late.warp(seen.color, to, image, &uncovered);
        EXPECT_GT(apart(truth.color, image, &uncovered).psnr_db, 35) << motion.name;
    }
}

// What stood before an uncovered place leaves nothing of its colour there, nor does the smooth edge of it: a
// pixel of the wall's depth that is half pole.
TEST(LateWarp, LeavesNoGhosts) {
    EyeView from = lateView({0, 0, 0}, 0, 0, 200, 120);
    EyeImage seen;
    seen.resize(200, 120);
    const PackedColor wall = packColor({0.1f, 0.1f, 0.1f}), pole = packColor({0.9f, 0.9f, 0.9f}),
                      half = packColor({0.5f, 0.5f, 0.5f});
    for (int y = 0; y < 120; ++y)
        for (int x = 0; x < 200; ++x) {
            const bool isPole = x >= 90 && x < 110;
            seen.color.at(x, y) = isPole ? pole : x == 89 || x == 110 ? half : wall;
            seen.viewDepth.at(x, y) = isPole ? 2.0f : 20.0f;
        }
    EyeView to = from;
    to.eye.x += 0.15;
    const double shift = 0.15 / 2 / from.pixelWidth(), far = 0.15 / 20 / from.pixelWidth();
    for (const SimdTarget target : simdTargets()) {
        LateEye late;
        late.prepare(seen.viewDepth, from, target);
        Plane<PackedColor> image;
        Plane<std::uint8_t> uncovered;
        late.warp(seen.color, to, image, &uncovered);
        for (int x = 2; x < 195; ++x) {
            // Edges may be a pixel off.
            const double left = 90 - shift, right = 110 - shift;
            if (std::abs(x + 0.5 - left) < 1.6 || std::abs(x + 0.5 - right) < 1.6) continue;
            const bool isPole = x + 0.5 > left && x + 0.5 < right;
            EXPECT_LE(apartOf(image.at(x, 60), isPole ? pole : wall), 2) << x << " " << nameOf(target);
            const bool isNew = x + 0.5 > right + 1.6 && x + 0.5 < 110 - far - 1.6;
            EXPECT_TRUE(!isNew || uncovered.at(x, 60)) << x;
            EXPECT_FALSE(x < 60 && uncovered.at(x, 60)) << x;
        }
    }
}

// Nothing tears that is seen through, and its end moves with it.
TEST(LateWarp, SoftDepthsDoNotTear) {
    EyeView from = lateView({0, 0, 0}, 0, 0, 200, 120);
    EyeImage seen;
    seen.resize(200, 120);
    for (int y = 0; y < 120; ++y)
        for (int x = 0; x < 200; ++x) {
            const bool isCloud = std::hypot(x - 100, y - 60) < 40;
            seen.color.at(x, y) = isCloud ? packColor({0.8f, 0.8f, 0.8f}) : packColor({0.1f, 0.2f, 0.5f});
            seen.viewDepth.at(x, y) = isCloud ? 5.0f : std::numeric_limits<float>::infinity();
        }
    LateEye late;
    late.prepare(seen.viewDepth, from, SimdTarget::Auto, true);
    EyeView to = from;
    to.eye.x += 10 * 5 * from.pixelWidth();  // ten pixels of the cloud's depth
    Plane<PackedColor> image;
    Plane<std::uint8_t> uncovered;
    late.warp(seen.color, to, image, &uncovered);
    for (int y = 0; y < 120; ++y)
        for (int x = 0; x < 180; ++x)
            ASSERT_LE(apartOf(image.at(x, y), seen.color.at(x + 10, y)), 2) << x << " " << y;
    EXPECT_LT(shareOf(uncovered), 0.06) << "its right border alone";
    seen.viewDepth = Plane<float>(200, 120);  // nothing is known at all
    late.prepare(seen.viewDepth, from, SimdTarget::Auto, true);
    late.warp(seen.color, to, image);
    EXPECT_LE(apartOf(image.at(100, 60), seen.color.at(100, 60)), 1);
}

// Depths that are no numbers, all sky, one pixel, a view behind: whatever comes is a picture.
TEST(LateWarp, TakesAnything) {
    const LateScene scene;
    const EyeView from = startView(64, 40);
    EyeImage seen = scene.cast(from);
    for (int x = 0; x < 64; ++x) {
        seen.viewDepth.at(x, 7) = std::nanf("");
        seen.viewDepth.at(x, 8) = 0;
        if (x % 5 == 0) seen.viewDepth.at(x, 20) = 0;
        seen.viewDepth.at(x, 30) = -1;
    }
    const EyeImage sky = [&] {
        EyeImage image = scene.cast(from);
        for (int y = 0; y < 40; ++y)
            for (int x = 0; x < 64; ++x) image.viewDepth.at(x, y) = std::numeric_limits<float>::infinity();
        return image;
    }();
    EyeView behind = lateView(from.eye, 180 * kDegree, 0, 64, 40), close = movedBy(from, kMotions[1], 64, 40);
    close.eye.y += 11;  // into the first ball
    EyeView bad = from;
    bad.nearDepth = 0;
    for (const SimdTarget target : simdTargets())
        for (const EyeImage* image : {static_cast<const EyeImage*>(&seen), &sky})
            for (const EyeView& to : {from, behind, close, bad, movedBy(from, kMotions[5], 1, 1)}) {
                LateEye late;
                late.prepare(image->viewDepth, from, target);
                Plane<PackedColor> out;
                Plane<std::uint8_t> uncovered;
                late.warp(image->color, to, out, &uncovered);
                EXPECT_EQ(out.width(), to.width);
                for (int y = 0; y < out.height(); ++y)
                    for (int x = 0; x < out.width(); ++x) ASSERT_LT(out.at(x, y), 1u << 30);
            }
    LateEye empty;
    EXPECT_FALSE(empty.ready());
    empty.prepare({}, from);
    EXPECT_FALSE(empty.ready());
    EyeImage one;
    one.resize(1, 1);
    one.viewDepth.at(0, 0) = 3;
    one.color.at(0, 0) = 12345;
    empty.prepare(one.viewDepth, startView(1, 1));
    Plane<PackedColor> out;
    empty.warp(one.color, from, out);
    EXPECT_EQ(out.at(20, 20), 12345u);
}

}  // namespace
}  // namespace stereonav
