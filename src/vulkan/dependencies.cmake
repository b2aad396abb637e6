include(${folder}/shaders.cmake)
