# What `cmake --install` gives: the program with its modules (component program), and, for other programs, the rooms of
# engine, terrain and colon as static libraries with their headers and a CMake package (component development;
# docs/adding.md, tests/example).
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME program)
install(TARGETS stereonav)
# Where the program looks for them: engine/base/module.h.
set(STEREONAV_MODULES_DIR ${CMAKE_INSTALL_BINDIR}/../lib/stereonav)
cmake_path(NORMAL_PATH STEREONAV_MODULES_DIR)
get_property(modules GLOBAL PROPERTY stereonav_modules)
install(TARGETS ${modules} LIBRARY DESTINATION ${STEREONAV_MODULES_DIR} RUNTIME DESTINATION ${STEREONAV_MODULES_DIR})

include(CMakePackageConfigHelpers)
get_property(rooms GLOBAL PROPERTY stereonav_rooms)
list(REMOVE_ITEM rooms engine_byte_image engine_helper)  # for modules, and helpers, alone: they bring libraries
foreach(room ${rooms})
  string(REGEX REPLACE "^engine_" "" name ${room})
  set_target_properties(${room} PROPERTIES EXPORT_NAME ${name})  # stereonav::stereo
endforeach()
set(development COMPONENT development)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/stereonav)
install(TARGETS ${rooms} EXPORT stereonav_targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}/stereonav ${development})
install(EXPORT stereonav_targets NAMESPACE stereonav:: DESTINATION ${package_dir} ${development})

# Headers of what was built. Those of modules and helpers are for them alone.
set(STEREONAV_HEADER_FOLDERS engine/base engine/peers engine/math engine/simd engine/text engine/image engine/letters
  engine/gltf engine/camera engine/render engine/stereo engine/sampling engine/frame engine/late engine/volume engine/light
  engine/medium engine/nav engine/metrics terrain colon)
if(STEREONAV_DISPLAY)
  list(APPEND STEREONAV_HEADER_FOLDERS engine/display)
endif()
set(STEREONAV_PRIVATE_FOLDERS opencv jxl gdal mpi dcmtk gdcm picture_reader)
set(left_out)
foreach(name ${STEREONAV_PRIVATE_FOLDERS})
  list(APPEND left_out PATTERN ${name} EXCLUDE)
endforeach()
foreach(folder ${STEREONAV_HEADER_FOLDERS})
  get_filename_component(parent ${folder} DIRECTORY)
  install(DIRECTORY ${CMAKE_SOURCE_DIR}/${folder} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/stereonav/${parent} ${development}
    FILES_MATCHING PATTERN "*.h" ${left_out})
endforeach()

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/package.cmake.in ${CMAKE_BINARY_DIR}/stereonav-config.cmake
  INSTALL_DESTINATION ${package_dir} PATH_VARS STEREONAV_MODULES_DIR)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/stereonav-config-version.cmake COMPATIBILITY ExactVersion)
install(FILES ${CMAKE_BINARY_DIR}/stereonav-config.cmake ${CMAKE_BINARY_DIR}/stereonav-config-version.cmake
  DESTINATION ${package_dir} ${development})
