terrabench_benchmark(raytrace_bench SOURCES raytrace_bench.cpp LIBRARIES renderers representations TBB::tbb)
