# find_package(gault): the target gault::sdk (headers), the function gault_add_plugin, and GAULT_PROGRAM, the program of the
# same installation, false where there is none.
include(${CMAKE_CURRENT_LIST_DIR}/gaultTargets.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/gault_add_plugin.cmake)
find_program(GAULT_PROGRAM gault HINTS ${CMAKE_CURRENT_LIST_DIR}/../../../bin NO_DEFAULT_PATH)
