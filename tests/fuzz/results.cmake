terrabench_fuzz(fuzz_claims SOURCES claims.cpp LIBRARIES results)
terrabench_fuzz(fuzz_results_line SOURCES results_line.cpp LIBRARIES results)
