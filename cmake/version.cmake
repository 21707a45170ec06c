# What a report says of the program: version, build, libraries found and the commit, as they are when CMake runs.
find_package(Git QUIET)
set(stereonav_commit "")
if(GIT_FOUND)
  execute_process(COMMAND ${GIT_EXECUTABLE} describe --always --dirty --abbrev=12
    WORKING_DIRECTORY ${CMAKE_SOURCE_DIR} OUTPUT_VARIABLE stereonav_commit
    OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
if(stereonav_commit STREQUAL "")
  set(stereonav_commit "unknown")
endif()
set(stereonav_libraries "")
foreach(library TBB glm OpenCV GDAL GDCM DCMTK embree glfw3 fmt)
  if(DEFINED ${library}_VERSION AND NOT "${${library}_VERSION}" STREQUAL "")
    list(APPEND stereonav_libraries "${library} ${${library}_VERSION}")
  endif()
endforeach()
list(JOIN stereonav_libraries ", " stereonav_libraries)
set(stereonav_build "${PROJECT_VERSION}, ${CMAKE_BUILD_TYPE}")
if(STEREONAV_FAULTS)
  string(APPEND stereonav_build ", with deliberate faults")
endif()
set_property(SOURCE ${CMAKE_SOURCE_DIR}/app/report/machine.cpp APPEND PROPERTY COMPILE_DEFINITIONS
  "STEREONAV_COMMIT=\"${stereonav_commit}\"" "STEREONAV_LIBRARIES=\"${stereonav_libraries}\""
  "STEREONAV_BUILD=\"${stereonav_build}\"")
