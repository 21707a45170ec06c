// Writes small volumes for tests of readers: NRRD, MetaImage and NIfTI by hand from their formats'
// descriptions, DICOM slices through GDCM's writer.
#pragma once

#include <gdcmDataElement.h>
#include <gdcmWriter.h>
#include <nifti1.h>

#include <cstring>
#include <filesystem>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "file_bytes.h"
#include "slice_spec.h"

namespace stereonav::test {

// Writes a NRRD file with these header lines (after the magic) and bytes.
inline std::filesystem::path writeNrrd(const std::filesystem::path& file, const std::string& lines,
                                       const std::string& bytes) {
    writeBytes(file, "NRRD0005\n" + lines + "\n" + bytes);
    return file;
}

inline std::filesystem::path writeMeta(const std::filesystem::path& file, const std::string& lines,
                                       const std::string& bytes) {
    writeBytes(file, "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\n" +
                         lines + "ElementDataFile = LOCAL\n" + bytes);
    return file;
}

// Returns a NIfTI-1 file: its sform maps (i, j, k) to RAS millimetres (i * spacing - x, ...).
inline std::string niftiBytes(const glm::ivec3& size, const glm::dvec3& spacing, const glm::dvec3& originRas,
                              short datatype, short bits, const std::string& samples) {
    nifti_1_header h{};
    h.sizeof_hdr = 348;
    h.dim[0] = 3;
    for (int axis = 0; axis < 7; ++axis) h.dim[axis + 1] = axis < 3 ? static_cast<short>(size[axis]) : 1;
    h.datatype = datatype;
    h.bitpix = bits;
    h.pixdim[0] = 1;
    for (int axis = 0; axis < 3; ++axis) h.pixdim[axis + 1] = static_cast<float>(spacing[axis]);
    h.vox_offset = 352;
    h.scl_slope = 1;
    h.xyzt_units = NIFTI_UNITS_MM;
    h.qform_code = h.sform_code = NIFTI_XFORM_SCANNER_ANAT;
    h.qoffset_x = static_cast<float>(originRas.x);
    h.qoffset_y = static_cast<float>(originRas.y);
    h.qoffset_z = static_cast<float>(originRas.z);
    float* rows[] = {h.srow_x, h.srow_y, h.srow_z};
    for (int axis = 0; axis < 3; ++axis) {
        rows[axis][axis] = static_cast<float>(spacing[axis]);
        rows[axis][3] = static_cast<float>(originRas[axis]);
    }
    std::memcpy(h.magic, "n+1", 4);
    return std::string(reinterpret_cast<const char*>(&h), sizeof h) + std::string(4, '\0') + samples;
}

inline void addText(gdcm::DataSet& set, int group, int element, gdcm::VR vr, std::string text) {
    if (text.size() % 2) text += vr == gdcm::VR::UI ? '\0' : ' ';
    gdcm::DataElement data(gdcm::Tag(static_cast<std::uint16_t>(group), static_cast<std::uint16_t>(element)));
    data.SetVR(vr);
    data.SetByteValue(text.data(), gdcm::VL(static_cast<std::uint32_t>(text.size())));
    set.Replace(data);
}

inline void addWord(gdcm::DataSet& set, int element, int value) {
    const auto word = static_cast<std::uint16_t>(value);
    gdcm::DataElement data(gdcm::Tag(0x0028, static_cast<std::uint16_t>(element)));
    data.SetVR(gdcm::VR::US);
    data.SetByteValue(reinterpret_cast<const char*>(&word), gdcm::VL(2));
    set.Replace(data);
}

inline void addGeometry(gdcm::DataSet& set, const SliceSpec& s) {
    using gdcm::VR;
    addText(set, 0x0020, 0x0032, VR::DS, numbersText({s.position.x, s.position.y, s.position.z}));
    addText(set, 0x0020, 0x0037, VR::DS,
            numbersText({s.along.x, s.along.y, s.along.z, s.down.x, s.down.y, s.down.z}));
    addText(set, 0x0028, 0x0030, VR::DS, numbersText({s.spacing.y, s.spacing.x}));
}

inline void addPixels(gdcm::DataSet& set, const SliceSpec& s) {
    addWord(set, 0x0002, 1);
    addText(set, 0x0028, 0x0004, gdcm::VR::CS, s.photometric);
    addWord(set, 0x0010, s.rows);
    addWord(set, 0x0011, s.columns);
    addWord(set, 0x0100, 16);
    addWord(set, 0x0101, s.bitsStored);
    addWord(set, 0x0102, s.bitsStored - 1);
    addWord(set, 0x0103, s.isSigned ? 1 : 0);
    if (s.padding >= 0) addWord(set, 0x0120, s.padding);
    std::vector<std::uint16_t> pixels = s.pixels;
    pixels.resize(static_cast<std::size_t>(s.columns) * s.rows, 1024);
    gdcm::DataElement data(gdcm::Tag(0x7fe0, 0x0010));
    data.SetVR(gdcm::VR::OW);
    data.SetByteValue(reinterpret_cast<const char*>(pixels.data()),
                      gdcm::VL(static_cast<std::uint32_t>(pixels.size() * 2)));
    set.Replace(data);
}

inline void writeSlice(const std::filesystem::path& file, const SliceSpec& s) {
    using gdcm::VR;
    std::filesystem::create_directories(file.parent_path());
    gdcm::Writer writer;
    gdcm::DataSet& set = writer.GetFile().GetDataSet();
    addText(set, 0x0008, 0x0016, VR::UI, "1.2.840.10008.5.1.4.1.1.2");
    addText(set, 0x0008, 0x0018, VR::UI,
            s.uid + ".9." + std::to_string(std::hash<std::string>()(file.string()) % 100000 + 1));
    addText(set, 0x0008, 0x0060, VR::CS, s.modality);
    addText(set, 0x0008, 0x103e, VR::LO, s.description);
    addText(set, 0x0020, 0x000e, VR::UI, s.uid);
    addText(set, 0x0028, 0x1052, VR::DS, s.intercept);
    addText(set, 0x0028, 0x1053, VR::DS, s.slope);
    addGeometry(set, s);
    addPixels(set, s);
    writer.GetFile().GetHeader().SetDataSetTransferSyntax(gdcm::TransferSyntax::ExplicitVRLittleEndian);
    writer.SetFileName(file.c_str());
    if (!writer.Write()) throw std::runtime_error("could not write " + file.string());
}

}  // namespace stereonav::test
