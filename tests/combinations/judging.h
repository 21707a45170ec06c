// What is held of pictures: that nothing but numbers was packed, and how far two pictures may be apart.
#pragma once

#include <cstdint>
#include <string>

#include "engine/image/eye_image.h"

namespace stereonav::test {

// "" where all is well, else what is wrong and where.

// Depths are numbers, 0 or more, or infinite, their spreads finite; the two bits of a colour that hold
// nothing hold nothing.
std::string wrongNumbers(const EyeImage& image);

// Every bit of colour and depth.
std::string differentBits(const EyeImage& a, const EyeImage& b);

// Channels of packed colours, steps of 1023.
int channelDifference(PackedColor a, PackedColor b);

struct Nearness {
    int steps = 0;       // by which a channel may differ
    double beyond = 0;   // share of the pixels that may differ by more
    double mean = 1023;  // steps, over all pixels and channels
};
std::string tooFar(const EyeImage& image, const EyeImage& oracle, const Nearness& bound);
// The tightest bound that holds, where as many pixels may be beyond.
Nearness nearnessThatHolds(const EyeImage& image, const EyeImage& oracle, double beyond);

// Pixels whose colour lies by more than `steps` outside of what the oracle has within `reach` pixels.
struct Range {
    int reach = 1, steps = 0;
    double beyond = 0;  // share of pixels
};
// Two pictures of which a pixel may show what either has about it; the same twice where there is one alone.
struct Oracles {
    const EyeImage &first, &second;
};
std::string outOfRange(const EyeImage& image, const Oracles& oracles, const Range& range);
Range rangeThatHolds(const EyeImage& image, const Oracles& oracles, const Range& range);

// Pixels that are black, white or of the background, all over, where the oracle has nothing like it within
// `reach` pixels. background: what is packed where nothing is met.
std::string strangeFlatness(const EyeImage& image, const EyeImage& oracle, int reach, double share);

}  // namespace stereonav::test
