# One folder is one target; its link line says whom it may know.
include(GNUInstallDirs)
include(CheckCXXCompilerFlag)

# Sources of `folder` into `target`. A file *_kernel.cpp is compiled once for each instruction set,
# with STEREONAV_ISA naming the namespace (plain, avx2, avx512); it is chosen at run time.
function(stereonav_sources target folder)
  cmake_parse_arguments(ARG "" "" "EXCLUDE;ONLY" ${ARGN})
  if(ARG_ONLY)
    list(TRANSFORM ARG_ONLY PREPEND ${CMAKE_SOURCE_DIR}/${folder}/)
    set(sources ${ARG_ONLY})
  else()
    file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/${folder}/*.cpp)
    foreach(name ${ARG_EXCLUDE})
      list(REMOVE_ITEM sources ${CMAKE_SOURCE_DIR}/${folder}/${name})
    endforeach()
  endif()
  set(kernels ${sources})
  list(FILTER kernels INCLUDE REGEX "_kernel\\.cpp$")
  list(FILTER sources EXCLUDE REGEX "_kernel\\.cpp$")
  target_sources(${target} PRIVATE ${sources})
  target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:stereonav_options>)  # who uses it installed has its own
  if(STEREONAV_SANITIZE AND NOT STEREONAV_FUZZ)
    target_compile_options(${target} PRIVATE ${STEREONAV_SELDOM_HOT})
  endif()
  if(kernels)
    stereonav_kernels(${target} ${kernels})
  endif()
endfunction()

function(stereonav_kernels target)
  set(flags_plain "")
  set(flags_avx2 -mavx2 -mfma)
  set(flags_avx512 -mavx512f -mavx512dq -mavx512bw -mavx512vl -mavx512cd -mfma -mprefer-vector-width=512
    -Wno-uninitialized -Wno-maybe-uninitialized)  # false positives in g++ 12's own intrinsics (gcc bug 105593)
  # g++ copies structs of several vectors with rep movs, which waits for each vector that was just stored.
  set(copies -mmemcpy-strategy=vector_loop:-1:noalign)
  check_cxx_compiler_flag(${copies} STEREONAV_COPIES_BY_VECTOR)
  if(NOT STEREONAV_COPIES_BY_VECTOR)  # clang, arm64
    set(copies "")
  endif()
  foreach(isa plain avx2 avx512)
    add_library(${target}_${isa} OBJECT ${ARGN})
    target_link_libraries(${target}_${isa} PRIVATE stereonav_options)
    target_compile_options(${target}_${isa} PRIVATE ${flags_${isa}} ${copies})
    target_compile_definitions(${target}_${isa} PRIVATE STEREONAV_ISA=${isa} STEREONAV_ISA_${isa}=1)
    set_target_properties(${target}_${isa} PROPERTIES UNITY_BUILD OFF)
    target_sources(${target} PRIVATE $<TARGET_OBJECTS:${target}_${isa}>)
  endforeach()
endfunction()

# stereonav_room(folder [NAME target] [ONLY files] [EXCLUDE files] [LINK targets] [MODULES modules] [SHARED_WITH_MODULES])
# MODULES: modules and helpers that its functions load or start when first called. SHARED_WITH_MODULES: modules may link it too; each then has
# a copy of its own, which is hidden from the others.
function(stereonav_room folder)
  cmake_parse_arguments(ARG "SHARED_WITH_MODULES" "NAME" "ONLY;EXCLUDE;LINK;MODULES" ${ARGN})
  if(ARG_NAME)
    set(name ${ARG_NAME})
  else()
    string(REPLACE "/" "_" name ${folder})
  endif()
  file(GLOB any CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/${folder}/*.cpp)
  if(NOT any)
    add_library(${name} INTERFACE)
    target_link_libraries(${name} INTERFACE ${ARG_LINK})
    stereonav_installed(${name})
    return()
  endif()
  add_library(${name} STATIC)
  stereonav_sources(${name} ${folder} ONLY ${ARG_ONLY} EXCLUDE ${ARG_EXCLUDE})
  target_link_libraries(${name} PUBLIC ${ARG_LINK})
  if(ARG_SHARED_WITH_MODULES)
    set_target_properties(${name} PROPERTIES POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden)
  endif()
  foreach(module ${ARG_MODULES})
    if(TARGET stereonav_${module})  # else its library is not here, and a call of its functions says so
      add_dependencies(${name} stereonav_${module})
    endif()
  endforeach()
  if(NOT folder MATCHES "^app/")
    stereonav_installed(${name})
  endif()
endfunction()

# Other programs may link it: cmake/install.cmake.
function(stereonav_installed name)
  set_property(GLOBAL APPEND PROPERTY stereonav_rooms ${name})
  target_include_directories(${name} INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/stereonav>)
  target_compile_features(${name} INTERFACE cxx_std_20)
endfunction()

# A part of the program that is loaded when first called (engine/base/module.h): all sources of `folder` in
# lib/stereonav/stereonav_<name>.so.
# stereonav_module(name folder [ONLY files] [LINK targets])
function(stereonav_module name folder)
  cmake_parse_arguments(ARG "" "" "ONLY;LINK" ${ARGN})
  set(target stereonav_${name})
  set_property(GLOBAL APPEND PROPERTY stereonav_modules ${target})
  add_library(${target} MODULE)
  stereonav_sources(${target} ${folder} ONLY ${ARG_ONLY})
  target_link_libraries(${target} PRIVATE engine_base ${ARG_LINK})
  # Everything it needs itself is there when it links, and bound when it loads. clang's sanitizers are in the program.
  if(NOT STEREONAV_FUZZ)
    target_link_options(${target} PRIVATE -Wl,--no-undefined)
  endif()
  target_link_options(${target} PRIVATE -Wl,-z,now)
  set_target_properties(${target} PROPERTIES PREFIX "" CXX_VISIBILITY_PRESET hidden
    LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/lib/stereonav)
endfunction()

# A part of the program that runs as a process of its own when first asked (engine/base/helper_program.h): all sources of
# `folder` in lib/stereonav/stereonav_<name>, with engine/helper.
# stereonav_helper(name folder [ONLY files] [LINK targets])
function(stereonav_helper name folder)
  cmake_parse_arguments(ARG "" "" "ONLY;LINK" ${ARGN})
  set(target stereonav_${name})
  set_property(GLOBAL APPEND PROPERTY stereonav_modules ${target})  # installed beside the modules
  add_executable(${target})
  stereonav_sources(${target} ${folder} ONLY ${ARG_ONLY})
  target_link_libraries(${target} PRIVATE engine_helper ${ARG_LINK})
  set_target_properties(${target} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/lib/stereonav)
endfunction()
