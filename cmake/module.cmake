# One static library per module: libterrabench_<module>.a, which others link as terrabench::<module>: all sources of
# its folder but the program's terrabench.cpp, and those named (generated ones). A new file is picked up by the next build.
# Headers are included by their path from the project's root.
function(terrabench_module name)
  file(GLOB_RECURSE headers CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.h)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  list(FILTER sources EXCLUDE REGEX "/terrabench\\.cpp$")
  add_library(${name} STATIC ${sources} ${ARGN})
  add_library(terrabench::${name} ALIAS ${name})
  target_sources(${name} PUBLIC FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR} FILES ${headers})
  target_compile_features(${name} PUBLIC cxx_std_20)
  set_target_properties(${name} PROPERTIES OUTPUT_NAME terrabench_${name})
endfunction()

# One GoogleTest program per module: all sources of tests/<module>/ become <module>_tests, linked with the module and the
# libraries named. A new file is picked up by the next build. ctest runs each test in a process of its own; with a
# sanitizer, which takes long to start and to end one, a few processes run a share of the program each.
function(terrabench_tests module)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  add_executable(${module}_tests ${sources})
  target_link_libraries(${module}_tests PRIVATE ${module} GTest::gtest_main GTest::gmock ${ARGN})
  if(NOT TERRABENCH_SANITIZE)
    # Halves the tests' compile time: most of it is GoogleTest's headers, and test code need not be fast.
    # GCC 12 takes precompiled headers for the program's own and warns wrongly of moves in std::string (bug 105329).
    target_compile_options(${module}_tests PRIVATE $<$<CONFIG:Release>:-O1>
      $<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds> $<$<CXX_COMPILER_ID:GNU>:-Wno-stringop-overread>)
    target_precompile_headers(${module}_tests PRIVATE <algorithm> <array> <cmath> <filesystem> <map> <memory> <optional>
      <set> <span> <string> <vector> <fmt/format.h> <fmt/ranges.h> <gmock/gmock.h> <gtest/gtest.h>)
    gtest_discover_tests(${module}_tests DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 300 LABELS ${module}_tests)
    return()
  endif()
  # Checks of pointers that were cast: GoogleTest's virtual calls make them a quarter of the compile time.
  target_compile_options(${module}_tests PRIVATE -fno-sanitize=alignment,vptr)
  set(shards 4)
  if(TERRABENCH_SANITIZE MATCHES thread)
    set(shards 16) # each test takes ten times as long
    target_sources(${module}_tests PRIVATE ${PROJECT_SOURCE_DIR}/tests/one_tbb_thread.cpp)
  endif()
  math(EXPR last "${shards} - 1")
  foreach(shard RANGE ${last})
    add_test(NAME ${module}_tests.${shard} COMMAND ${module}_tests --gtest_brief=1)
    set_tests_properties(${module}_tests.${shard} PROPERTIES
      TIMEOUT 1800 LABELS ${module}_tests ENVIRONMENT "GTEST_TOTAL_SHARDS=${shards};GTEST_SHARD_INDEX=${shard}")
  endforeach()
endfunction()
