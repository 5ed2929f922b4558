terrabench_benchmark(stack_bench SOURCES stack_bench.cpp LIBRARIES representations)
terrabench_benchmark(drill_bench SOURCES drill_bench.cpp LIBRARIES representations)
terrabench_benchmark(ght_bench SOURCES ght_bench.cpp LIBRARIES representations)
terrabench_benchmark(tin_bench SOURCES tin_bench.cpp LIBRARIES representations)
# The peer of the implicit surface's marching cubes.
find_package(VTK QUIET COMPONENTS CommonCore CommonDataModel FiltersCore)
terrabench_benchmark(implicit_bench SOURCES implicit_bench.cpp LIBRARIES representations TBB::tbb)
if(TARGET VTK::FiltersCore)
  target_link_libraries(implicit_bench PRIVATE VTK::CommonCore VTK::CommonDataModel VTK::FiltersCore)
  target_compile_definitions(implicit_bench PRIVATE TERRABENCH_FLYING_EDGES)
endif()
# The peers of refinement. OpenSubdiv is in Debian without its TBB evaluator; its OpenMP one uses all threads.
find_library(OPENSUBDIV_LIBRARY osdCPU REQUIRED)
terrabench_benchmark(subdivision_bench SOURCES subdivision_bench.cpp
                     LIBRARIES representations TBB::tbb ${OPENSUBDIV_LIBRARY} OpenMeshCore)
terrabench_benchmark(procedural_mesh_bench SOURCES procedural_mesh_bench.cpp LIBRARIES representations)
