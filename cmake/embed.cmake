# Files inside a binary: terrabench_embed(TARGET SYMBOL FILES …) links them into TARGET as
#   std::span<const terrabench::EmbeddedFile> terrabench::SYMBOL();
# each named by its path from the project's root. They may hold any bytes: the assembler copies them, and appends a zero. Run
# with cmake -P, this file is also the generator.
if(CMAKE_SCRIPT_MODE_FILE)
  set(data "")
  set(declarations "")
  set(entries "")
  set(number 0)
  foreach(file IN LISTS FILES)
    set(label terrabench_${SYMBOL}_${number})
    math(EXPR number "${number} + 1")
    file(SIZE ${ROOT}/${file} bytes)
    string(APPEND data "${label}:\n.incbin \"${ROOT}/${file}\"\n.byte 0\n")
    string(APPEND declarations "extern \"C\" const char ${label}[];\n")
    string(APPEND entries "    {R\"name(${file})name\", {${label}, ${bytes}}},\n")
  endforeach()
  file(WRITE ${OUTPUT} "#include \"terrain/embedded.h\"\n\nasm(R\"asm(\n.pushsection .rodata\n${data}.popsection\n)asm\");\n\n\
${declarations}\nnamespace terrabench {\nnamespace {\n\nconstexpr EmbeddedFile kFiles[] = {\n${entries}};\n\n\
}  // namespace\n\nstd::span<const EmbeddedFile> ${SYMBOL}() { return kFiles; }\n\n}  // namespace terrabench\n")
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
