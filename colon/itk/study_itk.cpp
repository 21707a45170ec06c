// NRRD, NIfTI and MetaImage through ITK, which brings them into DICOM's axes (LPS) and millimetres. The
// header is read and checked first; only then memory is taken and the samples decoded straight into it.
#include <fmt/format.h>
#include <itkImageIOBase.h>
#include <itkMetaDataObject.h>
#include <itkMetaImageIO.h>
#include <itkNiftiImageIO.h>
#include <itkNrrdImageIO.h>
#include <nifti1_io.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <glm/common.hpp>
#include <glm/trigonometric.hpp>
#include <mutex>

#include "colon/study_parts.h"

namespace stereonav {
namespace {
namespace fs = std::filesystem;

constexpr double kMetresPerMillimetre = 1e-3;
// Axes whose directions are further from a right angle than this are sheared.
constexpr double kMostShear = 1e-3;

void keepQuiet() {
    static std::once_flag once;
    std::call_once(once, [] {
        itk::Object::SetGlobalWarningDisplay(false);
        nifti_set_debug_level(0);
    });
}

bool endsWith(const fs::path& file, std::initializer_list<const char*> ends) {
    std::string name = file.filename().string();
    for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    for (const char* end : ends)
        if (name.ends_with(end)) return true;
    return false;
}

itk::ImageIOBase::Pointer makeIo(const fs::path& file, std::string& format) {
    if (endsWith(file, {".nrrd", ".nhdr"})) {
        format = "NRRD";
        return itk::NrrdImageIO::New().GetPointer();
    }
    if (endsWith(file, {".mha", ".mhd"})) {
        format = "MetaImage";
        return itk::MetaImageIO::New().GetPointer();
    }
    format = "NIfTI";
    return itk::NiftiImageIO::New().GetPointer();
}

// ITK's messages begin with the place in its own sources; what follows is for people.
std::string reasonOf(const itk::ExceptionObject& error) {
    std::string text = error.GetDescription();
    if (const auto at = text.find("): "); at != std::string::npos) text = text.substr(at + 3);
    while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back()))) text.pop_back();
    return text.size() > 300 ? text.substr(0, 300) + " ..." : text;
}

SampleType sampleTypeOf(const fs::path& file, const itk::ImageIOBase& io) {
    using C = itk::CommonEnums::IOComponent;
    const bool isSigned = io.GetComponentType() == C::LONG || io.GetComponentType() == C::LONGLONG;
    switch (io.GetComponentType()) {
        case C::UCHAR:
            return SampleType::UInt8;
        case C::CHAR:
            return SampleType::Int8;
        case C::USHORT:
            return SampleType::UInt16;
        case C::SHORT:
            return SampleType::Int16;
        case C::UINT:
            return SampleType::UInt32;
        case C::INT:
            return SampleType::Int32;
        case C::ULONG:
        case C::LONG:
        case C::LONGLONG:
        case C::ULONGLONG:
            if (io.GetComponentSize() == 4) return isSigned ? SampleType::Int32 : SampleType::UInt32;
            return isSigned ? SampleType::Int64 : SampleType::UInt64;
        case C::FLOAT:
            return SampleType::Float32;
        case C::DOUBLE:
            return SampleType::Float64;
        default:
            throw Error(file.string(), "", "expected samples of 8 to 64 bits, found another type",
                        "save it with 16-bit integers");
    }
}

std::vector<std::uint64_t> sizesOf(const fs::path& file, const itk::ImageIOBase& io) {
    std::vector<std::uint64_t> size;
    for (unsigned axis = 0; axis < io.GetNumberOfDimensions(); ++axis) size.push_back(io.GetDimensions(axis));
    while (size.size() > 3 && size.back() == 1) size.pop_back();
    if (size.size() != 3)
        throw Error(file.string(), "",
                    fmt::format("expected a volume with 3 axes, found {} ({})", size.size(), sizeText(size)),
                    size.size() < 3 ? "give the whole series, not one slice" : "save one volume of it alone");
    if (io.GetNumberOfComponents() != 1)
        throw Error(file.string(), "",
                    fmt::format("expected one number a voxel, found {}", io.GetNumberOfComponents()),
                    "save one component of it alone");
    return size;
}

