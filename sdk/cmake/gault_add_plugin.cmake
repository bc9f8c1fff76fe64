# gault_add_plugin(NAME SOURCE... [NO_INSTALL])
#
# Builds NAME.so three times from the same C11 or C++17 sources: for any x86-64, and for x86-64-v3 (AVX2) and x86-64-v4
# (AVX-512) in glibc-hwcaps/ beside it, of which the host opens the best that the processor can run. -ffp-contract=off
# keeps the results of the three the same to the bit. Lands in ${GAULT_PLUGIN_OUTPUT_DIRECTORY}, or lib/gault/plugins of
# the build folder, and is installed into lib/gault/plugins, where a host of the same prefix finds it. The targets are
# NAME, NAME_x86-64-v3 and NAME_x86-64-v4; building the first builds all. Never use -ffast-math: the host refuses it.
function(gault_add_plugin name)
    cmake_parse_arguments(PARSE_ARGV 1 arg "NO_INSTALL" "" "")
    if(NOT arg_UNPARSED_ARGUMENTS)
        message(FATAL_ERROR "gault_add_plugin(${name}): no sources")
    endif()
    if(NOT DEFINED GAULT_PLUGIN_OUTPUT_DIRECTORY)
        set(GAULT_PLUGIN_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/lib/gault/plugins)
    endif()
    _gault_add_plugin_variant(${name} ${name} "" "${arg_UNPARSED_ARGUMENTS}" ${arg_NO_INSTALL})
    if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
        foreach(variant IN ITEMS x86-64-v3 x86-64-v4)
            set(target ${name}_${variant})
            _gault_add_plugin_variant(${target} ${name} /glibc-hwcaps/${variant} "${arg_UNPARSED_ARGUMENTS}" ${arg_NO_INSTALL})
            target_compile_options(${target} PRIVATE -march=${variant})
            add_dependencies(${name} ${target})
        endforeach()
    endif()
endfunction()

function(_gault_add_plugin_variant target name folder sources no_install)
    # One exported symbol: instances of the standard library's templates are visible by default and must stay inside.
    set(exports ${CMAKE_CURRENT_BINARY_DIR}/gault_plugin.map)
    file(CONFIGURE OUTPUT ${exports} CONTENT "{ global: gault_module_v*; local: *; };\n")
    add_library(${target} MODULE ${sources})
    target_link_options(${target} PRIVATE -Wl,--version-script=${exports})
    target_link_libraries(${target} PRIVATE gault::sdk -lm) # a plugin may be named m
    target_compile_options(${target} PRIVATE -ffp-contract=off -fno-math-errno -fvisibility=hidden -Wno-psabi
                                             $<$<COMPILE_LANGUAGE:CXX>:-fvisibility-inlines-hidden>
                                             $<$<COMPILE_LANG_AND_ID:CXX,GNU>:-fno-gnu-unique>)
    if(NOT GAULT_SANITIZE) # clang's sanitizers leave their own symbols to the executable
        target_link_options(${target} PRIVATE -Wl,-z,defs)
    endif()
    set_target_properties(${target} PROPERTIES PREFIX "" SUFFIX .so OUTPUT_NAME ${name}
                          LIBRARY_OUTPUT_DIRECTORY ${GAULT_PLUGIN_OUTPUT_DIRECTORY}${folder})
    if(NOT no_install)
        install(TARGETS ${target} LIBRARY DESTINATION lib/gault/plugins${folder} COMPONENT plugins)
    endif()
endfunction()
