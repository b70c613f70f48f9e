# Puts what lies elsewhere in a package than below another prefix into its place, before CPack packs it.
set(root ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/usr)
if(EXISTS ${root}/lib/python)
  file(MAKE_DIRECTORY ${root}/lib/python3)
  file(RENAME ${root}/lib/python ${root}/lib/python3/dist-packages)
endif()
file(RENAME ${root}/share/doc/hookpoint/LICENSE ${root}/share/doc/hookpoint/copyright)
