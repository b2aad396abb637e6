# For code that shaders and C++ share.
find_package(glm REQUIRED)
target_link_libraries(weft_view PUBLIC glm::glm)

# Letters for legends.
find_path(STB_INCLUDE_DIR stb/stb_easy_font.h REQUIRED)
target_include_directories(weft_view SYSTEM PRIVATE ${STB_INCLUDE_DIR})
