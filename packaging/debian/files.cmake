# Run by cpack over what was installed, before it becomes a .deb: what Debian's rules ask for beside it.
file(GLOB roots ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/usr ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/*/usr)
foreach(root ${roots})
  set(doc ${root}/share/doc/stereonav)
  file(COPY ${CPACK_STEREONAV_DEBIAN_DIR}/copyright ${CPACK_STEREONAV_DEBIAN_DIR}/changelog DESTINATION ${doc}
    FILE_PERMISSIONS OWNER_READ OWNER_WRITE GROUP_READ WORLD_READ)
  file(RENAME ${doc}/changelog ${doc}/changelog.Debian)
  file(COPY ${CPACK_STEREONAV_CHANGELOG} DESTINATION ${doc} FILE_PERMISSIONS OWNER_READ OWNER_WRITE GROUP_READ WORLD_READ)
  file(RENAME ${doc}/CHANGELOG.md ${doc}/changelog)
  file(COPY ${CPACK_STEREONAV_DEBIAN_DIR}/lintian-overrides DESTINATION ${root}/share/lintian/overrides
    FILE_PERMISSIONS OWNER_READ OWNER_WRITE GROUP_READ WORLD_READ)
  file(RENAME ${root}/share/lintian/overrides/lintian-overrides ${root}/share/lintian/overrides/stereonav)
  file(GLOB pages ${root}/share/man/man1/*.1)
  # Without names and times of this build: the same sources give the same bytes.
  execute_process(COMMAND gzip -9nf ${doc}/changelog.Debian ${doc}/changelog ${pages} COMMAND_ERROR_IS_FATAL ANY)
  # What CPACK_STRIP_FILES leaves and Debian's own stripping takes: the compiler's name.
  file(GLOB programs ${root}/bin/* ${root}/lib/stereonav/*)
  execute_process(COMMAND strip --remove-section=.comment ${programs} COMMAND_ERROR_IS_FATAL ANY)
  # Folders are made with the umask of whoever runs cpack.
  file(CHMOD_RECURSE ${root} DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
endforeach()
