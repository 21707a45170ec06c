// The header of a volume file, read and checked before memory is taken. Shared among colon/study/*.cpp only.
// Formats: teem.sourceforge.net/nrrd/format.html, itk.org MetaIO, nifti.nimh.nih.gov.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "colon/study/study_labels.h"
#include "colon/study/study_parts.h"

namespace stereonav {

enum class SampleEncoding {
    Raw,
    Deflate,  // gzip or zlib, as the stream says itself
    Bzip2,
    Text,  // numbers
    Hex    // two digits a byte
};

// Where the samples are, and how they are packed.
struct SamplePlace {
    std::vector<std::filesystem::path> files;  // in their order, each with an equal share
    std::uint64_t offset = 0;                  // bytes before the samples in each file
    std::uint64_t lines = 0;                   // lines to leave out after these
    std::uint64_t skip = 0;                    // bytes to leave out after those, once decoded
    bool atEnd = false;                        // the samples are the file's last bytes (Raw)
    SampleEncoding encoding = SampleEncoding::Raw;
    bool turned = false;  // in the other byte order
};

struct VolumeHeader {
    std::string format, description;
    std::vector<std::uint64_t> size;  // along the three axes of space
    SampleType type = SampleType::Int16;
    glm::dmat3 steps{1.0};            // LPS millimetres: columns lead from voxel to voxel along i, j, k
    glm::dvec3 origin{0.0};           // LPS millimetres, of voxel (0, 0, 0)
    bool directed = true;             // the header says how the axes lie
    double slope = 1, intercept = 0;  // value = stored * slope + intercept
    std::vector<std::filesystem::path> headers;  // files that the header itself was read from
    SamplePlace place;
    MaskLabels labels;
    std::vector<std::string> notes;

    // Returns the bytes of a voxel, of all layers.
    int voxelBytes() const { return bytesOf(type) * static_cast<int>(labels.layers.count); }
};

// All throw Error, with the place in the file where there is one.
VolumeHeader readNiftiHeader(const std::filesystem::path& file);  // study_nifti.cpp
VolumeHeader readNrrdHeader(const std::filesystem::path& file);   // study_nrrd.cpp
VolumeHeader readMetaHeader(const std::filesystem::path& file);   // study_meta.cpp
// Reads a header by the file's name.
VolumeHeader readVolumeHeader(const std::filesystem::path& file);  // study_volume.cpp

// --- study_samples.cpp
// Throws Error when the files can not hold as many samples as the header says.
void checkSampleFiles(const std::filesystem::path& file, const VolumeHeader& header);
// Reads all samples into `to`, in this machine's byte order. come(bytes) is told how many bytes have come, in
// the file's order. Throws Error, Cancelled.
void readSamples(const std::filesystem::path& file, const VolumeHeader& header, unsigned char* to,
                 Progress& progress, const std::function<void(std::uint64_t bytes)>& come);

// Returns true where the file's name is one of a pair of .hdr and .img (each also with .gz) whose header is
// NIfTI's.
bool isNiftiPair(const std::filesystem::path& file);  // study_nifti.cpp
// Returns the sizes of a volume: all but those of 1 beyond the third. Throws Error unless they are three.
std::vector<std::uint64_t> threeSizes(const std::filesystem::path& file,
                                      std::vector<std::uint64_t> size);  // study_volume.cpp

}  // namespace stereonav
