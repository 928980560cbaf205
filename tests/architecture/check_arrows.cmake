# Fails if a room includes or links against one that it may not use, or if the rooms use each other in a circle.
#
# cmake -DROOT=<checkout> -P check_arrows.cmake
cmake_minimum_required(VERSION 3.25)

# Each room, and the rooms that it may use: they stand above it. Files belong to the innermost room around them. Whoever
# may use one of `open_folders` from outside of it may use all of its rooms.
set(rooms
    "physics"
    "physics/system: physics"
    "physics/elasticity: physics"
    "physics/damage: physics physics/elasticity"
    "physics/interfaces: physics physics/elasticity physics/damage"
    "physics/point: physics physics/elasticity"
    "physics/materials: physics physics/elasticity physics/damage physics/point"
    "physics/closed_forms: physics physics/elasticity physics/damage physics/point"
    "mesh: physics"
    "mesh/search: physics mesh"
    "mesh/surfaces: physics mesh mesh/search"
    "mesh/packing: physics mesh"
    "mesh/generators: physics mesh mesh/surfaces mesh/packing"
    "mesh/files: physics mesh mesh/search"
    "solver: physics"
    "solver/linear: physics mesh solver"
    "solver/scalar: physics mesh solver solver/linear"
    "solver/heat: physics mesh solver solver/linear solver/scalar"
    "solver/momentum/body: physics mesh solver solver/linear solver/scalar"
    "solver/momentum/bending: physics mesh mesh/search solver solver/linear solver/scalar solver/momentum/body"
    "solver/momentum/faces: physics mesh solver solver/linear solver/scalar solver/momentum/body solver/momentum/bending"
    "solver/momentum/small_strain: physics mesh solver solver/linear solver/scalar solver/momentum/body solver/momentum/faces"
    "solver/momentum/finite_strain: physics mesh solver solver/linear solver/scalar solver/momentum/body solver/momentum/bending
     solver/momentum/faces"
    "solver/momentum: physics mesh solver solver/linear solver/scalar solver/momentum/body solver/momentum/bending
     solver/momentum/faces solver/momentum/small_strain solver/momentum/finite_strain"
    "solver/momentum/solution: physics mesh solver solver/linear solver/scalar solver/momentum/body solver/momentum/finite_strain
     solver/momentum"
    "solver/dynamics: physics mesh solver solver/linear solver/scalar solver/momentum"
    "solver/fracture/model: physics mesh solver solver/linear solver/scalar solver/heat solver/momentum"
    "solver/fracture/gaps: physics mesh solver solver/momentum solver/fracture/model"
    "solver/fracture/cells: physics mesh solver solver/linear solver/momentum solver/fracture/model solver/fracture/gaps"
    "solver/fracture/damage: physics mesh solver solver/linear solver/scalar solver/fracture/model"
    "solver/fracture/equilibrium: physics mesh solver solver/linear solver/scalar solver/momentum solver/fracture/model
     solver/fracture/cells solver/fracture/damage"
    "solver/fracture: physics mesh solver solver/linear solver/scalar solver/heat solver/momentum solver/fracture/model
     solver/fracture/cells solver/fracture/damage solver/fracture/equilibrium"
    "solver/fracture/derivatives: physics mesh solver solver/linear solver/momentum solver/fracture/model solver/fracture/cells
     solver/fracture/damage solver/fracture/equilibrium solver/fracture"
    "solver/fracture/words: physics mesh solver solver/linear solver/momentum solver/fracture/model solver/fracture/gaps solver/fracture"
    "solver/homogenization: physics mesh solver solver/linear solver/scalar solver/momentum"
    "solver/calibration: physics solver solver/linear"
    "solver/point: physics solver solver/linear solver/calibration"
    "solver/vibration/signals: physics solver solver/linear solver/calibration"
    "solver/vibration/simulation: physics solver solver/linear solver/calibration solver/vibration/signals"
    "solver/vibration/identification: physics solver solver/linear solver/calibration solver/vibration/signals
     solver/vibration/simulation"
    "solver/vibration/diagnosis: physics solver solver/linear solver/calibration solver/vibration/signals
     solver/vibration/simulation solver/vibration/identification"
    "solver/vibration: physics solver solver/linear solver/calibration"
    "postproc/files: physics"
    "postproc/hdf5: physics"
    "postproc/fields: physics mesh mesh/files solver solver/momentum solver/fracture postproc/files postproc/hdf5"
    "postproc/curves: physics solver/fracture solver/calibration postproc/files"
    "postproc/fits: physics solver/calibration postproc/files postproc/curves"
    "postproc/displacements: physics mesh mesh/search solver/calibration postproc/files postproc/curves postproc/fits"
    "postproc/point: physics solver/point postproc/files postproc/curves postproc/fits"
    "postproc/vibration: physics solver/vibration solver/calibration postproc/files postproc/curves postproc/fits"
    "postproc/cohesive: physics mesh mesh/search solver solver/fracture solver/calibration postproc/files postproc/fields postproc/curves"
    "postproc/exports/law: physics mesh solver/fracture postproc/files postproc/cohesive"
    "postproc/exports: physics mesh solver/fracture postproc/files postproc/cohesive postproc/exports/law"
    "postproc/page: physics postproc/files"
    "postproc/browser: physics mesh postproc/files postproc/fields postproc/page"
    "postproc/records: physics postproc/files postproc/hdf5"
    "postproc/reduction: physics postproc/files postproc/curves"
    "cases/program/input/config: physics postproc/files"
    "cases/program/input/case_files: physics postproc/files cases/program/input/config"
    "cases/program/input/fields: physics mesh mesh/search mesh/files postproc/files cases/program/input/config
     cases/program/input/case_files"
    "cases/program/input/laws: physics postproc/files cases/program/input/config"
    "cases/program/input: physics mesh mesh/files postproc/files"
    "cases/program/reference: physics cases/program/input"
    "cases/program/session/terminal: physics mesh solver postproc/files cases/program/input"
    "cases/program/session: physics mesh solver postproc/files postproc/curves postproc/fits postproc/page postproc/browser
     cases/program/input cases/program/session/terminal"
    "cases/program/studies/runs: physics solver/calibration postproc/files postproc/curves postproc/displacements cases/program/input cases/program/session"
    "cases/program/studies/fit: physics solver/calibration postproc/files postproc/curves postproc/fits postproc/displacements postproc/page postproc/browser
     cases/program/input cases/program/session cases/program/studies/runs"
    "cases/program/studies/sweep: physics solver/calibration postproc/files postproc/curves postproc/page postproc/browser
     cases/program/input cases/program/session cases/program/studies/runs"
    "cases/program/studies/sensitivity: physics solver/calibration postproc/files postproc/curves postproc/page postproc/browser
     cases/program/input cases/program/session cases/program/studies/runs cases/program/studies/fit"
    "cases/program/studies: physics solver/calibration postproc/files postproc/curves postproc/displacements postproc/page postproc/browser cases/program/input
     cases/program/session cases/program/studies/runs cases/program/studies/fit
     cases/program/studies/sensitivity cases/program/studies/sweep"
    "cases/program/chain: physics solver/calibration postproc/files postproc/fits postproc/page cases/program/input cases/program/session"
    "cases/program/point: physics solver/point postproc/files postproc/curves postproc/fits postproc/point postproc/page cases/program/input
     cases/program/session cases/program/studies"
    "cases/program/viscoelastic: physics solver/point postproc/files postproc/curves postproc/fits postproc/point postproc/page cases/program/input
     cases/program/session cases/program/studies cases/program/point"
    "cases/program/vibration: physics solver/vibration postproc/files postproc/curves postproc/fits postproc/vibration postproc/page postproc/records
     cases/program/input cases/program/session cases/program/studies"
    "cases/program/fracture/body: physics mesh mesh/search mesh/surfaces mesh/generators mesh/files solver/momentum solver/fracture postproc/files
     cases/program/input"
    "cases/program/fracture/case: physics mesh mesh/files solver/heat solver/momentum solver/fracture postproc/reduction postproc/files postproc/fields
     postproc/curves postproc/displacements postproc/cohesive cases/program/input cases/program/session cases/program/studies cases/program/fracture/body"
    "cases/program/fracture/outcome: physics mesh solver/heat solver/momentum solver/fracture postproc/files postproc/fields
     postproc/curves postproc/fits postproc/displacements postproc/cohesive postproc/exports postproc/page postproc/browser cases/program/input cases/program/session
     cases/program/studies cases/program/fracture/body cases/program/fracture/case"
    "cases/program/fracture/page: physics mesh solver/fracture postproc/files postproc/fields postproc/curves postproc/fits postproc/cohesive
     postproc/page postproc/browser cases/program/input cases/program/session cases/program/studies cases/program/fracture/case
     cases/program/fracture/outcome"
    "cases/program/fracture/run: physics mesh solver/heat solver/fracture postproc/reduction postproc/files postproc/fields postproc/curves postproc/displacements
     postproc/cohesive postproc/page postproc/browser cases/program/input cases/program/session cases/program/studies cases/program/fracture/case
     cases/program/fracture/outcome cases/program/fracture/page"
    "cases/program/fracture: physics mesh mesh/surfaces mesh/generators mesh/files solver/heat solver/momentum solver/fracture postproc/reduction postproc/files
     postproc/fields postproc/curves postproc/fits postproc/displacements postproc/cohesive postproc/exports postproc/page postproc/browser cases/program/input cases/program/session
     cases/program/studies cases/program/fracture/body cases/program/fracture/case
     cases/program/fracture/outcome cases/program/fracture/page cases/program/fracture/run"
    "cases/program/specimens: physics solver/fracture postproc/files postproc/curves postproc/reduction cases/program/input
     cases/program/session cases/program/studies cases/program/fracture"
    "cases/cpp: physics mesh mesh/generators solver/fracture cases/program/fracture"
    "cases/program/plate: physics mesh solver solver/linear solver/scalar solver/momentum solver/dynamics solver/calibration
     postproc/files postproc/fields postproc/curves postproc/fits postproc/vibration postproc/page postproc/browser cases/program/input cases/program/session
     cases/program/studies cases/program/fracture"
    "cases/program/homogenization: physics mesh solver/momentum solver/fracture solver/homogenization postproc/files
     postproc/fields postproc/curves postproc/page postproc/browser cases/program/input cases/program/session cases/program/studies cases/program/fracture"
    "cases/python/extension: physics mesh mesh/files solver solver/fracture solver/homogenization solver/point solver/vibration
     postproc/files postproc/curves postproc/fields postproc/point cases/program/input cases/program/point cases/program/vibration cases/program/fracture
     cases/program/homogenization"
    "cases/program: physics solver postproc/reduction postproc/files postproc/curves postproc/exports
     cases/program/input cases/program/reference cases/program/session cases/program/studies cases/program/point cases/program/viscoelastic
     cases/program/vibration cases/program/specimens cases/program/fracture cases/program/homogenization cases/program/plate cases/program/chain")
set(complaints "")

set(open_folders physics solver/momentum solver/fracture solver/vibration postproc/exports cases/program/input cases/program/session
    cases/program/studies cases/program/fracture)
foreach(folder IN LISTS open_folders)
  set(rooms_in_${folder} ${rooms})
  list(FILTER rooms_in_${folder} INCLUDE REGEX "^${folder}/")
  list(TRANSFORM rooms_in_${folder} REPLACE ":.*" "")
endforeach()

set(names "")
foreach(row IN LISTS rooms)
  string(REGEX MATCHALL "[a-z0-9/_]+" words "${row}")
  list(POP_FRONT words room)
  foreach(used IN LISTS words)
    if(NOT used IN_LIST names)
      list(APPEND complaints "${room} may not use ${used}, which does not stand above it")
    endif()
  endforeach()
  list(APPEND names ${room})
  set(used_by_${room} ${room} ${words})
  foreach(folder IN LISTS open_folders)
    if(folder IN_LIST words AND NOT room MATCHES "^${folder}(/|$)")
      list(APPEND used_by_${room} ${rooms_in_${folder}})
    endif()
  endforeach()
endforeach()

# The innermost room of a path; empty for what is in none, as headers of libraries.
function(find_room path result)
  get_filename_component(folder "${path}" DIRECTORY)
  while(folder AND NOT folder IN_LIST names)
    get_filename_component(folder "${folder}" DIRECTORY)
  endwhile()
  set(${result} "${folder}" PARENT_SCOPE)
endfunction()

# Includes of one source file: paths in quotes start with a folder of the top level.
function(check_includes file)
  find_room("${file}" room)
  file(STRINGS "${ROOT}/${file}" lines REGEX "^[ \t]*#[ \t]*include")
  foreach(line IN LISTS lines)
    if(NOT line MATCHES "include[ \t]*([\"<])([^\">]+)[\">]")
      continue()
    endif()
    set(quote "${CMAKE_MATCH_1}")
    set(header "${CMAKE_MATCH_2}")
    find_room("${header}" used)
    if(NOT room)
      list(APPEND complaints "${file} is in no room")
    elseif(used AND NOT used IN_LIST used_by_${room})
      list(APPEND complaints "${file} includes ${header}: ${room} must not know ${used}")
    elseif(quote STREQUAL "\"" AND NOT used)
      list(APPEND complaints "${file} includes \"${header}\": paths start with a folder of the top level")
    endif()
  endforeach()
  set(complaints "${complaints}" PARENT_SCOPE)
endfunction()

# The room that a target of this project is made of, as in pfdm_solver_linear.
function(room_of_target target result)
  string(REGEX REPLACE "^pfdm_" "" room "${target}")
  string(REGEX REPLACE "^(solver|postproc|program)_" "\\1/" room "${room}")
  string(REGEX REPLACE "^program" "cases/program" room "${room}")
  string(REGEX REPLACE "^solver/parallel$" "solver" room "${room}")
  if(NOT room IN_LIST names AND NOT room STREQUAL "postproc")
    set(room "")
  endif()
  set(${result} "${room}" PARENT_SCOPE)
endfunction()

# The project's own targets that a CMakeLists.txt names; that of a folder may name its own rooms.
function(check_links file)
  get_filename_component(folder "${file}" DIRECTORY)
  find_room("${file}" room)
  file(STRINGS "${ROOT}/${file}" lines)
  list(TRANSFORM lines REPLACE "#.*" "")
  string(REGEX MATCHALL "pfdm_[a-z0-9_]+" targets "${lines}")
  list(REMOVE_DUPLICATES targets)
  foreach(target IN LISTS targets)
    room_of_target(${target} used)
    string(FIND "${used}/" "${folder}/" inside)
    if(used AND NOT inside EQUAL 0 AND NOT used IN_LIST used_by_${room})
      list(APPEND complaints "${file} links ${target}: ${folder} must not know it")
    endif()
  endforeach()
  set(complaints "${complaints}" PARENT_SCOPE)
endfunction()

set(n_sources 0)
foreach(folder physics mesh solver postproc cases)
  file(GLOB_RECURSE sources RELATIVE "${ROOT}" "${ROOT}/${folder}/*.h" "${ROOT}/${folder}/*.cpp")
  foreach(file IN LISTS sources)
    check_includes("${file}")
    math(EXPR n_sources "${n_sources} + 1")
  endforeach()
  file(GLOB_RECURSE lists RELATIVE "${ROOT}" "${ROOT}/${folder}/CMakeLists.txt")
  foreach(file IN LISTS lists)
    check_links("${file}")
  endforeach()
endforeach()

if(n_sources EQUAL 0)
  message(FATAL_ERROR "no sources below ${ROOT}")
endif()
if(complaints)
  list(JOIN complaints "\n" text)
  message(FATAL_ERROR "${text}")
endif()
message(STATUS "${n_sources} files keep to the arrows")
