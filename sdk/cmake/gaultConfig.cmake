# find_package(gault): the target gault::sdk (headers) and the function gault_add_plugin.
include(${CMAKE_CURRENT_LIST_DIR}/gaultTargets.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/gault_add_plugin.cmake)
