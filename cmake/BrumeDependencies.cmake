# Every library comes from Debian 12 (scripts/setup installs them).

find_package(PkgConfig REQUIRED)
find_package(Threads REQUIRED)
find_package(glm REQUIRED)
find_package(fmt REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(TBB REQUIRED)
# By pkg-config: OpenImageIO's own CMake files also demand its tools and the Python bindings of Imath.
pkg_check_modules(OpenImageIO REQUIRED IMPORTED_TARGET GLOBAL OpenImageIO)
add_library(OpenImageIO::OpenImageIO ALIAS PkgConfig::OpenImageIO)
find_package(CLI11 REQUIRED)
find_package(TinyGLTF REQUIRED)
find_package(Vulkan REQUIRED)  # headers only: volk loads the functions
if(BRUME_BUILD_TESTS)
  find_package(GTest REQUIRED)
  find_package(rapidcheck REQUIRED)
  include(GoogleTest)
endif()

# OpenVDB's find module is installed beside its headers and not on CMake's path.
list(APPEND CMAKE_MODULE_PATH "/usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}/cmake/OpenVDB")
find_package(OpenVDB REQUIRED)
