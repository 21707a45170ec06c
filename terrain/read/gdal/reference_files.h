// Reference systems may name files: grids of datum shifts, tables of definitions. PROJ opens any path that
// stands there.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

class OGRSpatialReference;
struct CPLXMLNode;

namespace stereonav {

// Returns the first path that a definition (WKT, PROJ string) names as one of its files; "" where it names
// none, or only names of grids without a folder, which PROJ looks up in its own data.
std::string pathInReference(std::string_view definition);

// Throws Error that names `file` where the system names a path. Null: does nothing.
void checkReference(const OGRSpatialReference* system, const std::string& file);

// Does the check of checkReference() on one element or attribute, of a virtual raster or of metadata beside a
// raster, whose text is a definition; a path in place of a definition is refused too.
void checkReferenceText(const CPLXMLNode& node, const std::string& file);

// Checks the reference systems in files that are read with a raster: <raster>.aux.xml, a .prj file, an ENVI
// header.
void checkReferencesBeside(const std::string& file);

// Checks each member "crs" of a GeoJSON file, however deep. Does nothing with other files and damaged ones.
void checkJsonReferences(const std::filesystem::path& file);

}  // namespace stereonav
