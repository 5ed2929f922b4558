# One static library a module.
function(terrabench_module name)
  add_library(${name} STATIC ${ARGN})
endfunction()

# One GoogleTest program a module: tests/<module>/*_test.cpp become <module>_tests.
function(terrabench_tests module)
  add_executable(${module}_tests ${ARGN})
  target_link_libraries(${module}_tests PRIVATE ${module} GTest::gtest_main GTest::gmock)
  gtest_discover_tests(${module}_tests DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 300)
endfunction()
