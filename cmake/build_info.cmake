# results/build_info.h: git revision, compiler and flags, for the provenance of every measurement.
# terrabench_build_info(TARGET) generates it at every build and writes it only when it changed, so that nothing is
# recompiled without need. Run with cmake -P, this file is the generator.
if(CMAKE_SCRIPT_MODE_FILE)
  set(revision unknown)
  set(dirty true)
  find_program(GIT git)
  if(GIT)
    # Sources unpacked inside some other repository have no revision of their own.
    execute_process(COMMAND ${GIT} -C ${ROOT} ls-files --error-unmatch CMakeLists.txt
                    OUTPUT_QUIET ERROR_QUIET RESULT_VARIABLE failed)
    if(NOT failed)
      execute_process(COMMAND ${GIT} -C ${ROOT} rev-parse HEAD
                      OUTPUT_VARIABLE head OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
    endif()
    # An untracked file may be code, so it makes the checkout dirty too.
    execute_process(COMMAND ${GIT} -C ${ROOT} status --porcelain --untracked-files=normal
                    OUTPUT_VARIABLE changes ERROR_QUIET RESULT_VARIABLE status_failed)
    if(NOT failed)
      set(revision ${head})
    endif()
    if(NOT failed AND NOT status_failed AND "${changes}" STREQUAL "")
      set(dirty false)
    endif()
  endif()
  string(CONCAT content "#pragma once\n\nnamespace terrabench {\n\n"
    "inline constexpr char kGitRevision[] = \"${revision}\";\n"
    "inline constexpr bool kGitDirty = ${dirty};\n"
    "inline constexpr char kCompiler[] = \"${COMPILER}\";\n"
    "inline constexpr char kFlags[] = R\"flags(${FLAGS})flags\";\n"
    "inline constexpr char kBuildType[] = \"${BUILD_TYPE}\";\n\n}  // namespace terrabench\n")
  set(before "")
  if(EXISTS ${OUTPUT})
    file(READ ${OUTPUT} before)
  endif()
  if(NOT before STREQUAL content)
    file(WRITE ${OUTPUT} "${content}")
  endif()
  return()
endif()

function(terrabench_build_info target)
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/generated)
  string(TOUPPER "${CMAKE_BUILD_TYPE}" type)
  get_directory_property(options COMPILE_OPTIONS)
  string(GENEX_STRIP "${options}" options)
  string(JOIN " " flags ${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${type}} -std=c++${CMAKE_CXX_STANDARD} ${options})
  add_custom_target(${target}_build_info
    COMMAND ${CMAKE_COMMAND} -DROOT=${PROJECT_SOURCE_DIR} -DOUTPUT=${folder}/results/build_info.h
            "-DCOMPILER=${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}" "-DFLAGS=${flags}"
            "-DBUILD_TYPE=${CMAKE_BUILD_TYPE}" -P ${PROJECT_SOURCE_DIR}/cmake/build_info.cmake
    BYPRODUCTS ${folder}/results/build_info.h VERBATIM)
  add_dependencies(${target} ${target}_build_info)
  target_include_directories(${target} PRIVATE ${folder})
endfunction()
