terrabench_benchmark(dem_bench SOURCES dem_bench.cpp LIBRARIES terrain GDAL::GDAL)

# libnoise is the packaged peer of the noise graph.
find_library(NOISE_LIBRARY noise REQUIRED)
terrabench_benchmark(noise_bench SOURCES noise_bench.cpp
                     LIBRARIES terrain TBB::tbb PkgConfig::HWY ${NOISE_LIBRARY})
terrabench_benchmark(fractal_bench SOURCES fractal_bench.cpp LIBRARIES terrain TBB::tbb ${NOISE_LIBRARY})
terrabench_benchmark(hydrology_bench SOURCES hydrology_bench.cpp LIBRARIES terrain)
# Not a Google Benchmark: it runs a program of another package.
add_executable(hydrology_peer hydrology_peer.cpp)
target_link_libraries(hydrology_peer PRIVATE terrain)
