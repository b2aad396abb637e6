# One static library per folder of src/, from all of its .cpp files. Files named *.test.cpp go into the test program of
# the folder. FOLDER names a folder with another name than the library, ROOT one in another place than src; WITHOUT names
# subfolders that have their own library. LIGHT: the code takes little of the time of a frame; JSON: it is LIGHT and uses
# nlohmann's JSON. A new constraint, exporter or shape is a file in its folder and needs no change here.

find_package(Threads REQUIRED)

# All modules go into one shared library, which exports only symbols marked WEFT_API.
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_CXX_VISIBILITY_PRESET hidden)
set(CMAKE_VISIBILITY_INLINES_HIDDEN ON)

# Compiler options of all targets.
add_library(weft_flags INTERFACE)
target_compile_features(weft_flags INTERFACE cxx_std_20)
target_compile_options(weft_flags INTERFACE
    -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Werror
    # No silent fused multiply-add: the same source must give the same bits on every instruction set.
    -ffp-contract=off
    # GCC 12 reports false overlaps in std::string (its bug 105651).
    $<$<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_LESS:$<CXX_COMPILER_VERSION>,13>>:-Wno-restrict>)
# Included headers take most of the time to compile a file. Files that are compiled together share them. Names in their
# unnamed namespaces must differ.
if(WEFT_UNITY)
    set(CMAKE_UNITY_BUILD ON)
    set(CMAKE_UNITY_BUILD_BATCH_SIZE 8)
    # A local name may equal a constant in another file, and GCC takes classes of a .cpp file for classes of a header.
    # Builds without unity have these warnings.
    target_compile_options(weft_flags INTERFACE -Wno-shadow
        $<$<CXX_COMPILER_ID:GNU>:-Wshadow=local> $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
endif()
if(WEFT_SANITIZE)
    target_compile_options(weft_flags INTERFACE -fsanitize=${WEFT_SANITIZE} -fno-omit-frame-pointer
        -fno-sanitize-recover=all
        # Instrumented code causes false warnings in headers of the standard library.
        $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
    if(WEFT_SANITIZE MATCHES undefined AND CMAKE_CXX_COMPILER_ID STREQUAL GNU)
        # GCC compiles twice as long with these. The address sanitizer finds most of the same errors; the preset `fuzz`,
        # with clang, has all of them.
        target_compile_options(weft_flags INTERFACE
            -fno-sanitize=null,vptr,object-size,pointer-overflow,alignment)
    endif()
    if(WEFT_SANITIZE MATCHES address AND CMAKE_CXX_COMPILER_ID STREQUAL GNU)
        # Checks of accesses are calls instead of inline code. They find the same errors, and a file compiles in 60 % of
        # the time. The loops over constraints keep inline checks (src/cpu/dependencies.cmake).
        target_compile_options(weft_flags INTERFACE --param=asan-instrumentation-with-call-threshold=0)
    endif()
    target_link_options(weft_flags INTERFACE -fsanitize=${WEFT_SANITIZE})
endif()
if(WEFT_FUZZ)   # all files are instrumented; only the fuzzers have libFuzzer's main loop
    target_compile_options(weft_flags INTERFACE -fsanitize=fuzzer-no-link)
endif()

# ccache does not cache files with precompiled headers unless it is told to trust them.
if(WEFT_PCH AND "${CMAKE_CXX_COMPILER_LAUNCHER}" MATCHES "ccache")
    list(PREPEND CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros)
    target_compile_options(weft_flags INTERFACE $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)
endif()

# For targets that include internal headers.
add_library(weft_options INTERFACE)
target_link_libraries(weft_options INTERFACE weft_flags)
target_include_directories(weft_options INTERFACE ${PROJECT_SOURCE_DIR}/include ${PROJECT_SOURCE_DIR}/src)
target_compile_definitions(weft_options INTERFACE WEFT_VERSION="${PROJECT_VERSION}")

# Linked into every program: ignores leaks of third-party libraries and drivers under the address sanitizer
# (foreign_leaks.cpp).
if(WEFT_SANITIZE MATCHES address)
    add_library(weft_foreign_leaks OBJECT ${PROJECT_SOURCE_DIR}/cmake/foreign_leaks.cpp)
endif()
function(weft_program name)
    if(TARGET weft_foreign_leaks)
        target_sources(${name} PRIVATE $<TARGET_OBJECTS:weft_foreign_leaks>)
    endif()
endfunction()

# weft_precompile(<target> <group> <header>…): the first target of a group compiles these headers, the others reuse the
# result. All targets of a group must have the same flags.
function(weft_precompile name group)
    if(NOT WEFT_PCH)
        return()
    endif()
    get_property(owner GLOBAL PROPERTY weft_precompiled_${group})
    if(owner)
        target_precompile_headers(${name} REUSE_FROM ${owner})
    else()
        set_property(GLOBAL PROPERTY weft_precompiled_${group} ${name})
        target_precompile_headers(${name} PRIVATE ${ARGN})
    endif()
    # GCC 12 gives false warnings for the standard library's strings once they are precompiled. The presets
    # core and tsan have no precompiled headers and keep these warnings.
    if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13 AND NOT group MATCHES tests)
        target_compile_options(${name} PRIVATE -Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread)
    endif()
endfunction()

# weft_light(<target>): its code takes little of the time of a frame. -O3 would compile longer and gain nothing.
function(weft_light name)
    target_compile_options(${name} PRIVATE $<$<CONFIG:Release>:-O2>)
endfunction()

# Headers that most files of a library include, plus nlohmann's JSON, which takes a second to compile, for its users.
set(weft_library_headers <algorithm> <array> <cmath> <cstdint> <cstring> <filesystem> <functional> <limits> <memory>
    <numbers> <optional> <random> <span> <string> <string_view> <utility> <vector>)
function(weft_precompile_json name)
    weft_light(${name})
    weft_precompile(${name} json ${weft_library_headers} <iostream> <nlohmann/json.hpp>)
endfunction()

# weft_discover_tests(<program> <source>… [PREFIX text] [FILTER gtest-filter] [LABELS label…] [ENVIRONMENT …]): makes
# one CTest test per GoogleTest test, with the labels from LABELS and from comments in the sources
# (cmake/weft_test_labels.cmake).
function(weft_discover_tests name)
    cmake_parse_arguments(ARG "" "PREFIX;FILTER" "SOURCES;LABELS;ENVIRONMENT" ${ARGN})
    # Distance fields and pipelines are kept in the build's folder, not in the user's.
    set(properties TIMEOUT 600 ENVIRONMENT_MODIFICATION WEFT_CACHE=set:${PROJECT_BINARY_DIR}/cache)
    if(ARG_ENVIRONMENT)
        list(APPEND properties ENVIRONMENT ${ARG_ENVIRONMENT})
    endif()
    gtest_discover_tests(${name} TEST_PREFIX "${ARG_PREFIX}" TEST_FILTER "${ARG_FILTER}" DISCOVERY_TIMEOUT 60
        TEST_LIST weft_discovered PROPERTIES ${properties})
    list(TRANSFORM ARG_SOURCES REPLACE "^([^/].*)" "${CMAKE_CURRENT_SOURCE_DIR}/\\1")
    string(MAKE_C_IDENTIFIER "${name}_${ARG_PREFIX}" file)
    set(file ${CMAKE_CURRENT_BINARY_DIR}/${file}_labels.cmake)
    file(CONFIGURE OUTPUT ${file} CONTENT [[
set(weft_prefix "@ARG_PREFIX@")
set(weft_labels "@ARG_LABELS@")
set(weft_sources "@ARG_SOURCES@")
include("@PROJECT_SOURCE_DIR@/cmake/weft_test_labels.cmake")
]] @ONLY)
    set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${file})
