# Target api: pages of the installed headers, by Doxygen, in build/<preset>/api. A warning is an error. Not part of a build;
# Debian's package doxygen is only needed for it.
find_package(Doxygen QUIET)
if(NOT DOXYGEN_FOUND)
  return()
endif()
set(DOXYGEN_PROJECT_BRIEF "stereo flight through terrain, CT colons and translucent media")
set(DOXYGEN_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/api)
set(DOXYGEN_FILE_PATTERNS *.h)
set(DOXYGEN_STRIP_FROM_PATH ${CMAKE_SOURCE_DIR})
set(DOXYGEN_FULL_PATH_NAMES YES)
set(DOXYGEN_EXTRACT_ALL YES)       # what a name says all of has no comment
set(DOXYGEN_WARN_AS_ERROR FAIL_ON_WARNINGS)
set(DOXYGEN_QUIET YES)
set(DOXYGEN_HAVE_DOT NO)
set(DOXYGEN_SORT_MEMBER_DOCS NO)
set(DOXYGEN_INLINE_SOURCES NO)
set(DOXYGEN_MACRO_EXPANSION YES)
set(DOXYGEN_EXPAND_ONLY_PREDEF YES)
set(DOXYGEN_PREDEFINED "STEREONAV_INLINE=inline" "STEREONAV_ISA=plain" "STEREONAV_EACH_SET(...)=__VA_ARGS__")
# The sources have plain comments: those before a declaration and behind one are marked for Doxygen, the first of a file is
# the file's. Characters that mean something to Doxygen stay what they are.
set(DOXYGEN_INPUT_FILTER "${CMAKE_CURRENT_LIST_DIR}/api_comments.sed")
list(TRANSFORM STEREONAV_HEADER_FOLDERS PREPEND ${CMAKE_SOURCE_DIR}/ OUTPUT_VARIABLE folders)
set(DOXYGEN_EXCLUDE_PATTERNS)
foreach(name ${STEREONAV_PRIVATE_FOLDERS})
  list(APPEND DOXYGEN_EXCLUDE_PATTERNS "*/${name}/*")
endforeach()
doxygen_add_docs(api ${folders} COMMENT "API pages in ${DOXYGEN_OUTPUT_DIRECTORY}/html")
