#include "terrain/paint/track_painter.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/base/parallel.h"
#include "terrain/paint/ground_view.h"

namespace stereonav {
namespace {

constexpr int kBandRows = 16;
constexpr double kMostSag = 0.3;                            // pixels that a chord may leave the ground by
constexpr int kMostChords = 64;                             // chords of one cell
constexpr double kMarkRing = 2;                             // pixels of a mark's dark ring
constexpr double kMostApart = 1.5, kMostApartShare = 0.25;  // pixels by which both distances may differ

// A chord as the eye sees it.
struct ScreenChord {
    glm::dvec2 a, b;      // pixels
    glm::dvec2 from, to;  // world
    bool mark = false;
};

double reachOf(const ScreenChord& chord) {
    return (chord.mark ? kMarkRadius : 0.5 * kTrackCasing) + 1;
}

// Distance of the origin from a piece, in the piece's units.
double distanceFromOrigin(const glm::dvec2& a, const glm::dvec2& b) {
    const glm::dvec2 way = b - a;
    const double square = glm::dot(way, way);
    const double t = square > 0 ? std::clamp(-glm::dot(a, way) / square, 0.0, 1.0) : 0;
    return glm::length(a + t * way);
}

double trackCover(double halfWidth, double distance) {
    return std::clamp(halfWidth + 0.5 - distance, 0.0, 1.0);
}

// Cuts a piece at the near plane. Returns false where all of it lies before that.
bool cutAtNear(const EyeView& view, glm::dvec3& a, glm::dvec3& b) {
    const double da = glm::dot(a - view.eye, view.forward), db = glm::dot(b - view.eye, view.forward);
    if (!(da >= view.nearDepth) && !(db >= view.nearDepth)) return false;
    if (da < view.nearDepth) a = glm::mix(a, b, (view.nearDepth - da) / (db - da));
    if (db < view.nearDepth) b = glm::mix(b, a, (view.nearDepth - db) / (da - db));
    return true;
}

// Shares of a pixel that the line covers, and that the line with its casing covers.
struct TrackShares {
    float line = 0, casing = 0;
};

// Returns whether a pixel shows the ground that the projected piece lies on. screen: pixels between them.
bool showsPiece(const GroundView& ground, const EyeImage& image, const ScreenChord& chord, int x, int y,
                double screen) {
    GroundSeen seen;
    if (!ground.at(x, y, image.viewDepth.at(x, y), seen)) return false;
    // From the plan to pixels: the inverse of how the place moves from pixel to pixel.
    const glm::dvec2 i(seen.perX), j(seen.perY);
    const double area = i.x * j.y - i.y * j.x;
    if (area == 0) return false;
    const auto inPixels = [&](const glm::dvec2& world) {
        const glm::dvec2 off = world - glm::dvec2(seen.place);
        return glm::dvec2(off.x * j.y - off.y * j.x, i.x * off.y - i.y * off.x) / area;
    };
    const double distance = distanceFromOrigin(inPixels(chord.from), inPixels(chord.to));
    return std::abs(distance - screen) <= kMostApart + kMostApartShare * screen;
}

// Returns whether a mark shows: any pixel around its middle does.
bool showsMark(const GroundView& ground, const EyeImage& image, const ScreenChord& chord) {
    const int x0 = static_cast<int>(std::floor(std::clamp(chord.a.x, -2.0, image.width() + 2.0))),
              y0 = static_cast<int>(std::floor(std::clamp(chord.a.y, -2.0, image.height() + 2.0)));
    for (int y = std::max(0, y0 - 1); y <= std::min(image.height() - 1, y0 + 1); ++y)
        for (int x = std::max(0, x0 - 1); x <= std::min(image.width() - 1, x0 + 1); ++x) {
            const double screen = glm::length(chord.a - glm::dvec2(x + 0.5, y + 0.5));
            if (showsPiece(ground, image, chord, x, y, screen)) return true;
        }
    return false;
}

class TrackBand {
public:
    TrackBand(const GroundView& ground, const EyeImage& image, int firstRow, int endRow)
        : mGround(ground), mImage(image), mFirst(firstRow), mEnd(endRow) {}

