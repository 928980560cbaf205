# Tests the test: small trees that keep to the arrows or do not.
#
# cmake -DFOLDER=<scratch folder> -P test_check_arrows.cmake
cmake_minimum_required(VERSION 3.25)

function(expect name complaint file content)
  set(root "${FOLDER}/${name}")
  file(REMOVE_RECURSE "${root}")
  file(WRITE "${root}/physics/tensor.h" "#include <vector>\n")
  file(WRITE "${root}/${file}" "${content}")
  execute_process(COMMAND "${CMAKE_COMMAND}" "-DROOT=${root}" -P "${CMAKE_CURRENT_LIST_DIR}/check_arrows.cmake"
                  RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(complaint STREQUAL "none")
    if(NOT status EQUAL 0)
      message(SEND_ERROR "${name}: should have passed, but: ${output}")
    endif()
    return()
  endif()
  string(REGEX REPLACE "[ \n]+" " " output "${output}")
  string(FIND "${output}" "${complaint}" position)
  if(status EQUAL 0 OR position EQUAL -1)
    message(SEND_ERROR "${name}: should have failed with \"${complaint}\", but: ${output}")
  endif()
endfunction()

expect(forward_include none mesh/mesh.h "#include \"physics/tensor.h\"\n#include <vector>\n")
expect(far_forward_include none cases/program/main.cpp "#include \"physics/tensor.h\"\n")
expect(own_folder none mesh/mesh.cpp "#include \"mesh/mesh.h\"\n")
expect(library_in_quotes_of_a_folder none solver/a.cpp "#include <suitesparse/cholmod.h>\n")
expect(forward_link none solver/linear/CMakeLists.txt "target_link_libraries(pfdm_solver_linear PUBLIC pfdm_mesh pfdm_options)\n")
expect(room_above none solver/fracture/a.h "#include \"solver/momentum/b.h\"\n#include \"solver/parallel.h\"\n")
expect(folder_of_rooms none solver/CMakeLists.txt "target_link_libraries(pfdm_solver INTERFACE pfdm_solver_fracture)\n")
expect(room_of_physics none solver/linear/a.h "#include \"physics/materials/b.h\"\n")
expect(comment none mesh/CMakeLists.txt "# pfdm_solver builds on this\n")

expect(back_include "physics/a.cpp includes mesh/mesh.h: physics must not know mesh"
       physics/a.cpp "// a law\n#include \"mesh/mesh.h\"\n")
expect(deep_back_include "mesh/deep/er/a.h includes solver/b.h: mesh must not know solver"
       mesh/deep/er/a.h "  #  include \"solver/b.h\"  // why\n")
expect(angle_back_include "solver/a.h includes postproc/files/b.h" solver/a.h "#include <postproc/files/b.h>\n")
expect(include_of_a_case "postproc/files/a.h includes cases/program/b.h" postproc/files/a.h "#include \"cases/program/b.h\"\n")
expect(relative_include "mesh/a.h includes \"../solver/b.h\"" mesh/a.h "#include \"../solver/b.h\"\n")
expect(include_of_a_test "mesh/a.h includes \"tests/b.h\"" mesh/a.h "#include \"tests/b.h\"\n")
expect(back_link "mesh/CMakeLists.txt links pfdm_solver: mesh must not know it"
       mesh/CMakeLists.txt "target_link_libraries(pfdm_mesh PUBLIC pfdm_physics\n  pfdm_solver)\n")
expect(room_below "solver/momentum/a.h includes solver/fracture/b.h: solver/momentum must not know solver/fracture"
       solver/momentum/a.h "#include \"solver/fracture/b.h\"\n")
expect(law_below "physics/elasticity/a.h includes physics/damage/b.h: physics/elasticity must not know physics/damage"
       physics/elasticity/a.h "#include \"physics/damage/b.h\"\n")
expect(room_beside "solver/fracture/a.h includes solver/calibration/b.h: solver/fracture must not know solver/calibration"
       solver/fracture/a.h "#include \"solver/calibration/b.h\"\n")
expect(link_to_room_beside "solver/fracture/CMakeLists.txt links pfdm_solver_vibration: solver/fracture must not know it"
       solver/fracture/CMakeLists.txt "target_link_libraries(pfdm_solver_fracture PUBLIC pfdm_solver_vibration)\n")
expect(no_room "postproc/a.cpp is in no room" postproc/a.cpp "#include <vector>\n")
