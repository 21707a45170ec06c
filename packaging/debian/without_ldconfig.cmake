# Run by cpack over each .deb. It gives every package with shared objects one folder below /usr/lib scripts that call
# ldconfig. Ours are modules, which ldconfig does not know, and Debian's rules want no such scripts.
foreach(package ${CPACK_PACKAGE_FILES})
  set(unpacked ${CPACK_TEMPORARY_DIRECTORY}/unpacked)
  file(REMOVE_RECURSE ${unpacked})
  execute_process(COMMAND dpkg-deb -R ${package} ${unpacked} COMMAND_ERROR_IS_FATAL ANY)
  foreach(script postinst postrm)
    if(EXISTS ${unpacked}/DEBIAN/${script})
      file(READ ${unpacked}/DEBIAN/${script} text)
      if(NOT text MATCHES "^#!/bin/sh\n\nset -e\n\nif [^\n]*\n\tldconfig\nfi\n$")
        message(FATAL_ERROR "${script} does more than to call ldconfig; packaging/debian/without_ldconfig.cmake would "
          "take it out:\n${text}")
      endif()
      file(REMOVE ${unpacked}/DEBIAN/${script})
    endif()
  endforeach()
  execute_process(COMMAND dpkg-deb --root-owner-group -b ${unpacked} ${package} OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
  file(REMOVE_RECURSE ${unpacked})
endforeach()
