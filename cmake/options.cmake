# Warnings, sanitizers and what every target of ours is compiled with.
add_library(stereonav_options INTERFACE)
target_compile_options(stereonav_options INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wno-unknown-pragmas
  -ffp-contract=off -fno-math-errno -fno-trapping-math
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)  # false positives of g++ 12 on std::string operator+ (gcc bug 105651)
if(NOT CMAKE_UNITY_BUILD_BATCH_SIZE)
  set(CMAKE_UNITY_BUILD_BATCH_SIZE 16)  # headers are half of a file's time; more would leave a core idle at the end
endif()
if(CMAKE_UNITY_BUILD)  # g++ takes a source that a unity source includes for a header
  target_compile_options(stereonav_options INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
endif()
if(STEREONAV_WERROR)
  target_compile_options(stereonav_options INTERFACE -Werror)
endif()
if(STEREONAV_SANITIZE)
  target_compile_options(stereonav_options INTERFACE -fsanitize=${STEREONAV_SANITIZE}
    -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(stereonav_options INTERFACE -fsanitize=${STEREONAV_SANITIZE})
endif()
# For sources that take longer to compile than to run: tests; under sanitizers, whose checks are most of what is compiled,
# all but the kernels. Half of the time of -O1 there, a third of that of -O3.
set(STEREONAV_SELDOM_HOT -Og)
# Checks of each pointer and of each object's type are a quarter of the time to compile, and what they would find the
# address sanitizer mostly does. Overflows, shifts, bounds, conversions and alignment stay checked, and all of them in
# the readers that .ci/fuzz builds.
if("${STEREONAV_SANITIZE}" MATCHES undefined AND NOT STEREONAV_FUZZ)
  target_compile_options(stereonav_options INTERFACE -fno-sanitize=null,object-size,vptr)
endif()
# For tests alone: a tenth more.
set(STEREONAV_TEST_CHECKS "")
if("${STEREONAV_SANITIZE}" MATCHES undefined)
  set(STEREONAV_TEST_CHECKS -fno-sanitize=alignment)
endif()
# What Debian's policy hardens programs with (dpkg-buildflags, hardening=+all), and checks of the standard library's own
# preconditions: a mistake over a stranger's file ends the program instead of running on. Sanitizers check more than that.
set(STEREONAV_HARDENED OFF)
if(NOT STEREONAV_SANITIZE AND NOT STEREONAV_FUZZ)
  set(STEREONAV_HARDENED ON)
  include(CheckCXXCompilerFlag)
  set(optimized $<OR:$<CONFIG:Release>,$<CONFIG:RelWithDebInfo>,$<CONFIG:MinSizeRel>>)
  target_compile_definitions(stereonav_options INTERFACE _GLIBCXX_ASSERTIONS)
  target_compile_options(stereonav_options INTERFACE -fstack-protector-strong -fstack-clash-protection -Wformat -Werror=format-security
    $<${optimized}:-U_FORTIFY_SOURCE> $<${optimized}:-D_FORTIFY_SOURCE=2>)
  foreach(flag -fcf-protection -mbranch-protection=standard)  # x86, arm64
    string(MAKE_C_IDENTIFIER "STEREONAV_HAS${flag}" has)
    check_cxx_compiler_flag(${flag} ${has})
    if(${has})
      target_compile_options(stereonav_options INTERFACE ${flag})
    endif()
  endforeach()
  target_link_options(stereonav_options INTERFACE -Wl,-z,relro -Wl,-z,now)
endif()
if(STEREONAV_FUZZ)  # all that is ours counts its edges
  target_compile_options(stereonav_options INTERFACE -fsanitize=fuzzer-no-link)
endif()
target_include_directories(stereonav_options INTERFACE ${CMAKE_SOURCE_DIR})

find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE_PROGRAM})
endif()
