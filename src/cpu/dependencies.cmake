find_path(HIGHWAY_INCLUDE_DIR hwy/highway.h REQUIRED)
find_library(HIGHWAY_LIBRARY hwy REQUIRED)
target_include_directories(weft_cpu SYSTEM PRIVATE ${HIGHWAY_INCLUDE_DIR})
target_link_libraries(weft_cpu PRIVATE ${HIGHWAY_LIBRARY})

if(WEFT_SANITIZE)
    set_source_files_properties(${folder}/passes_simd.cpp PROPERTIES COMPILE_OPTIONS "-O1"
        COMPILE_DEFINITIONS WEFT_ONE_TARGET SKIP_PRECOMPILE_HEADERS ON)
endif()
