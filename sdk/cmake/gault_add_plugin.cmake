# gault_add_plugin(NAME SOURCE...)
#
# Builds NAME.so three times from the same sources: for any x86-64, and for x86-64-v3 (AVX2) and x86-64-v4 (AVX-512) in
# glibc-hwcaps/ beside it, of which the host opens the best that the processor can run. -ffp-contract=off keeps the
# results of the three the same to the bit. Lands in ${GAULT_PLUGIN_OUTPUT_DIRECTORY}, or lib/gault/plugins.
function(gault_add_plugin name)
    if(NOT DEFINED GAULT_PLUGIN_OUTPUT_DIRECTORY)
        set(GAULT_PLUGIN_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/lib/gault/plugins)
    endif()
    set(variants "")
    if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
        set(variants x86-64-v3 x86-64-v4)
    endif()
    # One exported symbol: instances of the standard library's templates are visible by default and must stay inside.
    set(exports ${CMAKE_CURRENT_BINARY_DIR}/gault_plugin.map)
    file(CONFIGURE OUTPUT ${exports} CONTENT "{ global: gault_module_v*; local: *; };\n")
    foreach(variant IN ITEMS baseline LISTS variants)
        set(target ${name})
        set(folder "")
        if(NOT variant STREQUAL baseline)
            set(target ${name}_${variant})
            set(folder /glibc-hwcaps/${variant})
        endif()
        add_library(${target} MODULE ${ARGN})
        target_link_libraries(${target} PRIVATE gault::sdk)
        target_compile_options(${target} PRIVATE -ffp-contract=off -fno-math-errno -fvisibility=hidden -Wno-psabi
                                                 $<$<COMPILE_LANGUAGE:CXX>:-fvisibility-inlines-hidden>
                                                 $<$<AND:$<COMPILE_LANGUAGE:CXX>,$<CXX_COMPILER_ID:GNU>>:-fno-gnu-unique>)
        if(NOT variant STREQUAL baseline)
            target_compile_options(${target} PRIVATE -march=${variant})
        endif()
        target_link_options(${target} PRIVATE -Wl,-z,defs -Wl,--version-script=${exports})
        set_target_properties(${target} PROPERTIES PREFIX "" OUTPUT_NAME ${name}
                              LIBRARY_OUTPUT_DIRECTORY ${GAULT_PLUGIN_OUTPUT_DIRECTORY}${folder})
        install(TARGETS ${target} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/gault/plugins${folder})
    endforeach()
endfunction()
