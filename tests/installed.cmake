# Installs weft, moves the folder elsewhere, and uses it from there as a stranger would.
#
#   cmake -D BUILD=… -D WORK=… -D VERSION=… -D GENERATOR=… -D CXX=… -D NM=… -D VULKAN=… -P installed.cmake

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
    expect("${library}" "/libweft\\.so(\\.[0-9]+)*$")
endforeach()

# What the library shows: weft's own names alone.
list(GET libraries 0 library)
run(${NM} --dynamic --defined-only --demangle ${library})
expect("${out}" "weft::Simulation::step\\(\\)")
expect("${out}" "weft::version\\(\\)")
string(REGEX REPLACE "\n$" "" lines "${out}")
string(REPLACE "\n" ";" lines "${lines}")
foreach(line IN LISTS lines)
    expect("${line}" "^[0-9a-f]+ [A-Za-z] (typeinfo for |typeinfo name for |vtable for )?weft::")
endforeach()

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
run(${CMAKE_COMMAND} -S ${source}/tests/outside -B ${WORK}/outside -G ${GENERATOR} -D CMAKE_BUILD_TYPE=Release
    -D CMAKE_CXX_COMPILER=${CXX} "-DCMAKE_PREFIX_PATH=${prefix}" -D VULKAN=${VULKAN})
run(${CMAKE_COMMAND} --build ${WORK}/outside)
run(${WORK}/outside/outside ${scene})
expect("${out}" "^${VERSION}: 4096 vertices, state ${hash}\n$")
if(VULKAN)
    run(${WORK}/outside/outside_vulkan)
    expect("${out}" "^backend: must be vulkan for buffers on a device, is cpu\n4 problems\n$")
endif()