    void add(const ScreenChord& chord) {
        const double reach = reachOf(chord);
        const auto within = [](double at, int most) {
            return static_cast<int>(std::clamp(std::floor(at), -1.0, double(most)));
        };
        const int x0 = std::max(0, within(std::min(chord.a.x, chord.b.x) - reach, mImage.width())),
                  x1 = within(std::max(chord.a.x, chord.b.x) + reach, mImage.width() - 1),
                  y0 = std::max(mFirst, within(std::min(chord.a.y, chord.b.y) - reach, mEnd)),
                  y1 = within(std::max(chord.a.y, chord.b.y) + reach, mEnd - 1);
        for (int y = y0; y <= y1; ++y)
            for (int x = x0; x <= x1; ++x) {
                const glm::dvec2 pixel(x + 0.5, y + 0.5);
                const double screen = distanceFromOrigin(chord.a - pixel, chord.b - pixel);
                if (screen < reach) addPixel(chord, x, y, screen);
            }
    }

    bool empty() const { return mShares.empty(); }
    const TrackShares& at(int x, int y) const { return mShares[indexOf(x, y)]; }

private:
    std::size_t indexOf(int x, int y) const {
        return static_cast<std::size_t>(y - mFirst) * static_cast<std::size_t>(mImage.width()) +
               static_cast<std::size_t>(x);
    }
    void addPixel(const ScreenChord& chord, int x, int y, double screen) {
        const double casing = trackCover(chord.mark ? kMarkRadius : 0.5 * kTrackCasing, screen);
        if (casing <= 0 || (!chord.mark && !showsPiece(mGround, mImage, chord, x, y, screen))) return;
        const double line = trackCover(chord.mark ? kMarkRadius - kMarkRing : 0.5 * kTrackWidth, screen);
        if (mShares.empty()) mShares.resize(indexOf(0, mEnd));
        TrackShares& shares = mShares[indexOf(x, y)];
        shares.line = std::max(shares.line, static_cast<float>(line));
        shares.casing = std::max(shares.casing, static_cast<float>(casing));
    }

