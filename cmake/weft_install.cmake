# What `cmake --install` installs. Programs that link these libraries need no other packages, because the libraries
# contain or load their own dependencies.

include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(package ${CMAKE_INSTALL_LIBDIR}/cmake/weft)
set(components core)
if(WEFT_IO)
    list(APPEND components io)
endif()
foreach(component ${components})
    install(TARGETS weft_${component}_library EXPORT weft-${component}
        RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR}
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
    install(EXPORT weft-${component} FILE weft-${component}-targets.cmake NAMESPACE weft:: DESTINATION ${package})
endforeach()
install(DIRECTORY include/weft DESTINATION include PATTERN vulkan.h EXCLUDE)
if(WEFT_VULKAN)   # the only header that includes Vulkan's headers
    install(FILES include/weft/vulkan.h DESTINATION include/weft)
endif()
if(WEFT_APPS)
    install(TARGETS weft RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()

write_basic_package_version_file(${PROJECT_BINARY_DIR}/weft-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES cmake/weft-config.cmake ${PROJECT_BINARY_DIR}/weft-config-version.cmake DESTINATION ${package})

install(DIRECTORY scenes DESTINATION ${CMAKE_INSTALL_DATADIR}/weft)
install(FILES docs/scene.schema.json DESTINATION ${CMAKE_INSTALL_DATADIR}/weft)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
