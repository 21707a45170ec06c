// A CT study or a ready mask from files: a folder of DICOM slices, the root of a disc with a DICOMDIR, an
// enhanced DICOM file, NIfTI, NRRD, MetaImage.
// World: the patient's axes (LPS) in metres; orientation and spacing as the file says.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/progress.h"
#include "engine/image/packed_color.h"
#include "engine/image/plane.h"
#include "engine/volume/components.h"
#include "engine/volume/volume.h"

namespace stereonav {

struct StudyOptions {
    std::string series;     // one of several in a DICOM folder: number in the list (1, 2, ...) or UID
    bool resample = false;  // mend uneven or tilted slices onto an even upright grid
    // The one label of a mask with several: its number, or its name where the header names it.
    std::optional<std::string> label;
    // Study::key where the caller has it, or does not ask for it: the files are not hashed then.
    std::optional<std::uint64_t> key;
    // HU: values below it are looked for while other slices are read (Study::air).
    std::optional<double> airBelow;
    // Returns the bytes that the caller will take beside the values of `voxels` voxels: a study that does not
    // fit into memory together with them is not read. Empty: none.
    std::function<double(double voxels)> working;
};

// A study as it was read.
struct Study {
    std::string format;       // "DICOM", "NRRD", ... as shown to the user
    std::string description;  // patient-free: series description, modality, kernel; may be ""
    bool isMask = false;      // then `mask` is filled, else `grey`
    GreyVolume grey;          // HU for CT
    MaskVolume mask;
    // Voxels of `grey` below StudyOptions::airBelow. Nothing where values are not kept as the file has them.
    std::optional<VoxelRuns> air;
    bool directed = true;            // the file says how its axes lie
    std::uint64_t key = 0;           // hash of the content and the options: equal studies have equal keys
    std::vector<std::string> notes;  // what was mended or assumed, one line each
};

struct SeriesInfo {
    std::string uid, description;
    int slices = 0;
};

// A series by one of its slices.
struct SeriesLook {
    SeriesInfo info;
    std::string modality;        // "CT"
    int columns = 0, rows = 0;   // pixels of that slice
    Plane<PackedColor> picture;  // the middle slice in grey, pixels square; empty where there is a problem
    std::string problem;         // why it has no picture, one line; "" else
};
// Looks at all series in a folder of DICOM files, in the order that --series counts them, without localizers
// and the like. Throws Error where the folder holds none.
std::vector<SeriesLook> lookAtSeries(const std::filesystem::path& folder);

// Facts of a study from headers alone; no sample is read.
struct StudyGlance {
    std::string format, description;  // Study's; without notes
    std::string type;                 // type of a sample: "int16"; "" where it is not known
    std::vector<std::uint64_t> size;  // voxels along three axes; of a folder columns and rows alone
    std::vector<double> spacing_mm;   // along these axes; empty where the header does not say
    std::size_t files = 0;            // in a folder
    std::size_t series = 0;  // series of a folder, among the files that were looked at: at least so many
};
// Reads headers; of a folder those of some files, spread over all. Throws Error, Cancelled.
StudyGlance glanceAtStudy(const std::filesystem::path& path, Progress& progress);

// Returns which folders below hold DICOM slices, as advice: "its folder ST1 holds DICOM slices: give that
// one"; "" where none do. A bounded part of what is there is looked at.
std::string studyFoldersAdvice(const std::filesystem::path& folder);

// Returns true where readStudy would try: a folder with DICOM files or a DICOMDIR, or a name ending in .nrrd
// .nhdr .nii .nii.gz .mha .mhd .dcm .ima; also what begins as DICOM or is a NIfTI pair, and samples of a
// header beside them, which it refuses by naming that. No more is read than the folder's list and headers.
bool looksLikeStudy(const std::filesystem::path& path);

// Returns the study's key without decoding its voxels, for looking into the cache first. Throws Error.
std::uint64_t studyKey(const std::filesystem::path& path, const StudyOptions& options);

// Reads a study. Throws Error (one line: what was expected, what was found, what to do), Cancelled. What
// reading and options.working need is held against the memory that can be had before any is taken.
Study readStudy(const std::filesystem::path& path, const StudyOptions& options, Progress& progress);

// Names and texts that a NRRD header carries for those who know them ("key:=value").
using HeaderFields = std::vector<std::pair<std::string, std::string>>;

// Writes a mask as gzip-compressed NRRD in LPS millimetres, atomically; readStudy reads it back. Throws
// Error.
void writeMask(const std::filesystem::path& file, const MaskVolume& mask, const std::string& comment,
               const HeaderFields& fields = {});

}  // namespace stereonav
