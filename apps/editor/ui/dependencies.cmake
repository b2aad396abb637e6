# Dear ImGui, without its backends.
find_path(IMGUI_INCLUDE_DIR imgui_internal.h PATH_SUFFIXES imgui)
find_library(IMGUI_LIBRARY imgui)
if(NOT IMGUI_INCLUDE_DIR OR NOT IMGUI_LIBRARY)
    message(FATAL_ERROR "Dear ImGui is missing (Debian: libimgui-dev)")
endif()
target_include_directories(weft_editor_ui SYSTEM PUBLIC ${IMGUI_INCLUDE_DIR})
target_link_libraries(weft_editor_ui PUBLIC ${IMGUI_LIBRARY})
find_library(STB_LIBRARY stb)   # Debian's ImGui uses the stb library of the system
if(STB_LIBRARY)
    target_link_libraries(weft_editor_ui PUBLIC ${STB_LIBRARY})
endif()

# The typeface is part of the program, so that it looks the same everywhere.
include(weft_embed)
set(ui_embedded ${CMAKE_CURRENT_BINARY_DIR}/editor_ui)
file(MAKE_DIRECTORY ${ui_embedded})
foreach(style Regular SemiBold)
    string(TOLOWER ${style} ui_style)
    find_file(WEFT_TYPEFACE_${style} NAMES Inter-${style}.otf Inter-${style}.ttf
        PATHS /usr/share/fonts /usr/local/share/fonts
        PATH_SUFFIXES opentype/inter truetype/inter inter OTF TTF)
    if(NOT WEFT_TYPEFACE_${style})
        message(FATAL_ERROR "The editor's typeface is missing: Inter-${style}.otf (Debian: fonts-inter). "
            "Set WEFT_TYPEFACE_${style} to the file if it is elsewhere")
    endif()
    weft_embed_file(${ui_embedded}/typeface_${ui_style}_table.inc ${WEFT_TYPEFACE_${style}})
    list(APPEND ui_typefaces ${ui_embedded}/typeface_${ui_style}_table.inc)
endforeach()
set_source_files_properties(${folder}/typeface.cpp PROPERTIES OBJECT_DEPENDS "${ui_typefaces}")

include(weft_shaders)
foreach(stage vert frag)
    weft_compile_shader(${ui_embedded} ui_${stage} ${folder}/shaders/ui.${stage})
endforeach()
weft_compile_shader(${ui_embedded} ui_solid_vert ${folder}/shaders/ui.vert -DWEFT_SOLID)
weft_compile_shader(${ui_embedded} ui_solid_frag ${folder}/shaders/ui_solid.frag)
weft_embed_shaders(${ui_embedded} ui_shader_table ui_vert ui_frag ui_solid_vert ui_solid_frag)
set_source_files_properties(${folder}/ui_renderer.cpp PROPERTIES OBJECT_DEPENDS "${ui_shader_table_depends}")
target_include_directories(weft_editor_ui PRIVATE ${ui_embedded})
