# The installed libraries. weft::core, libweft_core.so: the simulation without files, which needs Highway and, if built
# with Vulkan, SPIRV-Cross. weft::io, libweft_io.so, is based on it: scene files, mesh import, exports. weft::weft is
# both. They export only symbols marked WEFT_API; third-party libraries stay private.

# weft_shared(<name> <folder>): libweft_<name>.so from the code that implements its part of include/weft, and its
# dependencies.
function(weft_shared name folder)
    set(library weft_${name}_library)
    add_library(${library} SHARED $<TARGET_OBJECTS:weft_${folder}>)
    add_library(weft::${name} ALIAS ${library})
    target_link_libraries(${library} PRIVATE weft_flags)
    target_compile_features(${library} PUBLIC cxx_std_20)
    target_include_directories(${library} INTERFACE
        $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:include>)
    target_compile_definitions(weft_${folder} PRIVATE WEFT_BUILDING)
    target_compile_definitions(${library} INTERFACE WEFT_SHARED)
    # Until 1.0, every minor version may change the binary interface.
    set_target_properties(${library} PROPERTIES OUTPUT_NAME weft_${name} EXPORT_NAME ${name} LINKER_LANGUAGE CXX
        VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR} INSTALL_RPATH "$ORIGIN")
    if(UNIX AND NOT APPLE)   # templates of the standard library are visible by default
        set(exports ${PROJECT_SOURCE_DIR}/cmake/weft_exports.map)
        target_link_options(${library} PRIVATE -Wl,--version-script=${exports})
        if(NOT WEFT_SANITIZE OR CMAKE_CXX_COMPILER_ID STREQUAL GNU)   # clang links sanitizers to programs only
            target_link_options(${library} PRIVATE -Wl,--no-undefined)
        endif()
        set_target_properties(${library} PROPERTIES LINK_DEPENDS ${exports})
    endif()
endfunction()

# No internal code refers to the public functions, so the library that implements them is linked as a whole.
weft_shared(core weft)
target_link_libraries(weft_core_library PRIVATE weft_weft)
add_library(weft_all INTERFACE)
add_library(weft::weft ALIAS weft_all)
target_link_libraries(weft_all INTERFACE weft_core_library)
if(WEFT_IO)
    weft_shared(io files)
    target_link_libraries(weft_io_library PUBLIC weft_core_library PRIVATE weft_io)
    target_link_libraries(weft_all INTERFACE weft_io_library)
endif()