    const GroundView& mGround;
    const EyeImage& mImage;
    int mFirst, mEnd;
    std::vector<TrackShares> mShares;  // empty until there is any
};

}  // namespace

TrackPainter::TrackPainter(const Heightfield& ground, const Fog& fog,
                           const std::vector<std::vector<glm::dvec2>>& lines,
                           const std::vector<glm::dvec2>& places)
    : mGround(ground), mFog(fog) {
    for (const auto& line : lines)
        for (std::size_t n = 0; n + 1 < line.size(); ++n) addLine(line[n], line[n + 1]);
    for (const glm::dvec2& place : places) {
        if (!ground.contains(place)) continue;
        const double height = ground.heightAt(place);
        if (!std::isfinite(height)) continue;
        mPieces.push_back({{place, height}, {place, height}, 0, true});
    }
}

void TrackPainter::addLine(const glm::dvec2& from, const glm::dvec2& to) {
    const double length = glm::length(to - from);
    if (!(length > 0) || !std::isfinite(length)) return;
    mLength += length;
    // The part over the ground, then the crossings of the samples' rows and columns.
    const glm::dvec2 a = mGround.gridFromWorld(from), way = mGround.gridFromWorld(to) - a,
                     last(mGround.width() - 1, mGround.height() - 1);
    double begin = 0, end = 1;
    for (int axis = 0; axis < 2; ++axis) {
        if (way[axis] == 0) {
            if (!(a[axis] >= 0 && a[axis] <= last[axis])) end = -1;
            continue;
        }
        const double t0 = -a[axis] / way[axis], t1 = (last[axis] - a[axis]) / way[axis];
        begin = std::max(begin, std::min(t0, t1));
        end = std::min(end, std::max(t0, t1));
    }
    if (!(begin < end)) {
        mOutside += length;
        return;
    }
    std::vector<double> cuts{begin, end};
    for (int axis = 0; axis < 2; ++axis) {
        if (way[axis] == 0) continue;
        const double p = a[axis] + begin * way[axis], q = a[axis] + end * way[axis];
        for (double k = std::ceil(std::min(p, q)); k <= std::max(p, q); ++k)
            cuts.push_back(std::clamp((k - a[axis]) / way[axis], begin, end));
    }
    std::sort(cuts.begin(), cuts.end());
    double drawn = 0;
    const auto placeAt = [&](double t) {
        const glm::dvec2 world = glm::mix(from, to, t);
        return glm::dvec3(world, mGround.heightAt(world));
    };
    for (std::size_t n = 0; n + 1 < cuts.size(); ++n) {
        if (!(cuts[n] < cuts[n + 1])) continue;
        const glm::dvec3 p = placeAt(cuts[n]), q = placeAt(cuts[n + 1]),
                         between = placeAt(0.5 * (cuts[n] + cuts[n + 1]));
        if (!std::isfinite(p.z + q.z + between.z)) continue;
        mPieces.push_back({p, q, std::abs(between.z - 0.5 * (p.z + q.z)), false});
        drawn += cuts[n + 1] - cuts[n];
    }
    mOutside += std::max(0.0, 1 - drawn) * length;
}

void TrackPainter::paint(const EyeView& view, EyeImage& image) const {
    if (mPieces.empty() || image.viewDepth.empty()) return;
    const GroundView ground(mGround, view);
    std::vector<ScreenChord> chords;
    const double perPixel = std::min(view.pixelWidth(), view.pixelHeight());
    const EarthBend bend = view.bend();
    for (const Piece& piece : mPieces) {
        glm::dvec3 a = bend.apparent(piece.from), b = bend.apparent(piece.to);
        if (!cutAtNear(view, a, b)) continue;
        // Chords follow the ground's parabola as finely as it is seen.
        const double nearest = std::max(view.nearDepth, std::min(glm::dot(a - view.eye, view.forward),
                                                                 glm::dot(b - view.eye, view.forward)));
        const double sag = piece.sag / (nearest * perPixel);
        const int count =
            static_cast<int>(std::clamp(std::ceil(std::sqrt(sag / kMostSag)), 1.0, double(kMostChords)));
        a = bend.placeOf(a), b = bend.placeOf(b);
        glm::dvec3 before = a;
        for (int n = 1; n <= count; ++n) {
            glm::dvec3 after = glm::mix(a, b, double(n) / count);
            if (n < count) after.z = mGround.heightAt(glm::dvec2(after));
            glm::dvec3 p = bend.apparent(before), q = bend.apparent(after);
            before = after;
            if (!cutAtNear(view, p, q)) continue;
            const ScreenChord chord{glm::dvec2(view.project(p)), glm::dvec2(view.project(q)), glm::dvec2(p),
                                    glm::dvec2(q), piece.mark};
            const double reach = reachOf(chord);
            const glm::dvec2 low = glm::min(chord.a, chord.b) - reach,
                             high = glm::max(chord.a, chord.b) + reach;
            // Written so that NaN counts as outside.
            if (!(high.x > 0 && high.y > 0 && low.x < view.width && low.y < view.height)) continue;
            if (!chord.mark || showsMark(ground, image, chord)) chords.push_back(chord);
        }
    }
    const glm::vec3 ink(kTrackInk[0], kTrackInk[1], kTrackInk[2]);
    const int bands = (image.height() + kBandRows - 1) / kBandRows;
    parallelFor(bands, [&](int band) {
        const int first = band * kBandRows, end = std::min(image.height(), first + kBandRows);
        TrackBand shares(ground, image, first, end);
        for (const ScreenChord& chord : chords) shares.add(chord);
        if (shares.empty()) return;
        for (int y = first; y < end; ++y)
            for (int x = 0; x < image.width(); ++x) {
                const TrackShares& share = shares.at(x, y);
                if (share.casing <= 0) continue;
                const double t = image.viewDepth.at(x, y);
                const glm::dvec3 ray = bend.wayToPlace(view.eye, view.rayDirection(x + 0.5, y + 0.5), t);
                PackedColor& color = image.color.at(x, y);
                glm::vec3 seen = unpackColor(color);
                seen = glm::mix(seen, mFog.seen(glm::vec3(0.0f), view.eye, ray, t),
                                static_cast<float>(kCasingShare) * share.casing);
                seen = glm::mix(seen, mFog.seen(ink, view.eye, ray, t), share.line);
                color = packColor(seen);
            }
    });
}

}  // namespace stereonav
