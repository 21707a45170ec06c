// Scenes whose rays have closed answers: planes, spheres and boxes with a smooth pattern, over a sky. They
// are computed one pixel at a time and without any shortcut, so that they can serve as the truth for the
// warp.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/glm.hpp>
#include <limits>
#include <vector>

#include "engine/camera/stereo_rig.h"
#include "engine/render/eye_renderer.h"

namespace stereonav::test {

struct SurfacePoint {
    double depth = std::numeric_limits<double>::infinity();  // ray parameter: the view depth
    glm::dvec3 point{0.0}, normal{0.0};
    int shape = -1;
};

using Shape = std::function<SurfacePoint(const glm::dvec3& origin, const glm::dvec3& direction)>;

inline Shape plane(const glm::dvec3& point, const glm::dvec3& normal) {
    return [=](const glm::dvec3& origin, const glm::dvec3& direction) {
        SurfacePoint hit;
        const double slope = glm::dot(direction, normal);
        const double t = glm::dot(point - origin, normal) / slope;
        if (slope != 0 && t > 0) hit = {t, origin + t * direction, glm::normalize(normal), 0};
        return hit;
    };
}

inline Shape sphere(const glm::dvec3& centre, double radius) {
    return [=](const glm::dvec3& origin, const glm::dvec3& direction) {
        SurfacePoint hit;
        const glm::dvec3 o = origin - centre;
        const double a = glm::dot(direction, direction), b = glm::dot(o, direction);
        const double root = b * b - a * (glm::dot(o, o) - radius * radius);
        const double t = (-b - std::sqrt(std::max(root, 0.0))) / a;
        if (root >= 0 && t > 0)
            hit = {t, origin + t * direction, (origin + t * direction - centre) / radius, 0};
        return hit;
    };
}

// Returns the shape that a ray hits where it leaves the sphere.
inline Shape sphereFromInside(const glm::dvec3& centre, double radius) {
    return [=](const glm::dvec3& origin, const glm::dvec3& direction) {
        SurfacePoint hit;
        const glm::dvec3 o = origin - centre;
        const double a = glm::dot(direction, direction), b = glm::dot(o, direction);
        const double root = b * b - a * (glm::dot(o, o) - radius * radius);
        const double t = (-b + std::sqrt(std::max(root, 0.0))) / a;
        if (root >= 0 && t > 0)
            hit = {t, origin + t * direction, (centre - origin - t * direction) / radius, 0};
        return hit;
    };
}

// Returns a box along the world's axes, by its slabs.
inline Shape box(const glm::dvec3& low, const glm::dvec3& high) {
    return [=](const glm::dvec3& origin, const glm::dvec3& direction) {
        SurfacePoint hit;
        double enter = 0, leave = std::numeric_limits<double>::infinity();
        glm::dvec3 normal(0.0);
        for (int axis = 0; axis < 3; ++axis) {
            if (direction[axis] == 0) {
                if (origin[axis] < low[axis] || origin[axis] > high[axis]) return hit;
                continue;
            }
            double t0 = (low[axis] - origin[axis]) / direction[axis];
            double t1 = (high[axis] - origin[axis]) / direction[axis];
            if (t0 > t1) std::swap(t0, t1);
            if (t0 > enter) {
                enter = t0;
                normal = glm::dvec3(0.0);
                normal[axis] = direction[axis] > 0 ? -1 : 1;
            }
            leave = std::min(leave, t1);
        }
        if (enter > 0 && enter <= leave) hit = {enter, origin + enter * direction, normal, 0};
        return hit;
    };
}

class AnalyticScene : public EyeRenderer {
public:
    explicit AnalyticScene(std::vector<Shape> shapes, double waves = 0.5, bool glossy = false)
        : mShapes(std::move(shapes)), mWaves(waves), mGlossy(glossy) {}

