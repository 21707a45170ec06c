# Tells ctest of the suites of a GoogleTest program: one test a suite, which is one process. A process a test would
# load the program's libraries some 2,000 times, which takes longer than most tests, and minutes with sanitizers.
#
# As a module: stereonav_discover_suites(target PROPERTIES name value ... [LOCKS_DISPLAY suites]).
# As a script (cmake -P), after each build of the program: writes the file that ctest includes.
if(NOT CMAKE_SCRIPT_MODE_FILE)
  set(stereonav_suites_script ${CMAKE_CURRENT_LIST_FILE})
  function(stereonav_discover_suites target)
    cmake_parse_arguments(ARG "" "" "PROPERTIES;LOCKS_DISPLAY" ${ARGN})
    set(file ${CMAKE_CURRENT_BINARY_DIR}/${target}_suites.cmake)
    add_custom_command(TARGET ${target} POST_BUILD BYPRODUCTS ${file}
      COMMAND ${CMAKE_COMMAND} -D "program=$<TARGET_FILE:${target}>" -D "file=${file}"
        -D "properties=${ARG_PROPERTIES}" -D "locks_display=${ARG_LOCKS_DISPLAY}" -P ${stereonav_suites_script} VERBATIM)
    # What ctest includes is there before the program is built, too.
    set(include ${CMAKE_CURRENT_BINARY_DIR}/${target}_tests.cmake)
    file(WRITE ${include} "if(EXISTS \"${file}\")\n  include(\"${file}\")\nelse()\n"
      "  add_test(${target}_NOT_BUILT ${target}_NOT_BUILT)\nendif()\n")
    set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${include})
  endfunction()
  return()
endif()

cmake_policy(VERSION 3.25)
execute_process(COMMAND ${program} --gtest_list_tests OUTPUT_VARIABLE listed RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "${program} could not list its tests: ${status}")
endif()
string(REGEX REPLACE "\\[|\\]|;" "_" listed "${listed}")
string(REPLACE "\n" ";" lines "${listed}")
set(properties_text "")
foreach(word IN LISTS properties)
  string(APPEND properties_text " [==[${word}]==]")
endforeach()
set(text "")
foreach(line IN LISTS lines)
  if(line MATCHES "^([A-Za-z0-9_/]+)\\.")  # tests of a suite follow it, indented
    set(suite "${CMAKE_MATCH_1}")
    string(CONCAT test "add_test([==[${suite}]==] [==[${program}]==] [==[--gtest_filter=${suite}.*]==])\n"
      "set_tests_properties([==[${suite}]==] PROPERTIES${properties_text})\n")
    if(suite MATCHES "Nightly$")  # takes long, and its fault is found by others: `ctest -C Nightly`
      string(APPEND test "set_tests_properties([==[${suite}]==] PROPERTIES LABELS [==[nightly;slow]==])\n")
    elseif(suite MATCHES "FullSize$")  # of whole real data, for minutes where it is slow; in programs without a label
      string(APPEND test "set_tests_properties([==[${suite}]==] PROPERTIES LABELS slow)\n")
    endif()
    if(suite IN_LIST locks_display)
      string(APPEND test "set_tests_properties([==[${suite}]==] PROPERTIES RESOURCE_LOCK display)\n")
      list(REMOVE_ITEM locks_display ${suite})
    endif()
    if(suite MATCHES "Nightly$")
      string(CONCAT test "if(CTEST_CONFIGURATION_TYPE STREQUAL \"Nightly\")\n" "${test}" "endif()\n")
    endif()
    string(APPEND text "${test}")
  endif()
endforeach()
if(locks_display)
  message(FATAL_ERROR "${program} has no suites ${locks_display}, which LOCKS_DISPLAY names")
endif()
file(WRITE ${file} "${text}")
