// Writes NIfTI files byte by byte from the format's description (nifti1.h, nifti2.h), in either version and
// byte order, in one file or a pair.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace stereonav::test {

struct NiftiSpec {
    int version = 1;
    bool bigEndian = false, pair = false;
    std::vector<std::int64_t> size = {5, 4, 3};
    int datatype = 4;
    double slope = 1, intercept = 0;
    int units = 2;  // millimetres
    int sformCode = 0, qformCode = 0;
    std::array<double, 12> srow = {0.5, 0, 0, 10, 0, 0.75, 0, 20, 0, 0, 2, 30};
    std::array<double, 4> pixdim = {1, 0.5, 0.75, 2};
    std::array<double, 3> quatern = {0, 0, 0}, qoffset = {10, 20, 30};
    double offset = -1;  // below 0: the usual one
};

inline bool turnsBytes(const NiftiSpec& s) {
    return s.bigEndian != (std::endian::native == std::endian::big);
}

template <typename T>
void putNumber(std::string& bytes, std::size_t at, T number, const NiftiSpec& s) {
    char raw[sizeof(T)];
    std::memcpy(raw, &number, sizeof(T));
    if (turnsBytes(s)) std::reverse(raw, raw + sizeof(T));
    bytes.replace(at, sizeof(T), raw, sizeof(T));
}

inline int niftiBits(int datatype) {
    switch (datatype) {
        case 2:
        case 256:
            return 8;
        case 4:
        case 512:
            return 16;
        case 8:
        case 16:
        case 768:
            return 32;
        default:
            return 64;
    }
}

inline std::string niftiHeader(const NiftiSpec& s) {
    const bool second = s.version == 2;
    std::string h(second ? 540 : 348, '\0');
    const auto real = [&](std::size_t at, double number) {
        second ? putNumber(h, at, number, s) : putNumber(h, at, static_cast<float>(number), s);
    };
    const std::size_t each = second ? 8 : 4;
    putNumber(h, 0, static_cast<std::int32_t>(h.size()), s);
    for (std::size_t n = 0; n < 8; ++n) {
        const std::int64_t number = n == 0               ? static_cast<std::int64_t>(s.size.size())
                                    : n <= s.size.size() ? s.size[n - 1]
                                                         : 1;
        if (second)
            putNumber(h, 16 + 8 * n, number, s);
        else
            putNumber(h, 40 + 2 * n, static_cast<std::int16_t>(number), s);
    }
    putNumber(h, second ? 12 : 70, static_cast<std::int16_t>(s.datatype), s);
    putNumber(h, second ? 14 : 72, static_cast<std::int16_t>(niftiBits(s.datatype)), s);
    for (std::size_t n = 0; n < 4; ++n) real((second ? 104 : 76) + n * each, s.pixdim[n]);
    const double usual = s.pair ? 0 : second ? 544 : 352, offset = s.offset < 0 ? usual : s.offset;
    if (second)
        putNumber(h, 168, static_cast<std::int64_t>(offset), s);
    else
        putNumber(h, 108, static_cast<float>(offset), s);
    real(second ? 176 : 112, s.slope);
    real(second ? 184 : 116, s.intercept);
    h.replace(second ? 240 : 148, 15, "made for a test");
    if (second) {
        putNumber(h, 344, static_cast<std::int32_t>(s.qformCode), s);
        putNumber(h, 348, static_cast<std::int32_t>(s.sformCode), s);
        putNumber(h, 500, static_cast<std::int32_t>(s.units), s);
        h.replace(4, 8, std::string(s.pair ? "ni2\0\r\n\032\n" : "n+2\0\r\n\032\n", 8));
    } else {
        putNumber(h, 252, static_cast<std::int16_t>(s.qformCode), s);
        putNumber(h, 254, static_cast<std::int16_t>(s.sformCode), s);
        h[123] = static_cast<char>(s.units);
        h.replace(344, 4, std::string(s.pair ? "ni1\0" : "n+1\0", 4));
    }
    for (std::size_t n = 0; n < 3; ++n) {
        real((second ? 352 : 256) + n * each, s.quatern[n]);
        real((second ? 376 : 268) + n * each, s.qoffset[n]);
    }
    for (std::size_t n = 0; n < 12; ++n) real((second ? 400 : 280) + n * each, s.srow[n]);
    return h;
}

template <typename T>
std::string niftiSamples(const std::vector<T>& samples, const NiftiSpec& s) {
    std::string bytes(samples.size() * sizeof(T), '\0');
    for (std::size_t n = 0; n < samples.size(); ++n) putNumber(bytes, n * sizeof(T), samples[n], s);
    return bytes;
}

// Returns header and samples of a single file.
template <typename T>
std::string niftiFile(const std::vector<T>& samples, const NiftiSpec& s) {
    return niftiHeader(s) + std::string(4, '\0') + niftiSamples(samples, s);
}

}  // namespace stereonav::test
