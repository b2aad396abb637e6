# Installs weft, moves the folder elsewhere, and uses it from there as a stranger would.
#
#   cmake -D BUILD=… -D WORK=… -D VERSION=… -D GENERATOR=… -D CXX=… -D NM=… -D READELF=… -D VULKAN=… -P installed.cmake

set(source ${CMAKE_CURRENT_LIST_DIR}/..)
set(prefix "${WORK}/moved here")
set(away ${WORK}/away)   # neither the sources nor the prefix: nothing may depend on the current folder

function(run)
    execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${away} RESULT_VARIABLE status
        OUTPUT_VARIABLE out ERROR_VARIABLE err)
    if(NOT status EQUAL 0)
        message(FATAL_ERROR "${ARGN}\nended with ${status}:\n${out}${err}")
    endif()
    set(out "${out}" PARENT_SCOPE)
endfunction()

function(expect text pattern)
    if(NOT text MATCHES "${pattern}")
        message(FATAL_ERROR "no \"${pattern}\" in:\n${text}")
    endif()
endfunction()

file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${away})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/first)
file(RENAME ${WORK}/first "${prefix}")

# The files, and nothing of the inside among them.
file(GLOB_RECURSE libraries "${prefix}/libweft*")
file(GLOB_RECURSE headers RELATIVE "${prefix}/include" "${prefix}/include/*.h")
file(GLOB own RELATIVE ${source}/include ${source}/include/weft/*.h)
if(NOT VULKAN)
    list(REMOVE_ITEM own weft/vulkan.h)
endif()
file(GLOB_RECURSE scenes "${prefix}/share/weft/scenes/*.json")
if(NOT "${headers}" STREQUAL "${own}" OR NOT scenes)
    message(FATAL_ERROR "headers: ${headers}\nscenes: ${scenes}")
endif()
foreach(file share/weft/scene.schema.json share/doc/weft/LICENSE)
    if(NOT EXISTS "${prefix}/${file}")
        message(FATAL_ERROR "${file} is missing")
    endif()
endforeach()
foreach(library IN LISTS libraries)
    expect("${library}" "/libweft_(core|io)\\.so(\\.[0-9]+)*$")
endforeach()

# What the libraries show: weft's own names alone.
foreach(name core io)
    file(GLOB library "${prefix}/lib*/libweft_${name}.so" "${prefix}/lib*/*/libweft_${name}.so")
    run(${NM} --dynamic --defined-only --demangle ${library})
    if(name STREQUAL core)
        expect("${out}" "weft::Simulation::step\\(\\)")
        expect("${out}" "weft::version\\(\\)")
    else()
        expect("${out}" "weft::Simulation::load\\(")
        expect("${out}" "weft::Simulation::save_scene\\(")
    endif()
    string(REGEX REPLACE "\n$" "" lines "${out}")
    string(REPLACE "\n" ";" lines "${lines}")
    foreach(line IN LISTS lines)
        expect("${line}" "^[0-9a-f]+ [A-Za-z] (typeinfo for |typeinfo name for |vtable for )?weft::")
    endforeach()
    run(${READELF} --dynamic ${library})
    string(REGEX MATCHALL "\\(NEEDED\\)[^\n]*" needed_by_${name} "${out}")
endforeach()
# The core knows no files. With Vulkan it reflects shaders.
foreach(needed IN LISTS needed_by_core)
    expect("${needed}" "\\[(libhwy|libstdc\\+\\+|libm|libgcc_s|libc|ld-linux[^.]*|libspirv-cross-c-shared)\\.so")
endforeach()
expect("${needed_by_io}" "libweft_core\\.so")
expect("${needed_by_io}" "libassimp\\.so")

# The program.
set(weft "${prefix}/bin/weft")
set(scene "${prefix}/share/weft/scenes/hanging_sheet.json")
run(${weft} info)
expect("${out}" "weft ${VERSION}")
run(${weft} check ${scene})
expect("${out}" "hanging_sheet.json: ok")
run(${weft} run ${scene} --frames 10 --quiet --stats stats.json)
file(READ ${away}/stats.json stats)
string(JSON hash GET "${stats}" state_hash)

# A project of somebody else, which then computes what the program does.
set(configure ${CMAKE_COMMAND} -S ${source}/tests/outside -G ${GENERATOR} -D CMAKE_BUILD_TYPE=Release
    -D CMAKE_CXX_COMPILER=${CXX})
run(${configure} -B ${WORK}/outside "-DCMAKE_PREFIX_PATH=${prefix}" -D VULKAN=${VULKAN})
run(${CMAKE_COMMAND} --build ${WORK}/outside)
run(${WORK}/outside/outside ${scene})
expect("${out}" "^${VERSION}: 4096 vertices, state ${hash}\n$")
if(VULKAN)
    run(${WORK}/outside/outside_vulkan)
    expect("${out}" "^backend: must be vulkan for buffers on a device, is cpu\n4 problems\n$")
endif()

# Without the library for files there is the core, and whoever asks for more hears that it is missing.
set(core_alone "${WORK}/core alone")
file(COPY "${prefix}/" DESTINATION "${core_alone}")
file(GLOB_RECURSE io "${core_alone}/*libweft_io*" "${core_alone}/*weft-io-targets*")
file(REMOVE ${io})
run(${configure} -B ${WORK}/outside_core "-DCMAKE_PREFIX_PATH=${core_alone}" -D COMPONENTS=core)
run(${CMAKE_COMMAND} --build ${WORK}/outside_core)
run(${WORK}/outside_core/outside_core)
expect("${out}" "^256 vertices\n/mesh/file: shirt.obj: cannot be read: this program reads no mesh files")
execute_process(COMMAND ${configure} -B ${WORK}/outside_io "-DCMAKE_PREFIX_PATH=${core_alone}"
    WORKING_DIRECTORY ${away} RESULT_VARIABLE status OUTPUT_QUIET ERROR_VARIABLE err)
if(status EQUAL 0)
    message(FATAL_ERROR "a component that is not installed was found")
endif()
expect("${err}" "without its component io")
