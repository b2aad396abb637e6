# The library as others see it: libweft.so with every folder of src/ in it. It shows what is marked WEFT_API and nothing
# else; third-party libraries are its own affair.

# Nothing within refers to the public functions, so what holds them comes whole and brings the rest.
add_library(weft_library SHARED $<TARGET_OBJECTS:weft_weft>)
add_library(weft::weft ALIAS weft_library)
target_link_libraries(weft_library PRIVATE weft_weft)
target_compile_features(weft_library PUBLIC cxx_std_20)
target_include_directories(weft_library INTERFACE
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:include>)
target_compile_definitions(weft_weft PRIVATE WEFT_BUILDING)
target_compile_definitions(weft_library INTERFACE WEFT_SHARED)
# Until 1.0 every minor version may change the binary interface.
set_target_properties(weft_library PROPERTIES OUTPUT_NAME weft EXPORT_NAME weft LINKER_LANGUAGE CXX
    VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
if(UNIX AND NOT APPLE)   # the standard library's templates are visible by its own wish
    set(exports ${PROJECT_SOURCE_DIR}/cmake/weft_exports.map)
    target_link_options(weft_library PRIVATE -Wl,--version-script=${exports})
    set_target_properties(weft_library PROPERTIES LINK_DEPENDS ${exports})
endif()
