# The OpenGL loader, which glad generates at build time from Debian's copy of the Khronos registry. --reproducible makes
# glad read that copy instead of the network's. No extensions: all contexts share 4.5 core and nothing more.
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
