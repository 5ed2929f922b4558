# find_package(terrabench) defines terrabench::terrain, ::representations, ::lod, ::renderers, ::results, ::viewer
# and ::experiments.
# A project that links ::results or ::experiments must enable C beside C++: VTK asks for it.
include(${CMAKE_CURRENT_LIST_DIR}/dependencies.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/terrabenchTargets.cmake)
