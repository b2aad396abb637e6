# Shaders, compiled by glslc and embedded.
#
# Without the compiler's optimizer: it makes one fused operation of a product and a sum, and joins constants across sums,
# before with_exact_arithmetic() could forbid it. Drivers optimize anyway.
find_program(GLSLC glslc REQUIRED)

# weft_compile_shader(<folder> <name> <source> [flag…]): <folder>/<name>.spv.inc, made again when anything that it is made of
# has changed.
function(weft_compile_shader output name source)
    set(file ${output}/${name}.spv.inc)
    add_custom_command(OUTPUT ${file}
        COMMAND ${GLSLC} --target-env=vulkan1.2 -Werror -O0 -mfmt=num ${ARGN} -MD -MF ${file}.d -o ${file} ${source}
        DEPENDS ${source} DEPFILE ${file}.d COMMENT "Shader ${name}" VERBATIM)
endfunction()

# weft_embed_shaders(<folder> <table> <name>…): <folder>/<table>.inc with an array of that name, of gpu::Shader. What whoever
# includes it depends on is in <table>_depends.
function(weft_embed_shaders output table)
    set(files ${output}/${table}.inc)
    set(arrays)
    set(entries)
    foreach(name ${ARGN})
        list(APPEND files ${output}/${name}.spv.inc)
        string(APPEND arrays "constexpr std::uint32_t ${name}_words[] = {\n#include \"${name}.spv.inc\"\n};\n")
        string(APPEND entries "    {\"${name}\", ${name}_words},\n")
    endforeach()
    file(CONFIGURE OUTPUT ${output}/${table}.inc CONTENT
        "${arrays}constexpr weft::gpu::Shader ${table}[] = {\n${entries}};\n" @ONLY)
    set(${table}_depends ${files} PARENT_SCOPE)
endfunction()

# weft_shader_table(<table> <file.comp>…): both, of a handful of shaders, for tests and benchmarks. Its folder is in
# <table>_folder.
function(weft_shader_table table)
    set(output ${PROJECT_BINARY_DIR}/shaders/${table})
    file(MAKE_DIRECTORY ${output})
    set(names)
    foreach(source ${ARGN})
        get_filename_component(name ${source} NAME_WE)
        weft_compile_shader(${output} ${name} ${source})
        list(APPEND names ${name})
    endforeach()
    weft_embed_shaders(${output} ${table} ${names})
    set(${table}_depends ${${table}_depends} PARENT_SCOPE)
    set(${table}_folder ${output} PARENT_SCOPE)
endfunction()