glm::dvec3 directionOf(const itk::ImageIOBase& io, unsigned axis) {
    const std::vector<double> d = io.GetDirection(axis);
    glm::dvec3 v(0.0);
    for (int c = 0; c < 3 && c < static_cast<int>(d.size()); ++c) v[c] = d[c];
    return v;
}

VolumeFrame frameOf(const fs::path& file, const itk::ImageIOBase& io,
                    const std::vector<std::uint64_t>& size) {
    VolumeFrame frame;
    for (int axis = 0; axis < 3; ++axis) {
        const double spacing = io.GetSpacing(axis);
        const glm::dvec3 direction = directionOf(io, axis);
        if (!(spacing > 0) || !std::isfinite(spacing))
            throw Error(
                file.string(), "",
                fmt::format("expected a spacing above 0 along axis {}, found {} mm", axis + 1, spacing),
                "correct it in the header");
        if (!(glm::length(direction) > 0.5) || !std::isfinite(io.GetOrigin(axis)))
            throw Error(file.string(), "", fmt::format("axis {} has no direction or origin", axis + 1),
                        "correct it in the header");
        frame.size[axis] = static_cast<int>(size[axis]);
        frame.spacing[axis] = spacing * kMetresPerMillimetre;
        frame.origin[axis] = io.GetOrigin(axis) * kMetresPerMillimetre;
        frame.axes[axis] = glm::normalize(direction);
    }
    return frame;
}

// Slices of a sheared grid as slices in space; upright ones too.
SlicePlaces placesOf(const fs::path& file, VolumeFrame& frame, bool resample) {
    const glm::dvec3 a = frame.axes[0], b = frame.axes[1], step = frame.axes[2] * frame.spacing.z;
    if (std::abs(glm::dot(a, b)) > kMostShear || glm::length(glm::cross(a, b)) < 0.5)
        throw Error(file.string(), "",
                    fmt::format("expected axes 1 and 2 at a right angle, found {:.2f} degrees",
                                glm::degrees(std::acos(glm::clamp(glm::dot(a, b), -1.0, 1.0)))),
                    "resample it onto a grid with right angles");
    glm::dvec3 normal = glm::normalize(glm::cross(a, b));
    if (glm::dot(normal, step) < 0) normal = -normal;
    const double height = glm::dot(normal, step);
    const double tilt = std::acos(glm::clamp(height / glm::length(step), -1.0, 1.0));
    SlicePlaces places;
    places.upright = tilt <= kMostShear;
    places.tilt = tilt;
    if (!places.upright && !resample)
        throw Error(file.string(), "",
                    fmt::format("slices 1 to {} are sheared by {:.2f} degrees (gantry tilt)", frame.size.z,
                                glm::degrees(tilt)),
                    "give --resample to shear them upright");
    if (tilt > glm::radians(80.0))
        throw Error(file.string(), "", "the third axis lies in the plane of the slices",
                    "correct the directions in the header");
    frame.axes[1] = glm::normalize(b - a * glm::dot(a, b));
    frame.axes[2] = normal;
    frame.spacing.z = height;
    places.frame = frame;
    places.largestGap = height;
    const glm::dvec3 shift(glm::dot(frame.axes[0], step), glm::dot(frame.axes[1], step), height);
    for (int k = 0; k < frame.size.z; ++k) places.offsets.push_back(shift * static_cast<double>(k));
    return places;
}

std::string descriptionOf(itk::ImageIOBase& io) {
    std::string text;
    for (const char* key : {"comment", "ITK_FileNotes", "Comment"})
        if (itk::ExposeMetaData<std::string>(io.GetMetaDataDictionary(), key, text) && !text.empty()) break;
    return text;
}

