# What `cmake --install` puts where, for find_package(brume), for pkg-config and for Debian packages.
# Components: runtime (libbrume.so), dev (headers, CMake and pkg-config files), vdb, tools.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(brume_cmake_dir ${CMAKE_INSTALL_LIBDIR}/cmake/brume)
install(TARGETS libbrume EXPORT brumeTargets
  LIBRARY COMPONENT runtime NAMELINK_COMPONENT dev
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT dev
  INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(TARGETS libbrume_vdb EXPORT brumeTargets
  LIBRARY COMPONENT vdb NAMELINK_COMPONENT dev
  INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(TARGETS brume RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT tools)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/brume DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
  COMPONENT dev)
# Includes for shaders of hosts, with what they include, at the same places to each other.
foreach(folder host common shadows gpu)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/shaders/${folder}
    DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/brume/glsl COMPONENT dev
    FILES_MATCHING PATTERN "*.glsl" PATTERN "*.h")
endforeach()
install(EXPORT brumeTargets NAMESPACE brume:: DESTINATION ${brume_cmake_dir} COMPONENT dev)
configure_package_config_file(${PROJECT_SOURCE_DIR}/src/host/brumeConfig.cmake.in
  ${CMAKE_BINARY_DIR}/brumeConfig.cmake INSTALL_DESTINATION ${brume_cmake_dir})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/brumeConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/brumeConfig.cmake ${CMAKE_BINARY_DIR}/brumeConfigVersion.cmake
  DESTINATION ${brume_cmake_dir} COMPONENT dev)
# The prefix is known when it is installed, not before: `cmake --install --prefix` may change it.
install(CODE "
  set(PROJECT_VERSION ${PROJECT_VERSION})
  set(CMAKE_INSTALL_LIBDIR ${CMAKE_INSTALL_LIBDIR})
  set(CMAKE_INSTALL_INCLUDEDIR ${CMAKE_INSTALL_INCLUDEDIR})
  set(CMAKE_INSTALL_DATADIR ${CMAKE_INSTALL_DATADIR})
  configure_file(\"${PROJECT_SOURCE_DIR}/src/host/brume.pc.in\" \"${CMAKE_BINARY_DIR}/brume.pc\" @ONLY)
  file(INSTALL \"${CMAKE_BINARY_DIR}/brume.pc\"
       DESTINATION \"\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_LIBDIR}/pkgconfig\")
" COMPONENT dev)

# Debian packages: libbrume0.1, libbrume-dev, libbrume-vdb0.1, brume.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME brume)
set(CPACK_PACKAGE_VENDOR "The Brume authors")
set(CPACK_PACKAGE_CONTACT "The Brume authors <brume@example.org>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Particle and volumetric effects with order-independent transparency")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_COMPRESSION_TYPE gzip)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL runtime dev vdb tools)
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${CMAKE_BINARY_DIR}/lib)
set(brume_so ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME libbrume${brume_so})
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_VDB_PACKAGE_NAME libbrume-vdb${brume_so})
set(CPACK_DEBIAN_VDB_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_DEV_PACKAGE_NAME libbrume-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS
    "libbrume${brume_so} (= ${PROJECT_VERSION}), libbrume-vdb${brume_so} (= ${PROJECT_VERSION}), libvulkan-dev")
set(CPACK_DEBIAN_TOOLS_PACKAGE_NAME brume)
set(CPACK_DEBIAN_TOOLS_PACKAGE_SECTION graphics)
include(CPack)
