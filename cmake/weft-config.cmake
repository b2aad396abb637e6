# find_package(weft) reads this.
include(${CMAKE_CURRENT_LIST_DIR}/weft-targets.cmake)
