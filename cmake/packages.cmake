# The libraries, all from the system; versions are those of Debian 12.
find_package(TBB 2021 CONFIG REQUIRED COMPONENTS tbb)
find_package(fmt CONFIG REQUIRED)
find_package(glm 0.9.9 CONFIG REQUIRED)
find_package(OpenCV 4.6 REQUIRED COMPONENTS core imgproc imgcodecs quality)
find_package(TinyGLTF CONFIG REQUIRED)
find_package(CLI11 CONFIG REQUIRED)
find_package(nlohmann_json CONFIG REQUIRED)
find_package(PNG REQUIRED)
find_package(ZLIB REQUIRED)
find_package(embree 3.13 CONFIG REQUIRED)
find_package(PkgConfig REQUIRED)
find_package(MPI QUIET COMPONENTS C)  # without it there is no module for several processes
pkg_check_modules(FFMPEG REQUIRED IMPORTED_TARGET libavformat>=59 libavcodec>=59 libavutil>=57)
pkg_check_modules(SECCOMP REQUIRED IMPORTED_TARGET libseccomp>=2.5)
pkg_check_modules(WEBP REQUIRED IMPORTED_TARGET libwebp)
pkg_check_modules(JXL REQUIRED IMPORTED_TARGET libjxl>=0.7)
find_path(JXL_BUTTERAUGLI jxl/butteraugli.h REQUIRED)  # later versions have no such header
find_path(STB_TRUETYPE stb/stb_truetype.h REQUIRED)
find_library(STB_LIBRARY stb REQUIRED)
find_file(STEREONAV_FONT DejaVuSans.ttf PATHS /usr/share/fonts PATH_SUFFIXES truetype/dejavu dejavu TTF REQUIRED)
find_package(GDAL CONFIG REQUIRED)
pkg_check_modules(HDF5 REQUIRED IMPORTED_TARGET hdf5-serial)  # the one that GDAL reads netCDF with
find_package(toml11 CONFIG REQUIRED)
if(STEREONAV_DISPLAY)
  find_package(glfw3 3.3 CONFIG REQUIRED)
  pkg_check_modules(EPOXY REQUIRED IMPORTED_TARGET epoxy)
  pkg_check_modules(IMGUI REQUIRED IMPORTED_TARGET imgui)
endif()

find_package(BZip2 REQUIRED)
find_path(GDCM_INCLUDE gdcmReader.h PATH_SUFFIXES gdcm-3.0 REQUIRED)
file(STRINGS ${GDCM_INCLUDE}/gdcmConfigure.h GDCM_VERSION REGEX "define GDCM_VERSION")
string(REGEX REPLACE "[^0-9.]" "" GDCM_VERSION "${GDCM_VERSION}")
add_library(gdcm_libraries INTERFACE)
target_include_directories(gdcm_libraries SYSTEM INTERFACE ${GDCM_INCLUDE})
target_link_libraries(gdcm_libraries INTERFACE gdcmMSFF gdcmDSED gdcmCommon)
# The parts of DCMTK that structured reports need; its configuration file names all of its libraries, and what they need.
find_path(DCMTK_INCLUDE dcmtk/dcmsr/cmr/tid1500.h REQUIRED)  # from 3.6.3 on
file(STRINGS ${DCMTK_INCLUDE}/dcmtk/config/osconfig.h DCMTK_VERSION REGEX "define PACKAGE_VERSION ")
string(REGEX REPLACE "[^0-9.]" "" DCMTK_VERSION "${DCMTK_VERSION}")
add_library(dcmtk_libraries INTERFACE)
target_link_libraries(dcmtk_libraries INTERFACE cmr dcmsr dcmdata oflog ofstd)

if(STEREONAV_TESTS)
  # ITK's readers and its distance filter are what ours are held against. Only the modules needed, and no
  # ITK_USE_FILE, which would register every format there is. The configuration files of GDCM name programs that Debian
  # packs apart and say so in a long notice: kept quiet.
  set(saved_log_level "${CMAKE_MESSAGE_LOG_LEVEL}")
  set(CMAKE_MESSAGE_LOG_LEVEL WARNING)
  find_package(ITK 5.2 CONFIG REQUIRED
    COMPONENTS ITKCommon ITKIOImageBase ITKIOGDCM ITKIONIFTI ITKIONRRD ITKIOMeta ITKNIFTI ITKDistanceMap)
  set(CMAKE_MESSAGE_LOG_LEVEL "${saved_log_level}")
  add_library(itk_libraries INTERFACE)
  list(REMOVE_ITEM ITK_INCLUDE_DIRS /usr/include)  # searched anyway; named, it hides the compiler's own
  target_include_directories(itk_libraries SYSTEM INTERFACE ${ITK_INCLUDE_DIRS})
  target_link_libraries(itk_libraries INTERFACE ${ITK_LIBRARIES} gdcm_libraries ZLIB::ZLIB)
endif()

if(STEREONAV_TESTS)
  find_package(GTest CONFIG REQUIRED)
  find_package(benchmark CONFIG REQUIRED)
endif()
