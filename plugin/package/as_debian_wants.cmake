# SPDX-License-Identifier: BSD-3-Clause
# Run by CPack on what it installed: the names, the compression and the rights
# that Debian's policy asks of packages.
set(usr ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/program/usr)
set(doc ${usr}/share/doc/colmap-curvix)
file(RENAME ${doc}/LICENSE ${doc}/copyright)
file(READ ${CMAKE_CURRENT_LIST_DIR}/../viewer/LICENSE.three three_license)
file(APPEND ${doc}/copyright "\n${three_license}")
file(RENAME ${doc}/CHANGELOG.md ${doc}/changelog)
execute_process(COMMAND gzip -9n ${doc}/changelog
                        ${usr}/share/man/man1/colmap_curvix.1
                COMMAND_ERROR_IS_FATAL ANY)
# Whatever the umask of who cloned the source.
set(file_rights FILE_PERMISSIONS OWNER_READ OWNER_WRITE GROUP_READ WORLD_READ)
file(COPY ${CMAKE_CURRENT_LIST_DIR}/colmap-curvix
     DESTINATION ${usr}/share/lintian/overrides ${file_rights})

set(python ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/python/usr)
if(EXISTS ${python})
  file(COPY ${doc}/copyright ${doc}/changelog.gz
       DESTINATION ${python}/share/doc/python3-curvix)
  file(COPY ${CMAKE_CURRENT_LIST_DIR}/python3-curvix
       DESTINATION ${python}/share/lintian/overrides ${file_rights})
endif()
