// Terrains and studies of a few thousand samples, as files.
#pragma once

#include <string>

namespace stereonav::test {

// Each writes the file (or folder) named. All seen from outside but the tube; two of their values are what
// isovalues are chosen from.
void writeHills(const std::string& file);       // ESRI ASCII grid, with missing samples
void writeReliefTiff(const std::string& file);  // GeoTIFF, 32-bit floats
void writeBalls(const std::string& file);       // NRRD: two balls that touch, no CT
void writeBody(const std::string& file);        // NIfTI, gzipped: a body with a bone, HU
void writeMask(const std::string& file);        // MetaImage: a block with a hole
void writeSlices(const std::string& folder);    // DICOM: the body again
void writeTube(const std::string& file);        // NRRD: a mask of a straight tube, a colon
void writePhoto(const std::string& file, int width, int height);
void writeProbe(const std::string& file);  // Radiance

}  // namespace stereonav::test