    SurfacePoint cast(const EyeView& view, double x, double y) const {
        const glm::dvec3 direction = view.rayDirection(x, y);
        SurfacePoint nearest;
        for (std::size_t i = 0; i < mShapes.size(); ++i) {
            SurfacePoint hit = mShapes[i](view.eye, direction);
            hit.shape = static_cast<int>(i);
            if (hit.depth >= view.nearDepth && hit.depth < nearest.depth) nearest = hit;
        }
        return nearest;
    }

    // Returns a smooth pattern of the place, with another hue for each shape; the sky depends on the
    // direction.
    glm::dvec3 baseColor(const EyeView& view, double x, double y, const SurfacePoint& hit) const {
        if (hit.shape < 0) {
            const glm::dvec3 d = glm::normalize(view.rayDirection(x, y));
            return 0.4 + 0.3 * glm::sin(glm::dvec3(3 * d.x, 4 * d.y, 5 * d.x + d.z));
        }
        const glm::dvec3 p = hit.point * mWaves;
        const double hue = hit.shape * 1.3;
        return 0.35 + 0.25 * glm::sin(glm::dvec3(p.x + hue, p.y + 2 * hue + p.z, p.x - p.z + 3 * hue));
    }

    // A highlight that moves with the eye: cubed cosine between normal and view.
    static glm::dvec3 gloss(const EyeView& view, const glm::dvec3& point, const glm::dvec3& normal) {
        const double cosine = glm::dot(glm::normalize(view.eye - point), normal);
        return glm::dvec3(0.35 * std::pow(std::abs(cosine), 12.0));
    }

    int tileCount(const EyeView& view) const override { return view.height; }

    void renderTile(const EyeView& view, int tile, EyeImage& image) const override {
        for (int x = 0; x < view.width; ++x) renderPixel(view, x, tile, image);
    }

    void renderPixels(const EyeView& view, PixelRect bounds, std::span<const PixelIndex> pixels,
                      EyeImage& image) const override {
        for (const PixelIndex p : pixels) {
            if (p.x < bounds.x0 || p.x >= bounds.x1 || p.y < bounds.y0 || p.y >= bounds.y1)
                throw std::logic_error("pixel outside its bounds");
            if (image.viewDepth.at(p.x, p.y) != 0) throw std::logic_error("a hole has a depth");
            renderPixel(view, p.x, p.y, image);
        }
    }

    bool mayHitBeyondEdge(const EyeView& view, PixelRect rect, double column,
                          double parallaxScale) const override {
        for (int y = rect.y0; y < rect.y1; ++y)
            for (int x = rect.x0; x < rect.x1; ++x) {
                const double edge = column - (x + 1);
                const double limit =
                    edge > 0 ? parallaxScale / edge : std::numeric_limits<double>::infinity();
                if (cast(view, x + 0.5, y + 0.5).depth < limit) return true;
            }
        return false;
    }

    ViewDependence viewDependence() const override {
        return mGlossy ? ViewDependence::Highlight : ViewDependence::None;
    }

    void shadeAgain(const EyeView& view, int y, int x0, int x1, EyeImage& image) const override {
        for (int x = x0; x < x1; ++x) {
            const glm::dvec3 point = view.pointAt(x + 0.5, y + 0.5, image.viewDepth.at(x, y));
            const glm::dvec3 base = unpackColor(image.baseColor.at(x, y));
            image.color.at(x, y) =
                packColor(glm::vec3(base + gloss(view, point, unpackNormal(image.normal.at(x, y)))));
        }
    }

    static std::uint32_t packNormal(const glm::dvec3& n) {
        glm::dvec2 p = glm::dvec2(n) / (std::abs(n.x) + std::abs(n.y) + std::abs(n.z));
        if (n.z < 0)
            p = (1.0 - glm::abs(glm::dvec2(p.y, p.x))) * glm::dvec2(p.x < 0 ? -1 : 1, p.y < 0 ? -1 : 1);
        const auto word = [](double v) { return static_cast<std::uint32_t>(std::lround((v + 1) * 32767.5)); };
        return word(p.x) | word(p.y) << 16;
    }

