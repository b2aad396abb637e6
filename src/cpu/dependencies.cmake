find_path(HIGHWAY_INCLUDE_DIR hwy/highway.h REQUIRED)
find_library(HIGHWAY_LIBRARY hwy REQUIRED)
target_include_directories(weft_cpu SYSTEM PRIVATE ${HIGHWAY_INCLUDE_DIR})
target_link_libraries(weft_cpu PRIVATE ${HIGHWAY_LIBRARY})

# These files take long to compile, so they are compiled in parallel; some include themselves.
set(simd_loops ${folder}/passes_simd.cpp ${folder}/cloth_contact/contact_simd.cpp
    ${folder}/particle_contact/particle_simd.cpp)
set(scalar_loops ${folder}/passes_scalar.cpp ${folder}/cloth_contact/contact_scalar.cpp
    ${folder}/particle_contact/particle_scalar.cpp)
set_source_files_properties(${simd_loops} ${scalar_loops} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
if(WEFT_SANITIZE)
    # No pointer to a local variable leaves a kernel's scope. Checking for such pointers takes five times as long as the
    # rest of the compilation.
    set(loop_options -O1 -fno-sanitize-address-use-after-scope)
    if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)   # inline checks of accesses: these loops take most of a simulation's time
        list(APPEND loop_options --param=asan-instrumentation-with-call-threshold=7000)
    endif()
    set_source_files_properties(${simd_loops} ${scalar_loops} PROPERTIES COMPILE_OPTIONS "${loop_options}")
    set_source_files_properties(${simd_loops} PROPERTIES
        COMPILE_DEFINITIONS WEFT_ONE_TARGET SKIP_PRECOMPILE_HEADERS ON)
endif()
