# The OpenGL loader: glad writes it at build time from Debian's copy of the Khronos registry, so no generated code is
# kept in the tree. --reproducible makes it read that copy; without, it would ask the network. No extensions: 4.5 core
# alone is what all contexts share.
find_program(GLAD glad REQUIRED)

set(glad_dir ${PROJECT_BINARY_DIR}/glad)
add_custom_command(
  OUTPUT ${glad_dir}/src/gl.c ${glad_dir}/include/glad/gl.h
  COMMAND ${GLAD} --quiet --reproducible --api gl:core=4.5 --extensions= --out-path ${glad_dir} c
  COMMENT "Generating the OpenGL 4.5 loader"
  VERBATIM)
add_library(glad STATIC ${glad_dir}/src/gl.c ${glad_dir}/include/glad/gl.h)
target_include_directories(glad SYSTEM PUBLIC $<BUILD_INTERFACE:${glad_dir}/include>)
set_target_properties(glad PROPERTIES OUTPUT_NAME terrabench_glad)