    static glm::dvec3 unpackNormal(std::uint32_t packed) {
        const glm::dvec2 p((packed & 0xffffu) / 32767.5 - 1, (packed >> 16) / 32767.5 - 1);
        glm::dvec3 n(p, 1 - std::abs(p.x) - std::abs(p.y));
        if (n.z < 0) {
            n.x = (1 - std::abs(p.y)) * (p.x < 0 ? -1 : 1);
            n.y = (1 - std::abs(p.x)) * (p.y < 0 ? -1 : 1);
        }
        return glm::normalize(n);
    }

protected:
    virtual void renderPixel(const EyeView& view, int x, int y, EyeImage& image) const {
        const SurfacePoint hit = cast(view, x + 0.5, y + 0.5);
        glm::dvec3 color = baseColor(view, x + 0.5, y + 0.5, hit);
        if (!image.baseColor.empty()) {
            image.baseColor.at(x, y) = packColor(glm::vec3(color));
            image.normal.at(x, y) = hit.shape < 0 ? 0 : packNormal(hit.normal);
        }
        if (mGlossy && hit.shape >= 0) color += gloss(view, hit.point, hit.normal);
        image.color.at(x, y) = packColor(glm::vec3(color));
        image.viewDepth.at(x, y) = static_cast<float>(hit.depth);
    }

private:
    std::vector<Shape> mShapes;
    double mWaves;  // radians per metre
    bool mGlossy;
};

// Surfaces of one colour under a lamp at the head, whose light falls off, with a highlight: colours follow
// from normal and depth alone (ViewDependence::Normal). The pattern is in the normals: bumps, like those of a
// slightly wavy surface. The sky is black.
class LitScene : public AnalyticScene {
public:
    explicit LitScene(std::vector<Shape> surfaces, double waves = 4, double bumps = 0.15)
        : AnalyticScene(std::move(surfaces)), mWaves(waves), mBumps(bumps) {}

    ViewDependence viewDependence() const override { return ViewDependence::Normal; }

    static glm::dvec3 lit(const EyeView& view, const glm::dvec3& point, const glm::dvec3& normal) {
        const glm::dvec3 toLamp = view.head - point, toEye = glm::normalize(view.eye - point);
        const double falloff = 1 / (1 + glm::dot(toLamp, toLamp) / 36);
        const double diffuse = std::max(0.0, glm::dot(glm::normalize(toLamp), normal));
        const glm::dvec3 half = glm::normalize(glm::normalize(toLamp) + toEye);
        const double gloss = std::pow(std::max(0.0, glm::dot(half, normal)), 24.0);
        return glm::min(falloff * ((0.1 + diffuse) * glm::dvec3(0.7, 0.5, 0.4) + 0.2 * gloss),
                        glm::dvec3(1.0));
    }

    void shadeAgain(const EyeView& view, int y, int x0, int x1, EyeImage& image) const override {
        for (int x = x0; x < x1; ++x) {
            const double depth = image.viewDepth.at(x, y);
            const glm::dvec3 point = view.pointAt(x + 0.5, y + 0.5, depth);
            glm::dvec3 color(0.0);
            if (depth > 0 && std::isfinite(depth))
                color = lit(view, point, glm::normalize(normalOf(image.normal.at(x, y))));
            image.color.at(x, y) = packColor(glm::vec3(color));
        }
    }

