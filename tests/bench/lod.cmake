terrabench_benchmark(roam_bench SOURCES roam_bench.cpp LIBRARIES lod)
terrabench_benchmark(mrbsp_bench SOURCES mrbsp_bench.cpp LIBRARIES lod)