void decode(const fs::path& file, itk::ImageIOBase& io, const DataPlace& place, RawStudy& raw) {
    const std::uint64_t expected = raw.frame.count() * bytesOf(raw.type);
    raw.bytes = LazyArray<unsigned char>(expected);
    itk::ImageIORegion region(io.GetNumberOfDimensions());
    for (unsigned axis = 0; axis < io.GetNumberOfDimensions(); ++axis)
        region.SetSize(axis, io.GetDimensions(axis));
    io.SetIORegion(region);
    std::string problem;
    try {
        io.Read(raw.bytes.data());
    } catch (const itk::ExceptionObject& error) {
        problem = "can not be decoded: " + reasonOf(error);
    } catch (const std::exception& error) {
        problem = std::string("can not be decoded: ") + error.what();
    }
    if (place.compressed && place.files.size() == 1 && !problem.empty()) {
        const std::uint64_t found = inflatedBytes(place.files[0], place.offset, expected);
        if (found < expected)
            problem = fmt::format("cut off: the header says {} bytes of samples, found {}", expected, found);
    }
    if (!problem.empty()) throw Error(file.string(), "", problem, "copy or save the file again");
}

// A header of our own in a folder of its own, for as long as it lives.
class SpareHeader {
public:
    explicit SpareHeader(const std::string& text) {
        if (text.empty()) return;
        std::string name = (fs::temp_directory_path() / "stereonav-XXXXXX").string();
        if (!mkdtemp(name.data()))
            throw Error(name, "", "can not be made", "free some room in the folder of temporary files");
        mFolder = name;
        std::ofstream(file(), std::ios::binary) << text;
    }
    ~SpareHeader() {
        std::error_code ignored;
        if (!mFolder.empty()) fs::remove_all(mFolder, ignored);
    }
    SpareHeader(const SpareHeader&) = delete;
    SpareHeader& operator=(const SpareHeader&) = delete;
    bool empty() const { return mFolder.empty(); }
    fs::path file() const { return mFolder / "header.nhdr"; }

private:
    fs::path mFolder;
};

// readable: the file itself, or a spare header for it.
void readHeader(const fs::path& file, const fs::path& readable, itk::ImageIOBase& io,
                const std::string& format) {
    std::string reason;
    try {
        io.SetFileName(readable.string());
        io.ReadImageInformation();
        return;
    } catch (const itk::ExceptionObject& error) {
        reason = reasonOf(error);
    } catch (const std::exception& error) {
        reason = error.what();
    }
    throw Error(file.string(), "", fmt::format("expected a {} volume: {}", format, reason),
                "give a volume file (.nrrd, .nhdr, .nii, .nii.gz, .mha, .mhd) or a folder of DICOM");
}

}  // namespace

VolumeFile readVolumeFile(const fs::path& file, const StudyOptions& options, Progress& progress) {
    keepQuiet();
    VolumeFile result;
    const DataPlace place = findData(file);
    const auto io = makeIo(file, result.format);
    progress.report(0, "reading " + file.filename().string());
    checkBytes(file, place, 0);  // that the data files are there
    const SpareHeader spare(result.format == "NRRD" ? nrrdWithoutSpace(file) : "");
    if (!spare.empty())
        result.notes.push_back(
            "the header names a space but no directions: its axes are taken for the patient's (LPS)");
    readHeader(file, spare.empty() ? file : spare.file(), *io, result.format);
    const auto size = sizesOf(file, *io);
    result.raw.type = sampleTypeOf(file, *io);
    checkSize(file.string(), size, bytesOf(result.raw.type) + static_cast<int>(sizeof(std::int16_t)));
    result.raw.frame = frameOf(file, *io, size);
    const SlicePlaces places = placesOf(file, result.raw.frame, options.resample);
    checkBytes(file, place, result.raw.frame.count() * bytesOf(result.raw.type));
    decode(file, *io, place, result.raw);
    progress.report(0.7, "reading " + file.filename().string());
    result.description = descriptionOf(*io);
    if (!places.upright) {
        result.raw = resampleSlices(result.raw, places, file.string());
        result.notes.push_back(
            fmt::format("resampled: slices sheared by {:.2f} degrees (gantry tilt) stand upright",
                        glm::degrees(places.tilt)));
    }
    return result;
}

}  // namespace stereonav