    static std::uint32_t packed(const glm::dvec3& normal) {
        const auto word = [](double v) { return static_cast<std::uint32_t>(std::lround((v + 1) * 511.5)); };
        return word(normal.x) | word(normal.y) << 10 | word(normal.z) << 20;
    }
    static glm::dvec3 normalOf(std::uint32_t packed) {
        return glm::dvec3(packed & 1023u, packed >> 10 & 1023u, packed >> 20 & 1023u) / 511.5 - 1.0;
    }

protected:
    void renderPixel(const EyeView& view, int x, int y, EyeImage& image) const override {
        const SurfacePoint hit = cast(view, x + 0.5, y + 0.5);
        const bool met = hit.shape >= 0;
        const glm::dvec3 bump = mBumps * glm::sin(mWaves * glm::dvec3(hit.point.y, hit.point.z, hit.point.x));
        const std::uint32_t normal = met ? packed(glm::normalize(hit.normal + bump)) : 0;
        if (!image.normal.empty()) image.normal.at(x, y) = normal;
        const glm::dvec3 color =
            met ? lit(view, hit.point, glm::normalize(normalOf(normal))) : glm::dvec3(0.0);
        image.color.at(x, y) = packColor(glm::vec3(color));
        image.viewDepth.at(x, y) = static_cast<float>(hit.depth);
    }

private:
    double mWaves, mBumps;  // radians per metre; share of the normal
};

// Glass before an opaque wall: rays meet thin layers, each of which takes a share of the light that grows
// towards grazing incidence. In closed form; a shell is met twice: sphere and sphereFromInside.
class GlassScene : public AnalyticScene {
public:
    GlassScene(std::vector<Shape> glass, Shape wall, double waves = 0.5, double opacity = 0.35)
        : AnalyticScene(all(glass, wall), waves),
          mGlass(std::move(glass)),
          mWall(std::move(wall)),
          mOpacity(opacity) {}

    bool translucent() const override { return true; }
    ViewDependence viewDependence() const override { return ViewDependence::Depths; }

    void renderTileFromDepth(const EyeView& view, int tile, EyeImage& image) const override {
        for (int x = 0; x < view.width; ++x) {
            const double from = image.viewDepth.at(x, tile);
            composite(view, x, tile, from, image);
        }
    }

protected:
    void renderPixel(const EyeView& view, int x, int y, EyeImage& image) const override {
        composite(view, x, y, 0, image);
    }

private:
    static std::vector<Shape> all(std::vector<Shape> glass, const Shape& wall) {
        glass.push_back(wall);
        return glass;
    }

    // Composites only the layers at `from` and behind it, which a ray that starts there meets.
    void composite(const EyeView& view, int x, int y, double from, EyeImage& image) const {
        const glm::dvec3 direction = view.rayDirection(x + 0.5, y + 0.5);
        std::vector<SurfacePoint> layers;
        const double nearest = std::max(from, view.nearDepth);
        const auto meet = [&](const Shape& shape, int index) {
            SurfacePoint hit = shape(view.eye, direction);
            hit.shape = index;
            if (hit.depth < kMissDepth && hit.depth >= nearest) layers.push_back(hit);
        };
        for (std::size_t k = 0; k < mGlass.size(); ++k) meet(mGlass[k], static_cast<int>(k));
        const int wall = static_cast<int>(mGlass.size());
        meet(mWall, wall);
        std::sort(layers.begin(), layers.end(),
                  [](const SurfacePoint& a, const SurfacePoint& b) { return a.depth < b.depth; });
        glm::dvec3 color(0.0);
        double through = 1, square = 0;
        for (const SurfacePoint& layer : layers) {
            const double slope = std::abs(glm::dot(layer.normal, glm::normalize(direction)));
            const double share = layer.shape == wall ? 1.0 : 1 - std::pow(1 - mOpacity, 1 / (0.1 + slope));
            color += through * share * baseColor(view, x + 0.5, y + 0.5, layer);
            const double behind = layer.depth - layers.front().depth;
            square += through * share * behind * behind;
            through *= 1 - share;
        }
        if (!image.depthSpread.empty())
            image.depthSpread.at(x, y) =
                through < 1 ? static_cast<float>(std::sqrt(square / (1 - through))) : 0.0f;
        color += through * baseColor(view, x + 0.5, y + 0.5, SurfacePoint{});
        image.color.at(x, y) = packColor(glm::vec3(color));
        image.viewDepth.at(x, y) = layers.empty() ? kMissDepth : static_cast<float>(layers.front().depth);
    }

    std::vector<Shape> mGlass;
    Shape mWall;
    double mOpacity;
};

// Returns an eye image cast in full.
inline EyeImage castEye(const EyeRenderer& renderer, const EyeView& view) {
    EyeImage image;
    image.resize(view.width, view.height, renderer.viewDependence());
    renderEye(renderer, view, image);
    return image;
}

}  // namespace stereonav::test
