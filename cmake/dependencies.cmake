# The packaged libraries that the modules link: for the build, and installed beside terrabenchConfig.cmake for projects
# that link the static libraries. The caller sets REQUIRED or QUIET as find_package() does for a package's own config.
include(CMakeFindDependencyMacro)

find_dependency(fmt)
find_dependency(glm)
# TBB before OpenVDB: OpenVDB's finder leaves an incomplete TBB behind, on which VTK then stops.
find_dependency(TBB CONFIG)
list(APPEND CMAKE_MODULE_PATH /usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}/cmake/OpenVDB)
find_dependency(OpenVDB)
find_dependency(GDAL CONFIG)
find_dependency(embree 3 CONFIG)
find_dependency(PNG)
find_dependency(OpenMesh CONFIG)
find_dependency(nlohmann_json)
find_dependency(CLI11)
find_dependency(VTK COMPONENTS CommonCore CommonDataModel RenderingCore RenderingContext2D RenderingFreeType ChartsCore)
find_dependency(PkgConfig)
pkg_check_modules(XXHASH REQUIRED IMPORTED_TARGET libxxhash)
pkg_check_modules(WEBP REQUIRED IMPORTED_TARGET libwebp)
pkg_check_modules(HWY REQUIRED IMPORTED_TARGET libhwy)
pkg_check_modules(IMGUI REQUIRED IMPORTED_TARGET imgui)
pkg_check_modules(ZSTD REQUIRED IMPORTED_TARGET libzstd)
