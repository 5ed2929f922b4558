find_package(GDAL CONFIG REQUIRED)
terrabench_benchmark(dem_bench SOURCES dem_bench.cpp LIBRARIES terrain GDAL::GDAL)
terrabench_benchmark(hydrology_bench SOURCES hydrology_bench.cpp LIBRARIES terrain)
# Not a Google Benchmark: it runs a program of another package.
add_executable(hydrology_peer hydrology_peer.cpp)
target_link_libraries(hydrology_peer PRIVATE terrain)
