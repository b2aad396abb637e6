# glTF export. Debian packages tinygltf as a compiled library with a CMake package; imported targets are system headers.
find_package(TinyGLTF REQUIRED)
target_link_libraries(weft_io PRIVATE TinyGLTF::TinyGLTF)

# Mesh import, and the checks of glTF files before it.
find_package(nlohmann_json REQUIRED)
target_link_libraries(weft_io PRIVATE nlohmann_json::nlohmann_json)
find_package(assimp REQUIRED)
target_link_libraries(weft_io PRIVATE assimp::assimp)

# Images: header-only.
find_path(STB_INCLUDE_DIR stb/stb_image.h REQUIRED)
target_include_directories(weft_io SYSTEM PRIVATE ${STB_INCLUDE_DIR})
