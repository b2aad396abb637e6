# The headers and volk. volk finds the system's loader at run time, so no loader is needed to build or to start.
find_package(VulkanHeaders REQUIRED)
target_link_libraries(weft_gpu PUBLIC Vulkan::Headers)
find_path(VOLK_INCLUDE_DIR volk.h REQUIRED)
target_include_directories(weft_gpu SYSTEM PUBLIC ${VOLK_INCLUDE_DIR})
target_link_libraries(weft_gpu PRIVATE ${CMAKE_DL_LIBS})
set_source_files_properties(${folder}/volk.cpp PROPERTIES COMPILE_OPTIONS "-w" SKIP_PRECOMPILE_HEADERS ON)

# Reflection of shaders.
find_package(spirv_cross_c_shared REQUIRED)
# Programs with the property WEFT_LINK_STATIC link it statically, if the archives exist.
set(spirv_cross_archives)
foreach(part c cpp reflect hlsl msl glsl core)
    find_library(SPIRV_CROSS_${part}_ARCHIVE libspirv-cross-${part}.a)
    list(APPEND spirv_cross_archives ${SPIRV_CROSS_${part}_ARCHIVE})
endforeach()
if("${spirv_cross_archives}" MATCHES "NOTFOUND")
    set(spirv_cross_archives spirv-cross-c-shared)
endif()
target_link_libraries(weft_gpu PRIVATE
    $<IF:$<BOOL:$<TARGET_PROPERTY:WEFT_LINK_STATIC>>,${spirv_cross_archives},spirv-cross-c-shared>)

# This folder has no shaders of its own, but its tests do.
if(WEFT_TESTS)
    include(weft_shaders)
    file(GLOB shaders CONFIGURE_DEPENDS ${folder}/test_shaders/*.comp)
    weft_shader_table(test_shaders ${shaders})
    set_source_files_properties(${folder}/test_shaders.test.cpp PROPERTIES OBJECT_DEPENDS "${test_shaders_depends}"
        INCLUDE_DIRECTORIES ${test_shaders_folder})
    find_program(SPIRV_VAL spirv-val REQUIRED)   # Debian: spirv-tools
    set_source_files_properties(${folder}/spirv.test.cpp PROPERTIES COMPILE_DEFINITIONS WEFT_SPIRV_VAL="${SPIRV_VAL}")
endif()
