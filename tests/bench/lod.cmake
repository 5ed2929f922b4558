terrabench_benchmark(roam_bench SOURCES roam_bench.cpp LIBRARIES lod)