endfunction()

# weft_test(<program> [WORLD] SOURCES <file>… LINK <library>… [LABELS label…]). WORLD: most of the files use a World,
# whose header is then precompiled too.
function(weft_test name)
    cmake_parse_arguments(ARG "WORLD" "" "SOURCES;LINK;LABELS" ${ARGN})
    add_executable(${name} ${ARG_SOURCES})
    weft_program(${name})
    target_link_libraries(${name} PRIVATE ${ARG_LINK} weft_options GTest::gtest_main GTest::gmock)
    target_compile_definitions(${name} PRIVATE WEFT_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
        WEFT_BINARY_DIR="${PROJECT_BINARY_DIR}")
    # The code under test is optimized; the tests themselves compile in half the time at this level.
    target_compile_options(${name} PRIVATE $<$<CONFIG:Release>:-O1>)
    set(headers <gtest/gtest.h> <gmock/gmock.h> <algorithm> <array> <cmath> <filesystem> <fstream> <functional>
        <memory> <numeric> <optional> <random> <span> <string> <string_view> <vector>)
    if(ARG_WORLD)
        weft_precompile(${name} world_tests ${headers} ${PROJECT_SOURCE_DIR}/src/solver/world/world.h)
    else()
        weft_precompile(${name} tests ${headers})
    endif()
    weft_discover_tests(${name} SOURCES ${ARG_SOURCES} LABELS ${ARG_LABELS})
