# The libraries, all from the system; versions are those of Debian 12.
find_package(TBB 2021 CONFIG REQUIRED COMPONENTS tbb)
find_package(fmt CONFIG REQUIRED)
find_package(glm 0.9.9 CONFIG REQUIRED)
find_package(OpenCV 4.6 REQUIRED COMPONENTS core imgproc imgcodecs videoio quality)
find_package(TinyGLTF CONFIG REQUIRED)
find_package(CLI11 CONFIG REQUIRED)
find_package(nlohmann_json CONFIG REQUIRED)
find_package(ZLIB REQUIRED)
if(STEREONAV_TERRAIN)
  find_package(embree 3.13 CONFIG REQUIRED)
  find_package(GDAL CONFIG REQUIRED)
  find_package(toml11 CONFIG REQUIRED)
endif()
if(STEREONAV_DISPLAY)
  find_package(glfw3 3.3 CONFIG REQUIRED)
  find_package(PkgConfig REQUIRED)
  pkg_check_modules(EPOXY REQUIRED IMPORTED_TARGET epoxy)
  pkg_check_modules(IMGUI REQUIRED IMPORTED_TARGET imgui)
endif()

if(STEREONAV_COLON)
  # ITK reads and writes the files of CT studies. Only the modules needed, and no ITK_USE_FILE, which would
  # register every format there is: colon/itk/study_itk.cpp makes the readers it needs itself. The configuration files
  # of GDCM name programs that Debian packs apart and say so in a long notice: kept quiet.
  set(saved_log_level "${CMAKE_MESSAGE_LOG_LEVEL}")
  set(CMAKE_MESSAGE_LOG_LEVEL WARNING)
  find_package(ITK 5.2 CONFIG REQUIRED
    COMPONENTS ITKCommon ITKIOImageBase ITKIOGDCM ITKIONIFTI ITKIONRRD ITKIOMeta ITKNIFTI ITKDistanceMap)
  set(CMAKE_MESSAGE_LOG_LEVEL "${saved_log_level}")
  find_path(GDCM_INCLUDE gdcmReader.h PATH_SUFFIXES gdcm-3.0 REQUIRED)
  add_library(itk_libraries INTERFACE)
  list(REMOVE_ITEM ITK_INCLUDE_DIRS /usr/include)  # searched anyway; named, it hides the compiler's own
  target_include_directories(itk_libraries SYSTEM INTERFACE ${ITK_INCLUDE_DIRS} ${GDCM_INCLUDE})
  target_link_libraries(itk_libraries INTERFACE ${ITK_LIBRARIES} gdcmMSFF gdcmDSED gdcmCommon ZLIB::ZLIB)
endif()

if(STEREONAV_TESTS)
  find_package(GTest CONFIG REQUIRED)
  find_package(benchmark CONFIG REQUIRED)
endif()
