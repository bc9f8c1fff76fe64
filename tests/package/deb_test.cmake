# cmake -DBUILD= -DWORK= -P deb_test.cmake: the Debian package, unpacked and used where nothing of the build tree is in reach.
include(${CMAKE_CURRENT_LIST_DIR}/must.cmake)

file(REMOVE_RECURSE ${WORK})
must(${CMAKE_CPACK_COMMAND} --config ${BUILD}/CPackConfig.cmake -B ${WORK})
file(GLOB package ${WORK}/gault_*.deb)
must(dpkg-deb --field ${package} Depends)
must_print("libc6")
must_print("python3-matplotlib")
must(dpkg-deb -x ${package} ${WORK}/root)
set(usr ${WORK}/root/usr)
set(gault ${usr}/bin/gault)

must(/usr/bin/python3 ${CMAKE_CURRENT_LIST_DIR}/links_test.py ${usr}/share/doc/gault)

must(${gault} list)
must_print("${usr}/lib/gault/plugins/")
must(${gault} describe mohr_coulomb)
foreach(isa baseline x86-64-v4)
    must(${CMAKE_COMMAND} -E env GAULT_ISA=${isa} ${gault} run ${usr}/share/gault/configs/paper/fahey_auto.yaml -o ${WORK}/${isa} --quiet)
endforeach()
must(${CMAKE_COMMAND} -E compare_files ${WORK}/baseline/history.csv ${WORK}/x86-64-v4/history.csv)
must(${CMAKE_COMMAND} -E env GAULT_ISA=baseline ${gault} certify modified_cam_clay --only batches --only cavity
     --set critical_state_ratio=1.2 --set compression_index=0.15 --set swelling_index=0.03 --set poisson_ratio=0.278
     --set critical_state_volume=2.74 --set overconsolidation_ratio=1)
must_print("certified")

must(${gault} new material my_soil -o ${WORK}/my_soil)
must(${CMAKE_COMMAND} -S ${WORK}/my_soil -B ${WORK}/my_soil/build -DCMAKE_PREFIX_PATH=${usr})
must(${CMAKE_COMMAND} --build ${WORK}/my_soil/build)
must(${gault} run ${WORK}/my_soil/scene.yaml -o ${WORK}/my_run)
