// Radiance transfer vectors (Wyman et al. 2006, eq. 6) made small, and dotted with the light in their small
// form (eq. 9): half floats, or clustered principal components (Sloan, Hall, Hart and Snyder 2003): a vector
// is the mean of its cluster plus a few weighted components of it. Dotted with a light, a cluster's mean and
// components are numbers, worked out once a frame; a texel then costs one multiplication a component and
// channel.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "engine/light/spherical_harmonics.h"

namespace stereonav {

// Of one vector: coefficient first, then channel.
struct TransferShape {
    int order = 5;
    int channels = 1;  // 1 (grey surface) or 3

    int size() const { return harmonicsCount(order) * channels; }
};

struct TransferCompression {
    enum class Weights { Half, Byte };

    int clusters = 128;   // 1..256; 0: no clusters, every number a half float
    int components = 12;  // of a cluster; 0..vector size
    Weights weights = Weights::Byte;
    // Clusters are found on so many of the vectors, spread evenly (Sloan et al. take all), in so many rounds.
    int trainingVectors = 1 << 16;
    int rounds = 8;
};

// The light of a frame as a codebook needs it: entries of rgb and a zero. Half floats: one a number of the
// vector. Clusters: components + 1 a cluster, that of the mean first, steps and ranges of bytes worked in, so
// that a texel's light is entry 0 plus the sum of its numbers (a half's value, or a byte's 0..255) times the
// entries after it.
struct TransferLight {
    std::vector<glm::vec4> entries;
};

// How vectors become records and back. Immutable; all functions may be called from any thread.
//
// A record, recordBytes() long, unaligned, little-endian: halves: 2 bytes a number. Clusters: 1 byte, the
// cluster; then a weight a component, 1 byte or a half of 2.
class TransferCodebook {
public:
    // What it consists of, to be written to a file and read back.
    struct Parts {
        TransferShape shape;
        int clusters = 0, components = 0;
        TransferCompression::Weights weights = TransferCompression::Weights::Byte;
        // cluster by cluster: the mean, then the components (orthonormal, or all 0); (components + 1) * size
        std::vector<float> vectors;
        // cluster by cluster, component by component: weight of byte 0 and step to the next; empty for halves
        std::vector<glm::vec2> ranges;
    };

    // Throws Error where the parts do not fit each other or are not finite.
    explicit TransferCodebook(Parts parts);

    const Parts& parts() const { return mParts; }
    std::size_t recordBytes() const;

    // Whose cluster leaves the least error. vector: finite. Weights beyond the range of bytes are clamped.
    void encode(const float* vector, std::uint8_t* record) const;
    int bestCluster(const float* vector) const;  // 0 where there are none
    void encodeIn(int cluster, const float* vector, std::uint8_t* record) const;
    // As encodeIn, the weights as they are: parts().components of them.
    void weightsIn(int cluster, const float* vector, float* weights) const;

    void decode(const std::uint8_t* record, float* vector) const;

    // light: harmonicsCount(order) coefficients, as LightProbe::project gives them. Throws Error for others.
    TransferLight prepareLight(std::span<const glm::vec3> light) const;
    // What decode()'s vector dotted with the light is, but for rounding.
    glm::vec3 dot(const std::uint8_t* record, const TransferLight& light) const;

private:
    const float* cluster(int c) const { return &mParts.vectors[c * mClusterSize]; }
    float weight(const std::uint8_t* record, int cluster, int component) const;

    Parts mParts;
    std::size_t mClusterSize = 0;    // numbers in mParts.vectors
    std::vector<float> mMeans;       // number by number of a vector, then cluster: rows for vector code
    std::vector<float> mDirections;  // cluster, then number by number, then component
};

// Many vectors in their small form.
struct CompressedTransfer {
    TransferCodebook codebook;
    std::vector<std::uint8_t> records;

    std::size_t count() const { return records.size() / codebook.recordBytes(); }
    void decode(std::size_t n, float* vector) const {
        codebook.decode(&records[n * codebook.recordBytes()], vector);
    }
    glm::vec3 dot(std::size_t n, const TransferLight& light) const {
        return codebook.dot(&records[n * codebook.recordBytes()], light);
    }
};

// vectors: a multiple of shape.size() numbers. The codebook for vectors like these; further ones may be
// encoded with it. The same vectors give the same codebook, whatever the thread count. Throws Error for
// settings out of range, a number of floats that does not fit, numbers beyond half floats (NaN too).
TransferCodebook trainCodebook(std::span<const float> vectors, const TransferShape& shape,
                               const TransferCompression& settings);

// Trained on these vectors, the bytes' ranges made to hold all of them.
CompressedTransfer compressTransfer(std::span<const float> vectors, const TransferShape& shape,
                                    const TransferCompression& settings);

// Root of the mean square of decoded minus given, relative to that of the given ones; 0 for none or all 0.
double relativeError(const CompressedTransfer& compressed, std::span<const float> vectors);

}  // namespace stereonav
