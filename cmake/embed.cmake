# Text files inside a binary: terrabench_embed(TARGET SYMBOL FILES …) compiles them into TARGET as
#   std::span<const terrabench::EmbeddedFile> terrabench::SYMBOL();
# each named by its path from the project's root. Run with cmake -P, this file is also the generator.
if(CMAKE_SCRIPT_MODE_FILE)
  set(entries "")
  foreach(file IN LISTS FILES)
    file(READ ${ROOT}/${file} text)
    string(APPEND entries "    {R\"name(${file})name\",\n     R\"embedded(${text})embedded\"},\n")
  endforeach()
  file(WRITE ${OUTPUT} "#include \"terrain/embedded.h\"\n\nnamespace terrabench {\nnamespace {\n\n\
constexpr EmbeddedFile kFiles[] = {\n${entries}};\n\n}  // namespace\n\n\
std::span<const EmbeddedFile> ${SYMBOL}() { return kFiles; }\n\n}  // namespace terrabench\n")
  return()
endif()

function(terrabench_embed target symbol)
  set(output ${CMAKE_CURRENT_BINARY_DIR}/${symbol}.cpp)
  list(TRANSFORM ARGN PREPEND ${PROJECT_SOURCE_DIR}/ OUTPUT_VARIABLE inputs)
  add_custom_command(OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -DROOT=${PROJECT_SOURCE_DIR} -DSYMBOL=${symbol} -DOUTPUT=${output}
            "-DFILES=${ARGN}" -P ${PROJECT_SOURCE_DIR}/cmake/embed.cmake
    DEPENDS ${inputs} ${PROJECT_SOURCE_DIR}/cmake/embed.cmake COMMENT "Embedding ${symbol}" VERBATIM)
  target_sources(${target} PRIVATE ${output})
endfunction()
