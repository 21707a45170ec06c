// The steps of reading a study, shared among colon/study/*.cpp only: facts from the header, checked before
// memory is taken; samples as the file stores them; grey values or a mask from those.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "colon/study/study.h"
#include "colon/study/study_labels.h"

namespace stereonav {

class PictureDecoder;  // picture_decoder.h

enum class SampleType { UInt8, Int8, UInt16, Int16, UInt32, Int32, UInt64, Int64, Float32, Float64 };
int bytesOf(SampleType type);  // bytes of a sample

// Samples of a regular grid, i fastest, in this machine's byte order.
struct RawStudy {
    VolumeFrame frame;
    SampleType type = SampleType::Int16;
    double slope = 1, intercept = 0;  // value = sample * slope + intercept; HU for CT
    LazyArray<unsigned char> bytes;
    bool isScaled() const { return slope != 1 || intercept != 0; }
};

// Calls use(pointer to the samples of their own type).
template <typename Use>
decltype(auto) withSamples(const RawStudy& raw, Use&& use) {
    const void* p = raw.bytes.data();
    switch (raw.type) {
        case SampleType::UInt8:
            return use(static_cast<const std::uint8_t*>(p));
        case SampleType::Int8:
            return use(static_cast<const std::int8_t*>(p));
        case SampleType::UInt16:
            return use(static_cast<const std::uint16_t*>(p));
        case SampleType::Int16:
            return use(static_cast<const std::int16_t*>(p));
        case SampleType::UInt32:
            return use(static_cast<const std::uint32_t*>(p));
        case SampleType::Int32:
            return use(static_cast<const std::int32_t*>(p));
        case SampleType::UInt64:
            return use(static_cast<const std::uint64_t*>(p));
        case SampleType::Int64:
            return use(static_cast<const std::int64_t*>(p));
        case SampleType::Float32:
            return use(static_cast<const float*>(p));
        default:
            return use(static_cast<const double*>(p));
    }
}

// --- study_check.cpp Throws Error unless there are two or more voxels along each axis and `bytes` bytes fit
// into the memory that can be had; the error says what would fit.
void checkSize(const std::string& file, const std::vector<std::uint64_t>& size, double bytes);
// Throws Error unless spacings are such that work on the volume ends: neither very small nor very large, none
// of them far from the others, and the first voxel at a place that numbers tell from that of the next.
void checkFrame(const std::string& file, const VolumeFrame& frame);
// Returns the bytes that are held at once: samples of `sampleBytes` bytes each, which go as values come, or
// values with what the caller takes beside them.
double bytesHeld(const std::vector<std::uint64_t>& size, int sampleBytes, const StudyOptions& options);
// Returns "512 x 512 x 20".
std::string sizeText(const std::vector<std::uint64_t>& size);

// --- study_facts.cpp
// What some of the samples are like.
struct ValueFacts {
    double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;  // samples
    std::size_t notNumbers = 0, fractions = 0;
    std::size_t pairs = 0, equalPairs = 0;  // neighbours along i, not both 0
    bool many = false;                      // more distinct values than a map of labels has
    std::vector<double> distinct;           // sorted
};

// Statistics of a study's first slices, in their order, gathered while others were read.
struct SliceLooks {
    std::vector<ValueFacts> facts;
    std::vector<SliceRuns> air;  // runs of voxels below StudyOptions::airBelow; as many, or none
};

// --- study_volume.cpp
// A volume file as read.
struct VolumeFile {
    RawStudy raw;
    std::string format, description;
    std::vector<std::string> notes;
    bool directed = true;  // the file says how its axes lie
    SliceLooks looks;
    MaskLabels labels;  // the samples are of one layer
};
// Reads NRRD, NIfTI or MetaImage. Throws Error, Cancelled.
VolumeFile readVolumeFile(const std::filesystem::path& file, const StudyOptions& options, Progress& progress);

// --- study_dicom_slices.cpp
// A slice, or a frame of several in one file.
struct DicomSlice {
    std::filesystem::path file;
    int frame = -1;    // from 0 on; -1: the file has one
    std::string name;  // the file's, for messages, and its frame
    std::string uid, description, modality, kernel;
    int columns = 0, rows = 0, frames = 1, samples = 1;
    glm::dvec3 position{0.0};         // LPS millimetres, of the first pixel's centre
    glm::dvec3 along{1, 0, 0};        // unit, LPS: where columns grow
    glm::dvec3 down{0, 1, 0};         // unit, LPS: where rows grow
    glm::dvec2 spacing{0.0};          // millimetres between columns, between rows
    double slope = 1, intercept = 0;  // value = stored * slope + intercept, HU for CT
    bool hasPlace = false, hasSpacing = false, hasPadding = false;
    std::int64_t padding = 0, paddingLimit = 0;  // stored numbers
    // Values of stored numbers from tableFirst on, the last one's from there on; null: slope and intercept.
    std::shared_ptr<const std::vector<std::uint16_t>> table;
    std::int64_t tableFirst = 0;
    std::string placedBy;  // for frames without places of their own; "" else
    std::string damage;    // a clause that fits behind the name; "" where there is none
    std::string aside;     // "localizer": what it is where it is no slice of a volume; "" else
};
// Reads the slices of a DICOM file, none where it is not an image. Throws Error.
std::vector<DicomSlice> readSlices(const std::filesystem::path& file, bool& isDicom);

// --- study_dicom.cpp
// Images among the files of a folder, by series in the order of their UIDs.
struct DicomSeries {
    SeriesInfo info;
    std::vector<DicomSlice> slices;
    std::vector<std::string> notes;
    std::string strangers;  // files that are not DICOM, a few by name; "" where there are none
};
// Reads the series of a folder, or of one file. Throws Error.
std::vector<DicomSeries> scanFolder(const std::filesystem::path& place);
// Returns the series asked for; throws Error that lists them otherwise.
DicomSeries chooseSeries(const std::filesystem::path& place, const std::string& wanted);
// Returns the value of a stored number, HU for CT: by its table, where numbers below the first count as it
// and those beyond the last as that (PS3.3 C.11.1.1.1), or by slope and intercept.
double valueOf(const DicomSlice& slice, double stored);
// Reads a series. Throws Error, Cancelled.
VolumeFile readDicom(const std::filesystem::path& place, const StudyOptions& options, Progress& progress);

// --- study_slices.cpp
// How slices lie: offsets of each slice's first pixel along the shared in-plane axes and the normal, metres,
// relative to the first slice; ordered along the normal.
struct SlicePlaces {
    VolumeFrame frame;                // spacing.z: the even step; size.z: the slices
    std::vector<glm::dvec3> offsets;  // metres, along frame.axes
    bool upright = true;              // nothing to mend
    double largestGap = 0;            // metres
    double tilt = 0;                  // radians
};
// Sorts slices along the normal and checks them; throws Error that names the slices unless all is even and
// upright or `resample` is set, which mends gaps, uneven steps and tilt. Repeated slices and mixed sizes
// never pass. strangers: files of the folder that may be what is missing; "" where there are none.
SlicePlaces placeSlices(const std::filesystem::path& folder, std::vector<DicomSlice>& slices, bool resample,
                        const std::string& strangers = "");

// --- study_glance.cpp
// Looks at the headers of DICOM: a folder, or one file. Throws Error, Cancelled.
StudyGlance glanceAtSlices(const std::filesystem::path& place, Progress& progress);

// --- study_pixels.cpp
// Calls use(slice, its pixels as stored, widened) for these, all of one file. Throws Error.
void decodeSlices(const std::vector<const DicomSlice*>& slices, PictureDecoder& decoder,
                  const std::function<void(const DicomSlice&, const double*)>& use);

// --- study_resample.cpp
// Resamples onto an even, upright grid over all of the slices, by linear interpolation; places that no slice
// covers get the least value. Throws Error when the new grid does not fit into memory.
RawStudy resampleSlices(const RawStudy& raw, const SlicePlaces& places, const std::string& file);

// --- study_values.cpp
// Fills mask or grey (which have the samples' frame), air, and the notes. looks: VolumeFile's. Values that
// stay as they are take over the samples' memory, others come slice by slice, and the samples' memory goes.
// Throws Error about labels and values that are not numbers.
void takeValues(RawStudy raw, SliceLooks looks, const MaskLabels& labels, const std::string& file,
                const StudyOptions& options, Study& study);

}  // namespace stereonav
