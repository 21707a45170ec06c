// The interface between engine and scene: a scene answers rays, and does not know that there are two eyes.
// Calls are coarse (a tile, a batch), const, and may run on several threads at once as long as their pixels
// differ. Results do not depend on the thread count.
#pragma once

#include <cstdint>
#include <span>

#include "engine/camera/eye_view.h"
#include "engine/image/eye_image.h"

namespace stereonav {

// Pixels of a picture, (0, 0) top left.
struct PixelRect {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;  // x0 <= x < x1, y0 <= y < y1
    int width() const { return x1 - x0; }
    int height() const { return y1 - y0; }
};

// A pixel of a picture, (0, 0) top left.
struct PixelIndex {
    std::uint16_t x, y;
};

// A scene for rays. View depths are metres.
class EyeRenderer {
public:
    virtual ~EyeRenderer() = default;

    // Prepares for pictures from these two eyes: choices that depend on their place (the level of detail) are
    // made now, and stay for both. Not to be called while a picture is cast.
    virtual void lookFrom(const EyeView& /*left*/, const EyeView& /*right*/) const {}
    // Does the same for pictures from one eye.
    void lookFrom(const EyeView& eye) const { lookFrom(eye, eye); }

    // The scene chooses how a picture is cut into tiles (bands of columns for terrain). Together the
    // tiles 0 .. tileCount(view) - 1 cover every pixel once.
    virtual int tileCount(const EyeView& view) const = 0;
    // Casts one tile into `image`, which has the view's size: every plane the image has is written.
    virtual void renderTile(const EyeView& view, int tile, EyeImage& image) const = 0;

    // Casts scattered pixels, all inside `bounds`; batches that run at the same time have disjoint
    // bounds. Within `bounds` the image's viewDepth tells what is known of the scene already (0:
    // nothing), from which the scene may conclude where a ray can start; outside `bounds` it must
    // not be read. `pixels` is in row-major order, top row first, without repeats.
    virtual void renderPixels(const EyeView& view, PixelRect bounds, std::span<const PixelIndex> pixels,
                              EyeImage& image) const = 0;

    // Casts more rays through pixels, and writes no others. `view` is `known` with its window moved by less
    // than a pixel, and `depths` are the known depths of `known`, cast or warped, from which the scene may
    // conclude where a ray can start. Otherwise like renderPixels, except that viewDepth of `image` is 0
    // inside `bounds`.
    virtual void renderMoreRays(const EyeView& view, const EyeView& known, const Plane<float>& depths,
                                PixelRect bounds, std::span<const PixelIndex> pixels, EyeImage& image) const {
        (void)known, (void)depths;
        renderPixels(view, bounds, pixels, image);
    }

    // Returns whether renderPixels needs, in the viewDepth of each pixel that it casts, a depth before which
    // the ray meets nothing (0: unknown), as known from the other eye (W9 of docs/ledger.md). The depths of
    // other pixels have no meaning then.
    virtual bool startsAtKnownDepth() const { return false; }

    // Returns false only if no ray through the rectangle hits anything before its view depth maxDepth(x) =
    // parallaxScale / (column - x) for x the pixel's right edge (infinite where x >= column): the part of the
    // ray that lies outside the other eye's window edge (region V of Wan et al. 2004, fig. 2). Conservative:
    // true may mean nothing is there.
    virtual bool mayHitBeyondEdge(const EyeView& view, PixelRect rect, double column,
                                  double parallaxScale) const = 0;
    // Answers as mayHitBeyondEdge() does, for rectangles within each other. freeDepth: a view depth up to
    // which no ray through the rectangle hits anything (0: unknown); this call may raise it, and then it is
    // valid for every part of the rectangle.
    virtual bool mayHitBeyondEdgeFrom(const EyeView& view, PixelRect rect, double column,
                                      double parallaxScale, double& freeDepth) const {
        (void)freeDepth;
        return mayHitBeyondEdge(view, rect, column, parallaxScale);
    }

    // Returns whether, and from what, colours have to be evaluated again for the other eye. Images with those
    // planes get them written by the calls above.
    virtual ViewDependence viewDependence() const { return ViewDependence::None; }
    // Returns whether colours are evaluated again by shadeAgain.
    bool viewDependent() const {
        return viewDependence() == ViewDependence::Highlight || viewDependence() == ViewDependence::Normal;
    }
    // Replaces `color` in row y, columns x0 .. x1 - 1 as seen by `view`, from baseColor, normal and
    // viewDepth, or from normal and viewDepth alone. Called only where viewDependent(). With Highlight
    // the run is all surface. With Normal it is a whole row: pixels that met nothing (kMissDepth) get the
    // background, those of which nothing is known (viewDepth 0) any colour or none; the normals of both
    // mean nothing, those of the others may be shorter than a unit.
    virtual void shadeAgain(const EyeView& view, int y, int x0, int x1, EyeImage& image) const {
        (void)view, (void)y, (void)x0, (void)x1, (void)image;
    }

    // Returns whether the air in front of surfaces differs visibly between two eyes that are `separation`
    // metres apart.
    virtual bool airDiffers(double separation) const {
        (void)separation;
        return false;
    }
    // Changes `color` in row y of a picture of `view`, whose colours were seen by `from`, to what `view` sees
    // through its own air, from viewDepth; pixels where that is 0 may get any colour. Called where
    // airDiffers() and colours are not evaluated again by shadeAgain.
    virtual void changeAir(const EyeView& from, const EyeView& view, int y, EyeImage& image) const {
        (void)from, (void)view, (void)y, (void)image;
    }

    // Returns whether a pixel's colour is gathered from several depths, so that it can not be warped as a
    // whole. viewDepth is then the depth at which the ray first meets something.
    virtual bool translucent() const { return false; }
    // Casts a tile as renderTile does, but image.viewDepth holds, for each pixel, a depth before which
    // nothing is expected (0: unknown, kMissDepth: nothing at all), where the ray may start (W12; Wan et al.
    // 2004, section 4). A result like renderTile's is correct too, only slower.
    virtual void renderTileFromDepth(const EyeView& view, int tile, EyeImage& image) const {
        renderTile(view, tile, image);
    }
};

// Casts the whole picture with all threads. The image must have the view's size.
void renderEye(const EyeRenderer& renderer, const EyeView& view, EyeImage& image);

}  // namespace stereonav
