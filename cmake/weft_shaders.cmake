# Shaders, compiled by glslc and embedded.
#
# glslc's optimizer is not used: it fuses products and sums, and merges constants across sums, before
# with_exact_arithmetic() could forbid it. Drivers optimize anyway.
find_program(GLSLC glslc REQUIRED)

# weft_compile_shader(<folder> <name> <source> [flag…]): makes <folder>/<name>.spv.inc, and again whenever one of its
# sources changes.
function(weft_compile_shader output name source)
    set(file ${output}/${name}.spv.inc)
    add_custom_command(OUTPUT ${file}
        COMMAND ${GLSLC} --target-env=vulkan1.2 -Werror -O0 -mfmt=num ${ARGN} -MD -MF ${file}.d -o ${file} ${source}
        DEPENDS ${source} DEPFILE ${file}.d COMMENT "Shader ${name}" VERBATIM)
endfunction()

# weft_embed_shaders(<folder> <table> <name>…): makes <folder>/<table>.inc with an array of gpu::Shader of that name.
# <table>_depends lists the dependencies of files that include it.
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

# weft_shader_table(<table> <file.comp>…): compiles and embeds a few shaders, for tests and benchmarks. Their folder is
# in <table>_folder.
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
