# One static library per module.
function(terrabench_module name)
  add_library(${name} STATIC ${ARGN})
  target_include_directories(${name} PUBLIC ${PROJECT_SOURCE_DIR})
endfunction()

# One GoogleTest program per module: all sources of tests/<module>/ become <module>_tests, linked with the module and the
# libraries named. A new file is picked up by the next build.
function(terrabench_tests module)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  add_executable(${module}_tests ${sources})
  target_link_libraries(${module}_tests PRIVATE ${module} GTest::gtest_main GTest::gmock ${ARGN})
  gtest_discover_tests(${module}_tests DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 300)
endfunction()
