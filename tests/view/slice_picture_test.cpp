// Slices of a study as pictures: the right way round, with square millimetres, and clicks at the visible
// place.
#include "app/view/slice_picture.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace stereonav {
namespace {

// Returns 20 x 30 x 10 voxels of 1 x 1 x 4 mm, patient's axes; the value encodes the voxel.
GreyVolume numbered(const VolumeFrame& frame) {
    GreyVolume grey(frame);
    for (int k = 0; k < frame.size.z; ++k)
        for (int j = 0; j < frame.size.y; ++j)
            for (int i = 0; i < frame.size.x; ++i)
                grey.at(i, j, k) = static_cast<std::int16_t>(i + 20 * j + 600 * k);
    return grey;
}

VolumeFrame upright() {
    VolumeFrame frame;
    frame.size = {20, 30, 10};
    frame.spacing = {0.001, 0.001, 0.004};
    frame.origin = {-0.05, 0.1, -0.2};
    return frame;
}

constexpr SliceAxis kAxes[] = {SliceAxis::Axial, SliceAxis::Coronal, SliceAxis::Sagittal};

TEST(SliceLayout, MillimetresAreSquareAndTheSliceFits) {
    for (const SliceAxis axis : kAxes)
        for (const glm::ivec2 size : {glm::ivec2(300, 200), glm::ivec2(100, 500), glm::ivec2(1, 1)}) {
            const VolumeFrame frame = upright();
            const SliceLayout layout(frame, axis, size.x, size.y);
            for (const glm::dvec2 at : {glm::dvec2(0.3, 0.4), glm::dvec2(0.5, 0.5), glm::dvec2(0.6, 0.7)}) {
                const glm::dvec2 p = at * glm::dvec2(size);
                const auto world = [&](glm::dvec2 q) {
                    return frame.worldFromVoxel(layout.voxelAt(q.x, q.y, 3));
                };
                const double right = glm::length(world(p + glm::dvec2(1, 0)) - world(p));
                const double down = glm::length(world(p + glm::dvec2(0, 1)) - world(p));
                EXPECT_NEAR(right, down, 1e-12);
                const glm::dvec2 back = layout.pixelOf(layout.voxelAt(p.x, p.y, 3));
                EXPECT_NEAR(back.x, p.x, 1e-9);
                EXPECT_NEAR(back.y, p.y, 1e-9);
            }
            for (const glm::dvec3& corner : {glm::dvec3(-0.5), glm::dvec3(frame.size) - 0.5}) {
                const glm::dvec2 p = layout.pixelOf(corner);
                EXPECT_GE(p.x, -1e-9);
                EXPECT_LE(p.x, size.x + 1e-9);
                EXPECT_GE(p.y, -1e-9);
                EXPECT_LE(p.y, size.y + 1e-9);
            }
        }
}

// Orientation in radiology: axial seen from the feet, the patient's left on the right and the back at the
// bottom; coronal and sagittal with the head up.
TEST(SliceLayout, ThePatientLiesAsRadiologyShowsHim) {
    VolumeFrame mirrored =
        upright();  // the same place, stored from left to right, back to front, head to feet
    mirrored.axes = glm::dmat3(-1.0);
    mirrored.origin = -mirrored.origin;
    VolumeFrame turned = upright();  // stored sagittally: i runs to the back, j to the head, k to the left
    turned.axes = glm::dmat3(glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1), glm::dvec3(1, 0, 0));
    for (const VolumeFrame& frame : {upright(), mirrored, turned}) {
        const glm::dvec3 middle = frame.worldFromVoxel(0.5 * glm::dvec3(frame.size - 1));
        const auto moves = [&](SliceAxis axis, const glm::dvec3& by) {
            const SliceLayout layout(frame, axis, 200, 200);
            return layout.pixelOf(frame.voxelFromWorld(middle + by)) -
                   layout.pixelOf(frame.voxelFromWorld(middle));
        };
        const glm::dvec3 left(0.002, 0, 0), back(0, 0.002, 0), head(0, 0, 0.002);
        EXPECT_GT(moves(SliceAxis::Axial, left).x, 1);
        EXPECT_GT(moves(SliceAxis::Axial, back).y, 1);
        EXPECT_NEAR(glm::length(moves(SliceAxis::Axial, head)), 0, 1e-9);
        EXPECT_GT(moves(SliceAxis::Coronal, left).x, 1);
        EXPECT_LT(moves(SliceAxis::Coronal, head).y, -1);
        EXPECT_GT(moves(SliceAxis::Sagittal, back).x, 1);
        EXPECT_LT(moves(SliceAxis::Sagittal, head).y, -1);
        EXPECT_NEAR(glm::length(moves(SliceAxis::Sagittal, left)), 0, 1e-9);
    }
}

