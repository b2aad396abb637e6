# Files embedded in the program.
#
# weft_embed_file(<output> <source>): makes <output>, the file as a list of 64-bit words, little endian, padded with
# zeros. Include it in an array. Words compile ten times as fast as bytes.
if(CMAKE_SCRIPT_MODE_FILE)   # at build time
    file(READ ${SOURCE} bytes HEX)
    string(LENGTH "${bytes}" length)
    math(EXPR missing "(16 - ${length} % 16) % 16")
    string(REPEAT "0" ${missing} padding)
    set(byte "([0-9a-f][0-9a-f])")
    string(REGEX REPLACE "${byte}${byte}${byte}${byte}${byte}${byte}${byte}${byte}" "0x\\8\\7\\6\\5\\4\\3\\2\\1,\n" words
        "${bytes}${padding}")
    file(WRITE ${OUTPUT} "${words}")
else()
    set(weft_embed_script ${CMAKE_CURRENT_LIST_FILE})
    function(weft_embed_file output source)
        add_custom_command(OUTPUT ${output}
            COMMAND ${CMAKE_COMMAND} -D SOURCE=${source} -D OUTPUT=${output} -P ${weft_embed_script}
            DEPENDS ${source} ${weft_embed_script} COMMENT "Embedding ${source}" VERBATIM)
    endfunction()
endif()