endfunction()

function(weft_module name)
    cmake_parse_arguments(ARG "JSON;LIGHT" "FOLDER;ROOT" "DEPENDS;WITHOUT" ${ARGN})
    if(NOT ARG_FOLDER)
        set(ARG_FOLDER ${name})
    endif()
    if(NOT ARG_ROOT)
        set(ARG_ROOT src)
    endif()
    set(folder ${PROJECT_SOURCE_DIR}/${ARG_ROOT}/${ARG_FOLDER})
    file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${folder}/*.cpp)
    foreach(other ${ARG_WITHOUT})
        list(FILTER sources EXCLUDE REGEX "^${folder}/${other}/")
    endforeach()
    set(tests ${sources})
    list(FILTER tests INCLUDE REGEX "\\.test\\.cpp$")
    list(FILTER sources EXCLUDE REGEX "\\.test\\.cpp$")

    add_library(weft_${name} STATIC ${sources})
    if(NOT name MATCHES "^(weft|io)$")   # weft::weft and weft::io are the installed libraries (weft_library.cmake)
        add_library(weft::${name} ALIAS weft_${name})
    endif()
    target_link_libraries(weft_${name} PUBLIC weft_options Threads::Threads)
    if(NOT ARG_ROOT STREQUAL src)
        target_include_directories(weft_${name} PUBLIC ${PROJECT_SOURCE_DIR}/${ARG_ROOT})
    endif()
    foreach(floor ${ARG_DEPENDS})
        target_link_libraries(weft_${name} PUBLIC weft_${floor})
    endforeach()
    if(EXISTS ${folder}/dependencies.cmake)   # third-party packages for this folder only
        include(${folder}/dependencies.cmake)
    endif()
    if(ARG_JSON)
        weft_precompile_json(weft_${name})
    elseif(ARG_LIGHT)
        weft_light(weft_${name})
        if(CMAKE_BUILD_TYPE STREQUAL Release)
            weft_precompile(weft_${name} light_libraries ${weft_library_headers})
        else()   # the same flags as all libraries
            weft_precompile(weft_${name} libraries ${weft_library_headers})
        endif()
    else()
        weft_precompile(weft_${name} libraries ${weft_library_headers})
    endif()

    if(WEFT_TESTS AND tests)
        weft_test(${name}_tests SOURCES ${tests} LINK weft_${name})
    endif()
endfunction()