TEST(SliceLayout, AClickFindsTheVoxelThatIsSeen) {
    const VolumeFrame frame = upright();
    for (const SliceAxis axis : kAxes) {
        const SliceLayout layout(frame, axis, 400, 300);
        for (const glm::ivec3 voxel : {glm::ivec3(0), glm::ivec3(7, 11, 4), frame.size - 1}) {
            const glm::dvec3 world = frame.worldFromVoxel(glm::dvec3(voxel));
            const int slice = layout.sliceAt(world);
            EXPECT_EQ(slice, voxel[layout.normal()]);
            const glm::dvec2 p = layout.pixelOf(glm::dvec3(voxel));
            const auto clicked = layout.worldAt(p.x, p.y, slice);
            ASSERT_TRUE(clicked.has_value());
            EXPECT_NEAR(glm::length(*clicked - world), 0, 1e-12);
        }
        EXPECT_FALSE(layout.worldAt(-1000, 150, 0).has_value());
        EXPECT_FALSE(layout.worldAt(200, 150, layout.sliceCount()).has_value());
        EXPECT_EQ(layout.sliceAt(glm::dvec3(1e9)), layout.sliceCount() - 1);
        EXPECT_EQ(layout.sliceAt(glm::dvec3(-1e9)), 0);
        EXPECT_EQ(layout.sliceAt(glm::dvec3(std::numeric_limits<double>::quiet_NaN())), 0);
    }
    EXPECT_NEAR(SliceLayout(frame, SliceAxis::Axial, 9, 9).placeOf(2), -200 + 2 * 4, 1e-9);
    EXPECT_NEAR(SliceLayout(frame, SliceAxis::Coronal, 9, 9).placeOf(2), 100 + 2, 1e-9);
    EXPECT_NEAR(SliceLayout(frame, SliceAxis::Sagittal, 9, 9).placeOf(2), -50 + 2, 1e-9);
}

int byteAt(const Plane<PackedColor>& picture, const glm::dvec2& p) {
    const PackedColor c = picture.at(static_cast<int>(p.x), static_cast<int>(p.y));
    return srgbByteFromPacked()[c & 1023];
}

TEST(SlicePicture, GreyValuesGoThroughTheWindow) {
    GreyVolume grey(upright());
    for (std::size_t n = 0; n < grey.frame.count(); ++n) grey.values[n] = 1000;
    const SliceLayout layout(grey.frame, SliceAxis::Axial, 100, 100);
    const auto byteOf = [&](double width, double level) {
        return byteAt(drawSlice({&grey, width, level, nullptr, {}}, layout, 5, 100, 100), {50, 50});
    };
    EXPECT_EQ(byteOf(1500, 5000), 0);
    EXPECT_EQ(byteOf(1500, -200), 255);
    EXPECT_NEAR(byteOf(1000, 1000), 128, 1);
    EXPECT_NEAR(byteOf(1000, 1250), 64, 1);
    grey.scale = 0.5;
    grey.offset = 750;  // 1250
    EXPECT_NEAR(byteOf(1000, 1000), 191, 1);
    const auto picture = drawSlice({&grey, 1500, -200, nullptr, {}}, layout, 5, 100, 100);
    EXPECT_EQ(byteAt(picture, {1, 50}), 0) << "beside the slice, which is narrow";
}

TEST(SlicePicture, VoxelsLieWhereTheLayoutSays) {
    const GreyVolume grey = numbered(upright());
    for (const SliceAxis axis : kAxes) {
        const SliceLayout layout(grey.frame, axis, 500, 500);
        for (const glm::ivec3 v : {glm::ivec3(3, 4, 5), glm::ivec3(12, 25, 8)}) {
            // Values are linear in the voxel, so that they are known at the pixel's own centre as well.
            const glm::dvec2 p = glm::floor(layout.pixelOf(glm::dvec3(v))) + 0.5;
            const glm::dvec3 at = layout.voxelAt(p.x, p.y, v[layout.normal()]);
            EXPECT_LT(glm::length(at - glm::dvec3(v)), 0.2);
            const double value = at.x + 20 * at.y + 600 * at.z;
            const auto picture =
                drawSlice({&grey, 40, value, nullptr, {}}, layout, v[layout.normal()], 500, 500);
            EXPECT_NEAR(byteAt(picture, p), 128, 1);
        }
    }
}

TEST(SlicePicture, TheLumenIsOutlinedWhereverItsFrameLies) {
    GreyVolume grey(upright());
    // A lumen in a frame of its own: a block of 6 x 8 mm, through all slices.
    VolumeFrame frame;
    frame.size = {12, 16, 40};
    frame.spacing = glm::dvec3(0.0005, 0.0005, 0.001);
    frame.origin = grey.frame.worldFromVoxel({5, 10, 0});
    MaskVolume lumen(frame);
    for (std::size_t n = 0; n < frame.count(); ++n) lumen.values[n] = 2;
    const SliceLayout layout(grey.frame, SliceAxis::Axial, 300, 300);
    const auto picture = drawSlice({&grey, 1500, -5000, &lumen, {}}, layout, 4, 300, 300);
    const auto plain = drawSlice({&grey, 1500, -5000, nullptr, {}}, layout, 4, 300, 300);
    int marked = 0;
    for (int y = 0; y < 300; ++y)
        for (int x = 0; x < 300; ++x) {
            if (picture.at(x, y) == plain.at(x, y)) continue;
            ++marked;
            const glm::dvec3 v = layout.voxelAt(x + 0.5, y + 0.5, 4);
            const double dx = std::min(std::abs(v.x - 4.75), std::abs(v.x - 10.75));
            const double dy = std::min(std::abs(v.y - 9.75), std::abs(v.y - 17.75));
            EXPECT_LT(std::min(dx, dy), 0.25) << x << ' ' << y;
        }
    // The outline has twice 6 and 8 mm at 10 pixels a millimetre.
    EXPECT_NEAR(marked, 2 * (60 + 80), 8);
}

