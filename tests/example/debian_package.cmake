# Makes the Debian package of BUILD in WORK and holds what lies in it, what it depends on and what lintian says of it.
cmake_minimum_required(VERSION 3.25)  # of its policies
include(${CMAKE_CURRENT_LIST_DIR}/run.cmake)

file(REMOVE_RECURSE ${WORK})
# As from a shell that gives new files to their owner alone: nobody else could read what it installs.
run(sh -c "umask 077 && exec \"$0\" \"$@\"" ${CPACK} -G DEB -B ${WORK} --config ${BUILD}/CPackConfig.cmake)
file(GLOB packages ${WORK}/*.deb)
list(LENGTH packages count)
if(NOT count EQUAL 1)
  message(FATAL_ERROR "expected one package, got: ${packages}")
endif()

run(dpkg-deb -c ${packages})
string(REGEX REPLACE "\n" ";" listed "${output}")
set(names "")
foreach(line ${listed})
  if(NOT line MATCHES "^(drwxr-xr-x|-rw-r--r--|-rwxr-xr-x) root/root .* [.](/.*)$")
    message(FATAL_ERROR "not for everybody to read, or not root's: ${line}")
  endif()
  set(name ${CMAKE_MATCH_2})
  if(NOT name MATCHES "/$")
    list(APPEND names ${name})
  endif()
endforeach()
# All of it, so that nothing comes in unseen.
file(GLOB modules RELATIVE ${BUILD} ${BUILD}/lib/stereonav/stereonav_*)
list(FILTER modules EXCLUDE REGEX "stereonav_test")
set(expected bin/stereonav ${modules} share/bash-completion/completions/stereonav share/man/man1/stereonav.1.gz
  share/doc/stereonav/changelog.Debian.gz share/doc/stereonav/changelog.gz share/doc/stereonav/copyright)
if(DISPLAY)
  list(APPEND expected share/applications/${APP_ID}.desktop share/icons/hicolor/256x256/apps/stereonav.png
    share/metainfo/${APP_ID}.metainfo.xml share/mime/packages/stereonav.xml)
endif()
list(TRANSFORM expected PREPEND /usr/)
list(SORT expected)
list(SORT names)
if(NOT "${names}" STREQUAL "${expected}")
  message(FATAL_ERROR "expected ${expected}\ngot ${names}")
endif()

# Of scripts there is none: triggers of other packages do what is to do.
run(dpkg-deb -I ${packages})
if(output MATCHES "postinst|postrm|preinst|prerm")
  message(FATAL_ERROR "the package runs scripts:\n${output}")
endif()
run(dpkg-deb -f ${packages} Depends)
set(needed libc6 libtbb12)
if(DISPLAY)  # the last: what no tool sees
  list(APPEND needed libglfw3 libgl1 libxrandr2)
endif()
foreach(name ${needed})
  if(NOT output MATCHES "(^|, )${name}( |,|\n|$)")
    message(FATAL_ERROR "${name} is not in Depends: ${output}")
  endif()
endforeach()

find_program(LINTIAN lintian)
if(LINTIAN)
  run(${LINTIAN} --fail-on error,warning ${packages})
else()
  message("not checked by lintian, which is not installed")
endif()
