find_path(HIGHWAY_INCLUDE_DIR hwy/highway.h REQUIRED)
find_library(HIGHWAY_LIBRARY hwy REQUIRED)
target_include_directories(weft_cpu SYSTEM PRIVATE ${HIGHWAY_INCLUDE_DIR})
target_link_libraries(weft_cpu PRIVATE ${HIGHWAY_LIBRARY})
