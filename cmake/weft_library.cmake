# The libraries as others see them. weft::core, libweft_core.so: the simulation, which knows no files and needs Highway,
# and where it is built with Vulkan, SPIRV-Cross. weft::io, libweft_io.so, on top of it: scene files, mesh import, exports.
# weft::weft is both. They show what is marked WEFT_API and nothing else; third-party libraries are their own affair.

# weft_shared(<name> <folder>): libweft_<name>.so of what implements its part of include/weft, and of what that needs.
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
    # Until 1.0 every minor version may change the binary interface.
    set_target_properties(${library} PROPERTIES OUTPUT_NAME weft_${name} EXPORT_NAME ${name} LINKER_LANGUAGE CXX
        VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR} INSTALL_RPATH "$ORIGIN")
    if(UNIX AND NOT APPLE)   # the standard library's templates are visible by its own wish
        set(exports ${PROJECT_SOURCE_DIR}/cmake/weft_exports.map)
        target_link_options(${library} PRIVATE -Wl,--version-script=${exports})
        if(NOT WEFT_SANITIZE)   # whose functions are in the program
            target_link_options(${library} PRIVATE -Wl,--no-undefined)
        endif()
        set_target_properties(${library} PROPERTIES LINK_DEPENDS ${exports})
    endif()
endfunction()

# Nothing within refers to the public functions, so what holds them comes whole and brings the rest.
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
