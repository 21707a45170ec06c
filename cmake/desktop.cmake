# What a shell and a desktop look for beside the program: its man page and the completion of bash, which it prints
# itself out of its table of options, and, with a window, its entry in menus, its icon, the types of its files and what
# shops of software say of it (packaging/).
set(pages_dir ${CMAKE_BINARY_DIR}/pages)
file(MAKE_DIRECTORY ${pages_dir})

# stereonav_page(name words destination): what `stereonav WORDS` prints, as a file
function(stereonav_page name words destination)
  set(page ${pages_dir}/${name})
  add_custom_command(OUTPUT ${page} DEPENDS stereonav
    COMMAND ${CMAKE_COMMAND} -D program=$<TARGET_FILE:stereonav> -D words=${words} -D page=${page}
      -P ${CMAKE_SOURCE_DIR}/cmake/program_page.cmake VERBATIM)
  set_property(GLOBAL APPEND PROPERTY stereonav_pages ${page})
  install(FILES ${page} DESTINATION ${destination})
endfunction()

if(NOT CMAKE_CROSSCOMPILING)  # the program has to run here
  stereonav_page(stereonav.1 man ${CMAKE_INSTALL_MANDIR}/man1)
  stereonav_page(stereonav "completion bash" ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
  get_property(pages GLOBAL PROPERTY stereonav_pages)
  add_custom_target(stereonav_pages ALL DEPENDS ${pages})
endif()

if(STEREONAV_DISPLAY)
  set(packaging ${CMAKE_SOURCE_DIR}/packaging)
  # An id begins with a domain that its giver owns. The project owns none, so it takes one that nobody can own (RFC 6761).
  set(STEREONAV_APP_ID invalid.stereonav.stereonav CACHE STRING
    "Name of the program's entry in menus and AppStream, from a domain of whoever distributes it: org.example.stereonav")
  set(metainfo ${pages_dir}/${STEREONAV_APP_ID}.metainfo.xml)
  configure_file(${packaging}/metainfo.xml.in ${metainfo} @ONLY)
  install(FILES ${metainfo} DESTINATION ${CMAKE_INSTALL_DATADIR}/metainfo)
  install(FILES ${packaging}/entry.desktop DESTINATION ${CMAKE_INSTALL_DATADIR}/applications
    RENAME ${STEREONAV_APP_ID}.desktop)
  install(FILES ${packaging}/mime_types.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/mime/packages RENAME stereonav.xml)
  install(FILES ${packaging}/icon.png DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/256x256/apps
    RENAME stereonav.png)
endif()
