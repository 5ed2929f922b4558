find_package(GDAL CONFIG REQUIRED)
terrabench_benchmark(dem_bench SOURCES dem_bench.cpp LIBRARIES terrain GDAL::GDAL)
