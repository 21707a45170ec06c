// A small study of DICOM slices whose pixels are known, in any plain syntax.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>

#include "../support/dicom_files.h"
#include "colon/study/study.h"

namespace stereonav::test {

// Three slices of 8 x 7 pixels, 12 bits.
inline constexpr int kColumns = 8, kRows = 7, kSlices = 3;

inline std::uint16_t pixelOf(int n, int k) {
    return static_cast<std::uint16_t>((n * 37 + k * 411 + n * n * k) % 4096);
}

inline DicomSpec specOf(int k) {
    DicomSpec s;
    s.slice.columns = kColumns;
    s.slice.rows = kRows;
    s.slice.bitsStored = 12;
    s.slice.position.z = 30 + 2 * k;
    for (int n = 0; n < kColumns * kRows; ++n) s.slice.pixels.push_back(pixelOf(n, k));
    return s;
}

inline void writeStudy(const std::filesystem::path& folder, DicomSyntax syntax = DicomSyntax::Explicit) {
    for (int k = 0; k < kSlices; ++k) {
        DicomSpec s = specOf(k);
        s.syntax = syntax;
        writeDicom(folder / fmt::format("s{}.dcm", k), s);
    }
}

inline void expectStudy(const Study& study) {
    ASSERT_EQ(study.grey.frame.size, glm::ivec3(kColumns, kRows, kSlices));
    EXPECT_NEAR(study.grey.frame.spacing.z, 0.002, 1e-12);
    for (int k = 0; k < kSlices; ++k)
        for (int n = 0; n < kColumns * kRows; ++n)
            ASSERT_EQ(study.grey.values[k * kColumns * kRows + n], pixelOf(n, k) - 1024) << n << " of " << k;
}

}  // namespace stereonav::test
