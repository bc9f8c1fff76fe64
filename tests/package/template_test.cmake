# cmake -DBUILD= -DCOMPILER= -DLOADER= -DWORK= -DKIND= -P template_test.cmake
include(${CMAKE_CURRENT_LIST_DIR}/must.cmake)

set(prefix ${WORK}/prefix)
set(plugins ${WORK}/installed/lib/gault/plugins)
file(REMOVE_RECURSE ${WORK})
must(${CMAKE_COMMAND} --install ${BUILD} --component sdk --prefix ${prefix})

# The copy that was installed, against the headers that were installed: nothing of the repository is in reach.
must(${CMAKE_COMMAND} -E copy_directory ${prefix}/share/gault/template/${KIND} ${WORK}/source)
must(${CMAKE_COMMAND} -S ${WORK}/source -B ${WORK}/build -DCMAKE_PREFIX_PATH=${prefix} -DCMAKE_CXX_COMPILER=${COMPILER}
     -DCMAKE_CXX_FLAGS=-Werror)
must(${CMAKE_COMMAND} --build ${WORK}/build)
must(${CMAKE_CTEST_COMMAND} --test-dir ${WORK}/build --output-on-failure)
must_print("100% tests passed")
must(${CMAKE_COMMAND} --install ${WORK}/build --prefix ${WORK}/installed)

foreach(isa baseline x86-64-v3 x86-64-v4)
    must(${CMAKE_COMMAND} -E env GAULT_ISA=${isa} ${LOADER} ${plugins})
    must_print("${KIND} new_${KIND} ")
    must_print("${plugins}/")
endforeach()
