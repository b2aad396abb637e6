# One static library per folder of src/, from every .cpp in it. Files named *.test.cpp go into that folder's own test
# program. A new constraint, exporter or shape is therefore a file in its folder and nothing here.

find_package(Threads REQUIRED)

# All of it goes into one shared library, which shows nothing but what is marked WEFT_API.
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_CXX_VISIBILITY_PRESET hidden)
set(CMAKE_VISIBILITY_INLINES_HIDDEN ON)

# How every target is compiled.
add_library(weft_flags INTERFACE)
target_compile_features(weft_flags INTERFACE cxx_std_20)
target_compile_options(weft_flags INTERFACE
    -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Werror
    # No silent fused multiply-add: the same source must give the same bits on every instruction set.
    -ffp-contract=off
    # GCC 12 sees overlaps in std::string's own code (its bug 105651).
    $<$<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_LESS:$<CXX_COMPILER_VERSION>,13>>:-Wno-restrict>)
if(WEFT_SANITIZE)
    target_compile_options(weft_flags INTERFACE -fsanitize=${WEFT_SANITIZE} -fno-omit-frame-pointer
        -fno-sanitize-recover=all
        # Instrumented code confuses this one, in the standard library's own headers.
        $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
    target_link_options(weft_flags INTERFACE -fsanitize=${WEFT_SANITIZE})
endif()
if(WEFT_FUZZ)   # every file counts the paths taken; the fuzzers alone have the loop that tries inputs
    target_compile_options(weft_flags INTERFACE -fsanitize=fuzzer-no-link)
endif()

# And what sees the inside of the house.
add_library(weft_options INTERFACE)
target_link_libraries(weft_options INTERFACE weft_flags)
target_include_directories(weft_options INTERFACE ${PROJECT_SOURCE_DIR}/include ${PROJECT_SOURCE_DIR}/src)
target_compile_definitions(weft_options INTERFACE WEFT_VERSION="${PROJECT_VERSION}")

# Every program says this of itself: under the address sanitizer what libraries and drivers lose is not its
# own (foreign_leaks.cpp).
if(WEFT_SANITIZE MATCHES address)
    add_library(weft_foreign_leaks OBJECT ${PROJECT_SOURCE_DIR}/cmake/foreign_leaks.cpp)
endif()
function(weft_program name)
    if(TARGET weft_foreign_leaks)
        target_sources(${name} PRIVATE $<TARGET_OBJECTS:weft_foreign_leaks>)
    endif()
endfunction()

function(weft_test name)
    cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
    add_executable(${name} ${ARG_SOURCES})
    weft_program(${name})
    target_link_libraries(${name} PRIVATE ${ARG_LINK} weft_options GTest::gtest_main GTest::gmock)
    target_compile_definitions(${name} PRIVATE WEFT_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
        WEFT_BINARY_DIR="${PROJECT_BINARY_DIR}")
    gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 600)
endfunction()

function(weft_module name)
    cmake_parse_arguments(ARG "" "" "DEPENDS" ${ARGN})
    set(folder ${PROJECT_SOURCE_DIR}/src/${name})
    file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${folder}/*.cpp)
    set(tests ${sources})
    list(FILTER tests INCLUDE REGEX "\\.test\\.cpp$")
    list(FILTER sources EXCLUDE REGEX "\\.test\\.cpp$")

    add_library(weft_${name} STATIC ${sources})
    if(NOT name STREQUAL PROJECT_NAME)   # weft::weft is what others link: all of this as one shared library
        add_library(weft::${name} ALIAS weft_${name})
    endif()
    target_link_libraries(weft_${name} PUBLIC weft_options Threads::Threads)
    foreach(floor ${ARG_DEPENDS})
        target_link_libraries(weft_${name} PUBLIC weft::${floor})
    endforeach()
    if(EXISTS ${folder}/dependencies.cmake)   # third-party packages of this folder alone
        include(${folder}/dependencies.cmake)
    endif()

    if(WEFT_TESTS AND tests)
        weft_test(${name}_tests SOURCES ${tests} LINK weft_${name})
    endif()
endfunction()
