// Small studies of bytes: NRRD files written by hand from the format's description.
#pragma once

#include <filesystem>
#include <fstream>
#include <glm/vec3.hpp>

namespace stereonav::test {

// Writes voxels of 1 mm; value(i, j, k) gives the samples. origin: of the first voxel, millimetres. Returns
// the file.
template <typename Value>
std::filesystem::path writeByteStudy(const std::filesystem::path& file, const glm::ivec3& size,
                                     const glm::dvec3& origin, Value value) {
    std::ofstream out(file, std::ios::binary);
    out << "NRRD0004\ntype: uchar\ndimension: 3\nsizes: " << size.x << ' ' << size.y << ' ' << size.z
        << "\nspace: left-posterior-superior\nspace directions: (1,0,0) (0,1,0) (0,0,1)\nspace origin: ("
        << origin.x << ',' << origin.y << ',' << origin.z << ")\nencoding: raw\n\n";
    for (int k = 0; k < size.z; ++k)
        for (int j = 0; j < size.y; ++j)
            for (int i = 0; i < size.x; ++i) out.put(static_cast<char>(value(i, j, k)));
    return file;
}

}  // namespace stereonav::test
