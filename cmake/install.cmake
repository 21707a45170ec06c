# What `cmake --install` gives: the program with its modules, and, for other programs, the rooms of engine, terrain and
# colon as static libraries with their headers and a CMake package (docs/adding.md, tests/example).
install(TARGETS stereonav RUNTIME DESTINATION bin)
install(DIRECTORY ${CMAKE_BINARY_DIR}/lib/stereonav DESTINATION lib FILES_MATCHING PATTERN "stereonav_*.so"
  PATTERN "stereonav_test*" EXCLUDE)
if(TARGET stereonav_gdcm)
  install(TARGETS stereonav_gdcm RUNTIME DESTINATION lib/stereonav)
endif()

include(CMakePackageConfigHelpers)
get_property(rooms GLOBAL PROPERTY stereonav_rooms)
list(REMOVE_ITEM rooms engine_byte_image)  # for modules alone: it brings OpenCV
foreach(room ${rooms})
  string(REGEX REPLACE "^engine_" "" name ${room})
  set_target_properties(${room} PROPERTIES EXPORT_NAME ${name})  # stereonav::stereo
endforeach()
set(development COMPONENT development)
install(TARGETS ${rooms} EXPORT stereonav_targets ARCHIVE DESTINATION lib/stereonav ${development})
install(EXPORT stereonav_targets NAMESPACE stereonav:: DESTINATION lib/cmake/stereonav ${development})

# Headers of what was built. Those of modules and helpers are for them alone.
set(folders engine/base engine/math engine/simd engine/text engine/image engine/camera engine/render engine/stereo
  engine/frame engine/volume engine/light engine/nav engine/metrics)
foreach(part TERRAIN terrain COLON colon MEDIUM engine/medium DISPLAY engine/display)
  if(part MATCHES "^[A-Z]+$")
    set(built ${STEREONAV_${part}})
  elseif(built)
    list(APPEND folders ${part})
  endif()
endforeach()
foreach(folder ${folders})
  get_filename_component(parent ${folder} DIRECTORY)
  install(DIRECTORY ${CMAKE_SOURCE_DIR}/${folder} DESTINATION include/stereonav/${parent} ${development}
    FILES_MATCHING PATTERN "*.h" PATTERN "opencv" EXCLUDE PATTERN "gdal" EXCLUDE)
endforeach()

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/package.cmake.in ${CMAKE_BINARY_DIR}/stereonav-config.cmake
  INSTALL_DESTINATION lib/cmake/stereonav)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/stereonav-config-version.cmake COMPATIBILITY ExactVersion)
install(FILES ${CMAKE_BINARY_DIR}/stereonav-config.cmake ${CMAKE_BINARY_DIR}/stereonav-config-version.cmake
  DESTINATION lib/cmake/stereonav ${development})
