# Header-only.
find_package(nlohmann_json REQUIRED)
target_link_libraries(weft_scenes PRIVATE nlohmann_json::nlohmann_json)
