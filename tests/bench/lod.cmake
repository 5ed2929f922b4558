terrabench_benchmark(roam_bench SOURCES roam_bench.cpp LIBRARIES lod)
terrabench_benchmark(geomipmap_bench SOURCES geomipmap_bench.cpp LIBRARIES lod)
terrabench_benchmark(meters_bench SOURCES meters_bench.cpp LIBRARIES lod)
terrabench_benchmark(mrbsp_bench SOURCES mrbsp_bench.cpp LIBRARIES lod)