TEST(SlicePicture, MarksFadeAndEndWithTheDistanceOfTheirSlice) {
    const GreyVolume grey(upright());
    const SliceLayout layout(grey.frame, SliceAxis::Axial, 300, 300);
    constexpr PackedColor kRed = 1023;
    const auto colourOf = [&](double slicesAway, bool ring) {
        const glm::dvec3 voxel(10, 15, 5 + slicesAway);
        const SliceMark mark{grey.frame.worldFromVoxel(voxel), kRed, ring};
        const auto picture = drawSlice({&grey, 1500, 5000, nullptr, {mark}}, layout, 5, 300, 300);
        const glm::dvec2 p = layout.pixelOf(voxel) + glm::dvec2(ring ? 7 : 3, 0);
        return picture.at(static_cast<int>(p.x), static_cast<int>(p.y)) & 1023;
    };
    for (const bool ring : {false, true}) {
        EXPECT_EQ(colourOf(0, ring), 1023u);
        EXPECT_GT(colourOf(3, ring), 100u);
        EXPECT_LT(colourOf(3, ring), 1000u);
        EXPECT_EQ(colourOf(20, ring), 0u);
    }
    const SliceMark astray{glm::dvec3(std::numeric_limits<double>::quiet_NaN()), kRed, false};
    const SliceMark beside{glm::dvec3(1e6), kRed, true};
    EXPECT_EQ(drawSlice({&grey, 1500, 5000, nullptr, {astray, beside}}, layout, 5, 30, 30).at(15, 15), 0u);
}

// Computes the picture from the layout's own places, pixel by pixel.
PackedColor plainPixel(const SliceContent& content, const SliceLayout& layout, int slice, int x, int y) {
    const GreyVolume& grey = *content.grey;
    if (!layout.worldAt(x + 0.5, y + 0.5, slice)) return 0;
    const glm::dvec3 voxel = layout.voxelAt(x + 0.5, y + 0.5, slice);
    double sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
        glm::ivec3 v(glm::floor(voxel));
        double weight = 1;
        for (int k = 0; k < 3; ++k) {
            const double share = voxel[k] - std::floor(voxel[k]);
            const bool behind = (corner >> k & 1) != 0;
            weight *= behind ? share : 1 - share;
            v[k] += behind;
        }
        sum += weight * grey.at(glm::clamp(v, glm::ivec3(0), grey.frame.size - 1));
    }
    const double value = sum * grey.scale + grey.offset;
    const double black = content.windowLevel - content.windowWidth / 2;
    const double byte = std::clamp((value - black) / content.windowWidth, 0.0, 1.0) * 255 + 0.5;
    const PackedColor channel = packedFromSrgbByte()[static_cast<std::size_t>(byte)];
    return channel | channel << 10 | channel << 20;
}

TEST(DrawSlice, IsThePlainOneInEveryDirectionAndSize) {
    VolumeFrame frame = upright();
    for (int turned = 0; turned < 2; ++turned) {
        if (turned) {  // axes exchanged and one of them reversed, as scanners store them
            frame.axes[0] = {0, 0, -1};
            frame.axes[1] = {1, 0, 0};
            frame.axes[2] = {0, 1, 0};
        }
        GreyVolume grey = numbered(frame);
        grey.scale = 0.5;
        grey.offset = -100;
        SliceContent content;
        content.grey = &grey;
        content.windowWidth = 3000;
        content.windowLevel = 1400;
        for (const SliceAxis axis : kAxes)
            for (const glm::ivec2 size : {glm::ivec2(61, 83), glm::ivec2(7, 5), glm::ivec2(1, 1)})
                for (const double zoom : {1.0, 3.7}) {
                    const SliceLayout layout = SliceLayout(frame, axis, size.x, size.y)
                                                   .zoomed(zoom, frame.worldFromVoxel({3, 20, 7}));
                    for (const int slice : {0, layout.sliceCount() - 1, layout.sliceCount() / 2}) {
                        const auto picture = drawSlice(content, layout, slice, size.x, size.y);
                        int other = 0;  // pixels where rounding falls to the other side
                        for (int y = 0; y < size.y; ++y)
                            for (int x = 0; x < size.x; ++x)
                                other += picture.at(x, y) != plainPixel(content, layout, slice, x, y);
                        EXPECT_LE(other, size.x * size.y / 500) << static_cast<int>(axis) << " " << slice;
                    }
                }
    }
}

}  // namespace
}  // namespace stereonav
