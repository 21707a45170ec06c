# The program: its commands, the modules that only it uses, and what it is built without (app/without).
stereonav_module(video app/ffmpeg LINK engine_image PkgConfig::FFMPEG)
# All but main(): tests of the program's own functions link it too, so that nothing is compiled twice.
add_library(program STATIC)
add_dependencies(program stereonav_video)
target_link_libraries(program PUBLIC engine_light engine_mesh engine_metrics engine_peers engine_scene
  engine_late engine_letters CLI11::CLI11 nlohmann_json::nlohmann_json)
if(STEREONAV_SANITIZE)
  target_compile_options(program PRIVATE ${STEREONAV_SELDOM_HOT})
endif()

set(left_out "")   # sources of app/ that need what is left out
set(without "")    # its names; app/without/<name>.cpp stands in for it

# stereonav_part(name OPTION option LINK rooms SOURCES patterns): in, or left out with the sources that need it
function(stereonav_part name)
  cmake_parse_arguments(ARG "" "OPTION" "LINK;SOURCES" ${ARGN})
  if(${ARG_OPTION})
    target_link_libraries(program PUBLIC ${ARG_LINK})
    return()
  endif()
  target_sources(program PRIVATE ${CMAKE_SOURCE_DIR}/app/without/${name}.cpp)
  list(TRANSFORM ARG_SOURCES PREPEND ${CMAKE_SOURCE_DIR}/app/)
  file(GLOB files CONFIGURE_DEPENDS RELATIVE ${CMAKE_SOURCE_DIR}/app ${ARG_SOURCES})
  set(left_out ${left_out} ${files} PARENT_SCOPE)
  set(without ${without} ${name} PARENT_SCOPE)
endfunction()

stereonav_part(terrain OPTION STEREONAV_TERRAIN LINK terrain
  SOURCES scene/terrain_*.cpp scene/ground_*.cpp scene/survey_*.cpp scene/shown_terrain.cpp scene/medium_terrain.cpp
    scene/medium_of_terrain.cpp scene/glance_terrain.cpp
    command/bake_finer.cpp command/bake_terrain.cpp command/info_terrain.cpp command/mesh_command.cpp command/viewshed_command.cpp
    command/measure_command.cpp command/profile_command.cpp command/sun_command.cpp output/profile_chart.cpp)
if(NOT STEREONAV_TERRAIN)
  # the sky over media, too; the options in scene files
  target_sources(program PRIVATE ${CMAKE_SOURCE_DIR}/terrain/light/sky_map.cpp ${CMAKE_SOURCE_DIR}/terrain/read/toml_document.cpp)
  find_package(toml11 CONFIG REQUIRED)
  target_link_libraries(program PRIVATE toml11::toml11)
endif()
stereonav_part(colon OPTION STEREONAV_COLON LINK colon
  SOURCES scene/colon_*.cpp scene/slice_pieces.cpp scene/volume_*.cpp scene/glance_volume.cpp scene/shown_volume.cpp scene/seen_volume_light.cpp
    scene/medium_of_volume.cpp scene/volume_type.cpp scene/light_loading.cpp scene/lazy_light.cpp
    scene/traced_light.cpp command/bake_volume.cpp command/info_colon.cpp
    command/info_series.cpp command/centreline_command.cpp command/coverage_command.cpp command/colon_of.cpp
    command/findings_*.cpp command/register_command.cpp command/unfold_command.cpp)
stereonav_part(medium OPTION STEREONAV_MEDIUM LINK engine_medium
  SOURCES scene/medium_*.cpp scene/shown_medium.cpp command/info_medium.cpp view/sweep.cpp)
stereonav_part(display OPTION STEREONAV_DISPLAY LINK engine_display
  SOURCES view/*.cpp view/panel/*.cpp report/papers/gpu.cpp)
if(STEREONAV_TERRAIN AND STEREONAV_COLON AND STEREONAV_MEDIUM)
  set(whole ON)
endif()
stereonav_part(report OPTION whole SOURCES report/*.cpp report/papers/*.cpp)

if(STEREONAV_FAULTS)
  list(APPEND left_out report/faults_off.cpp)
else()
  list(APPEND left_out report/faults_on.cpp)
endif()
if(NOT MPI_C_FOUND)
  list(APPEND without MPI)
endif()
foreach(folder options scene output command view view/panel report report/papers)
  set(left_out_here ${left_out})
  list(FILTER left_out_here INCLUDE REGEX "^${folder}/[^/]*$")
  list(TRANSFORM left_out_here REPLACE "^${folder}/" "")
  stereonav_sources(program app/${folder} EXCLUDE ${left_out_here})
endforeach()
file(GLOB start_pictures CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/data/start/*.jpg)
set_source_files_properties(${CMAKE_SOURCE_DIR}/app/view/panel/start_pictures.cpp PROPERTIES
  COMPILE_DEFINITIONS STEREONAV_START="${CMAKE_SOURCE_DIR}/data/start" OBJECT_DEPENDS "${start_pictures}")
add_executable(stereonav app/main.cpp app/open_watch.cpp)
target_link_libraries(stereonav PRIVATE stereonav_options program)
list(JOIN without ", " without)
set_source_files_properties(app/options/built_without.cpp PROPERTIES COMPILE_DEFINITIONS
  "STEREONAV_VERSION=\"${PROJECT_VERSION}\";STEREONAV_DATE=\"${STEREONAV_DATE}\";STEREONAV_WITHOUT=\"${without}\"")
include(cmake/version.cmake)
